#pragma once

#include <optional>
#include <span>
#include <vector>

#include "modeler/primitive.hh"

namespace maille::modeler {

class Cone;

/// A surface of revolution in a frame: the ellipse (r, z) = centre + semi * (cos angle, sin angle), turned
/// about the z axis. Of an ellipsoid's, which is centred on the axis, only r >= 0 counts.
struct Meridian {
    Eigen::Vector2d centre, semi;

    bool is_torus() const { return centre.x() > 0; }
    Eigen::Vector2d at(double angle) const;
    /// Of the point of the ellipse in the direction of p, as seen where it is a circle: from -pi to pi.
    double angle_of(const Eigen::Vector2d& p) const;
    /// How far p is outside, in parts of the semi-axes.
    double distance(const Eigen::Vector2d& p) const;
};

/// The meridian of an ellipsoid or torus in a frame of which the z axis is its axis; nothing where it is no
/// surface of revolution there, or a shape of another kind.
std::optional<Meridian> meridian_in(const Eigen::Affine3d& frame, const Shape& shape);

/// A frame in which both shapes have meridians, if there is one: surfaces of revolution, or images of such
/// under one affine map. For ellipsoids and tori.
std::optional<Eigen::Affine3d> common_frame(const Shape& a, const Shape& b);

/// A circle about the z axis where a meridian's surface and another one touch.
struct TouchingCircle {
    double angle;  ///< of the meridian
    double other;  ///< the height on a cone; the angle of another meridian
};

/// Where the side of a cone, given in its own frame between heights, touches the surface, or where one of the
/// `rims`, at these heights, lies on it.
std::vector<TouchingCircle> touching_circles(const Meridian& meridian, const Cone& cone, double low,
                                             double high, std::span<const double> rims);
std::vector<TouchingCircle> touching_circles(const Meridian& meridian, const Meridian& other);
/// Where the plane at that height touches a torus.
std::optional<double> touching_angle(const Meridian& meridian, double height);

}  // namespace maille::modeler
