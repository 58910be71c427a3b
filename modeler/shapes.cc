#include "modeler/shapes.hh"

#include <fmt/format.h>

#include "modeler/shape_cone.hh"
#include "modeler/shape_ellipsoid.hh"
#include "modeler/shape_frame.hh"
#include "modeler/shape_torus.hh"
#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

using Loop = std::vector<std::uint32_t>;

/// The solid between two loops of n points: the lower ones 0 to n - 1, the upper ones n to 2n - 1, or a
/// single tip n. The sides come first, then the bottom, then the top.
std::vector<Loop> loft(std::uint32_t n, bool to_tip) {
    std::vector<Loop> faces;
    Loop bottom, top;
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t next = (i + 1) % n;
        faces.push_back(to_tip ? Loop{i, next, n} : Loop{i, next, n + next, n + i});
        bottom.push_back(n - 1 - i);
        top.push_back(n + i);
    }
    faces.push_back(bottom);
    if (!to_tip) faces.push_back(top);
    return faces;
}

std::vector<std::string> loft_names(std::uint32_t n, bool to_tip) {
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < n; ++i) names.push_back(fmt::format("side{}", i));
    names.emplace_back("bottom");
    if (!to_tip) names.emplace_back("top");
    return names;
}

std::vector<Point> regular_polygon(int n, double radius) {
    if (n < 3) throw InputError(fmt::format("the number of sides is {}; it has to be at least 3", n));
    check_positive(radius, "the radius");
    std::vector<Point> corners;
    for (int i = 0; i < n; ++i) {
        const Eigen::Vector2d corner = radius * unit_circle(i, n);
        corners.emplace_back(corner.x(), corner.y(), 0);
    }
    return corners;
}

void check_size(const Eigen::Vector3d& size) {
    check_positive(size.x(), "the size in x");
    check_positive(size.y(), "the size in y");
    check_positive(size.z(), "the size in z");
}

/// A hexahedron of six planar faces, its points in the order of the bits of their number (x the lowest).
std::shared_ptr<const Shape> make_box(const std::vector<Point>& points, const std::vector<std::string>& names,
                                      const Eigen::Affine3d& frame) {
    const std::vector<Loop> faces{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                  {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    return make_polyhedron(points, faces, names, frame);
}

const std::vector<std::string>& box_face_names() {
    static const std::vector<std::string> names{"x-", "x+", "y-", "y+", "z-", "z+"};
    return names;
}

}  // namespace

std::shared_ptr<const Shape> make_cube(const Eigen::Vector3d& size, bool center,
                                       const Eigen::Affine3d& frame) {
    check_size(size);
    const Point low = center ? Point(-size / 2) : Point::Zero();
    const Eigen::AlignedBox3d box(low, low + size);
    std::vector<Point> points;
    for (int i = 0; i < 8; ++i) points.push_back(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
    return make_box(points, box_face_names(), frame);
}

std::shared_ptr<const Shape> make_wedge(const Eigen::Vector3d& size, double dx,
                                        const Eigen::Affine3d& frame) {
    check_size(size);
    check_not_negative(dx, "the width dx of the top");
    std::vector<Point> points;
    for (int i = 0; i < 8; ++i) {
        const bool top = i & 4;
        const double width = top ? dx : size.x();
        points.emplace_back(i & 1 ? width : 0, i & 2 ? size.y() : 0, top ? size.z() : 0);
    }
    return make_box(points, box_face_names(), frame);  // a top without width is dropped there
}

std::shared_ptr<const Shape> make_prism(int n, double radius, double height, const Eigen::Affine3d& frame) {
    check_positive(height, "the height");
    std::vector<Point> points = regular_polygon(n, radius);
    for (int i = 0; i < n; ++i) points.emplace_back(points[i].x(), points[i].y(), height);
    const auto sides = static_cast<std::uint32_t>(n);
    return make_polyhedron(points, loft(sides, false), loft_names(sides, false), frame);
}

std::shared_ptr<const Shape> make_pyramid(int n, double radius, double height, const Eigen::Affine3d& frame) {
    check_positive(height, "the height");
    std::vector<Point> points = regular_polygon(n, radius);
    points.emplace_back(0, 0, height);
    const auto sides = static_cast<std::uint32_t>(n);
    return make_polyhedron(points, loft(sides, true), loft_names(sides, true), frame);
}

std::shared_ptr<const Shape> make_tetrahedron(const std::array<Point, 4>& points,
                                              const Eigen::Affine3d& frame) {
    return make_polyhedron({points.begin(), points.end()}, {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}},
                           {"face0", "face1", "face2", "face3"}, frame);
}

std::shared_ptr<const Shape> make_halfspace(const Point& point, const Eigen::Vector3d& normal,
                                            const Eigen::AlignedBox3d& clip, const Eigen::Affine3d& frame) {
    check_frame(frame);
    if (!point.allFinite()) throw InputError("the point of the half-space is not finite");
    if (!normal.allFinite() || !(normal.norm() > 0))
        throw InputError("the normal of the half-space has to be a vector longer than 0");
    if (clip.isEmpty()) throw InputError("a half-space needs something to cut");
    const Plane plane(frame * point, frame.linear().inverse().transpose() * normal);

    // In the plane's coordinates: what is behind it in the box, and a margin.
    const double margin = clip.diagonal().norm() / 16;
    Eigen::AlignedBox2d extent;
    double depth = 0;
    for (int i = 0; i < 8; ++i) {
        const Point corner = clip.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
        extent.extend(plane.flatten(corner));
        depth = std::max(depth, -plane.distance(corner));
    }
    depth += margin;
    const Eigen::Vector2d low = extent.min().array() - margin, high = extent.max().array() + margin;
    std::vector<Point> points;
    for (bool back : {true, false})
        for (const Eigen::Vector2d& q : {low, {high.x(), low.y()}, high, {low.x(), high.y()}})
            points.push_back(plane.unflatten(q) - (back ? depth : 0) * plane.normal());
    std::vector<Loop> faces = loft(4, false);
    std::ranges::rotate(faces, faces.end() - 1);  // the top, which is the plane, to the front
    return make_polyhedron(points, faces, {"plane", "clip1", "clip2", "clip3", "clip4", "clip5"});
}

std::shared_ptr<const Shape> make_sphere(double radius, const Eigen::Affine3d& frame) {
    check_positive(radius, "the radius");
    return std::make_shared<Ellipsoid>(frame * Eigen::Scaling(radius));
}

std::shared_ptr<const Shape> make_ellipsoid(const Eigen::Vector3d& semi_axes, const Eigen::Affine3d& frame) {
    check_positive(semi_axes.x(), "the semi-axis in x");
    check_positive(semi_axes.y(), "the semi-axis in y");
    check_positive(semi_axes.z(), "the semi-axis in z");
    return std::make_shared<Ellipsoid>(frame * Eigen::Scaling(semi_axes));
}

std::shared_ptr<const Shape> make_cylinder(double height, double r1, double r2, bool center,
                                           const Eigen::Affine3d& frame) {
    check_positive(height, "the height");
    check_not_negative(r1, "the radius at the bottom");
    check_not_negative(r2, "the radius at the top");
    const double largest = std::max(r1, r2);
    if (largest == 0) throw InputError("both radii of the cylinder are 0");
    const Eigen::Translation3d down(0, 0, center ? -height / 2 : 0);
    return std::make_shared<Cone>(r1 / largest, r2 / largest,
                                  frame * down * Eigen::Scaling(largest, largest, height));
}

std::shared_ptr<const Shape> make_torus(double major, double minor, const Eigen::Affine3d& frame) {
    check_positive(major, "the major radius");
    check_positive(minor, "the minor radius");
    if (!(minor < major))
        throw InputError(
            fmt::format("the minor radius {} has to be less than the major radius {}", minor, major));
    return std::make_shared<Torus>(major, minor, frame);
}

}  // namespace maille::modeler
