#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "modeler/geo_curve.hh"
#include "modeler/shape_plane.hh"

namespace maille::modeler {

/// A primitive of Netgen's, which may have no end. Faces of the shape that are not its own only cut off what
/// has no end, or are the ends of an extrusion.
struct GeoBody {
    /// The image of what matters of it in a box, and somewhat more.
    std::function<std::shared_ptr<const Shape>(const Eigen::Affine3d& map, const Eigen::AlignedBox3d& box)>
        shape;
    /// Planes that its image is behind.
    std::function<std::vector<Plane>(const Eigen::Affine3d& map)> outer;
    std::vector<std::string> faces;  ///< its own, in Netgen's order
    bool is_endless = false;
};

/// A body with an end, from the function that makes its image.
GeoBody finite_body(std::function<std::shared_ptr<const Shape>(const Eigen::Affine3d& map)> make,
                    std::vector<std::string> faces);
std::vector<std::string> numbered_faces(const char* name, std::size_t n);

/// Each takes what stands in the parentheses in the file, and throws InputError where that makes no solid.
GeoBody geo_plane(const Point& point, const Point& normal);
GeoBody geo_sphere(const Point& centre, double radius);
GeoBody geo_cylinder(const Point& a, const Point& b, double radius);
/// The half on which the radius is positive.
GeoBody geo_cone(const Point& a, double radius_a, const Point& b, double radius_b);
GeoBody geo_elliptic_cylinder(const Point& centre, const Point& longer, const Point& shorter);
/// At the height `h` above the base the axes are `ratio` times those at the base.
GeoBody geo_elliptic_cone(const Point& base, const Point& longer, const Point& shorter, double h,
                          double ratio);
GeoBody geo_ellipsoid(const Point& centre, const std::array<Point, 3>& axes);
GeoBody geo_brick(const Point& low, const Point& high);
GeoBody geo_torus(const Point& centre, const Point& normal, double major, double minor);
/// Faces of three or four points, numbered from 0.
GeoBody geo_polyhedron(const std::vector<Point>& points,
                       const std::vector<std::vector<std::uint32_t>>& faces);
/// The curve's x runs from a towards b, its y is the distance from that axis. It is closed, or ends on the
/// axis.
GeoBody geo_revolution(const Point& a, const Point& b, const GeoCurve<2>& curve);
/// The profile's y points as far as it can along z. Curves are chords, each of which turns by 7.5 degrees at
/// most.
GeoBody geo_extrusion(const GeoCurve<3>& path, const GeoCurve<2>& profile, const Point& z);

}  // namespace maille::modeler
