#pragma once

#include <optional>

#include "modeler/shape_cone.hh"
#include "modeler/shape_ellipsoid.hh"
#include "modeler/shape_torus.hh"

namespace maille::modeler {

/// What lies on one another may differ by so much, in parts of the radius.
constexpr double coincidence = 1e-9;

/// Whether numbers about 1, or larger ones, are the same.
bool near(double a, double b);

/// An interval of heights.
struct Span {
    double low, high;
};

bool meet(const Span& a, const Span& b);

/// The heights between which the cone lies in the coordinates of another with the same side; nothing where
/// their sides differ.
std::optional<Span> span_on(const Cone& reference, const Cone& cone);

/// Whether it makes circles about its axis of circles about its axis.
bool is_right_circular(const Cone& cone);
/// The same but for what the rounding of a rotation to six digits, as OpenSCAD writes it, makes of them.
bool is_nearly_round(const Cone& cone);

bool is_sphere(const Ellipsoid& shape);
bool are_equal(const Ellipsoid& a, const Ellipsoid& b);
bool are_equal(const Torus& a, const Torus& b);

/// Whether an end of a cone, the lower or the upper one, and one of another are one circle, or one image of a
/// circle under the same affine map.
bool are_ends_equal(const Cone& a, bool end_of_a, const Cone& b, bool end_of_b);

/// Where a plane, given by a normal and a point, touches a cylinder: the direction from the axis in the
/// cylinder's own coordinates.
std::optional<Eigen::Vector2d> touching_direction(const Cone& cylinder, const Point& normal, const Point& p);
/// Where a straight edge lies on a cylinder.
std::optional<Eigen::Vector2d> touching_direction_of_edge(const Cone& cylinder, const Point& a,
                                                          const Point& b);

}  // namespace maille::modeler
