#include "modeler/geo_body.hh"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>

#include "modeler/geo_bounds.hh"
#include "modeler/shape_frame.hh"
#include "modeler/shape_turned.hh"
#include "modeler/shapes.hh"
#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

using Eigen::Affine3d;
using Eigen::AlignedBox3d;

/// Takes the z axis to the direction, the origin to the point.
Affine3d upright(const Point& origin, const Point& direction) {
    if (!(direction.norm() > 0)) throw InputError("the direction of its axis is 0");
    Affine3d frame = Affine3d::Identity();
    const Point z = direction.normalized();
    Eigen::Index least = 0;
    z.cwiseAbs().minCoeff(&least);
    const Point x = Point::Unit(least).cross(z).normalized();
    frame.linear() << x, z.cross(x), z;
    frame.translation() = origin;
    return frame;
}

/// What is within r0 + r1 z of the z axis of a frame.
GeoBody endless_cone(const Affine3d& frame, double r0, double r1) {
    const auto shape = [=](const Affine3d& map, const AlignedBox3d& box) {
        const Affine3d placed = map * frame, back = placed.inverse();
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (int i = 0; i < 8; ++i) {
            const Point corner = back * box.corner(static_cast<AlignedBox3d::CornerType>(i));
            low = std::min(low, corner.z());
            high = std::max(high, corner.z());
        }
        const double margin = (high - low) / 16;
        low -= margin;
        high += margin;
        const double apex = -r0 / r1;
        if (r1 > 0) low = std::max(low, apex);
        if (r1 < 0) high = std::min(high, apex);
        if (!(low < high)) throw InputError("the cone does not come near what it is combined with");
        const auto radius = [&](double z) { return r1 != 0 && z == apex ? 0 : r0 + r1 * z; };
        return make_cylinder(high - low, radius(low), radius(high), false,
                             placed * Eigen::Translation3d(0, 0, low));
    };
    const auto outer = [=](const Affine3d& map) {
        const Affine3d placed = map * frame;
        const Eigen::Matrix3d to_normals = placed.linear().inverse().transpose();
        std::vector<Plane> planes;
        for (const Eigen::Vector2d& side :
             {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(-1, 0), Eigen::Vector2d(0, -1)})
            planes.emplace_back(placed * Point(r0 * side.x(), r0 * side.y(), 0),
                                to_normals * Point(side.x(), side.y(), -r1));
        return planes;
    };
    return {.shape = shape, .outer = outer, .faces = {"side"}, .is_endless = true};
}

/// The frame in which the ellipse of those axes is the unit circle.
Affine3d elliptic_frame(const Point& centre, const Point& longer, const Point& shorter) {
    const Point normal = longer.cross(shorter);
    if (!(normal.norm() > 0))
        throw InputError("the axes of its ellipse have to differ in direction, and not be 0");
    Eigen::Matrix3d back;
    back << longer.transpose() / longer.squaredNorm(), shorter.transpose() / shorter.squaredNorm(),
        normal.normalized().transpose();
    Affine3d frame = Affine3d::Identity();
    frame.linear() = back.inverse();
    frame.translation() = centre;
    return frame;
}

}  // namespace

std::vector<std::string> numbered_faces(const char* name, std::size_t n) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < n; ++i) names.push_back(fmt::format("{}{}", name, i));
    return names;
}

GeoBody finite_body(std::function<std::shared_ptr<const Shape>(const Affine3d&)> make,
                    std::vector<std::string> faces) {
    make(Affine3d::Identity());  // throws what is wrong with it now
    return {.shape = [make](const Affine3d& map, const AlignedBox3d&) { return make(map); },
            .outer = [make](const Affine3d& map) { return planes_of(make(map)->bounding_box()); },
            .faces = std::move(faces)};
}

GeoBody geo_plane(const Point& point, const Point& normal) {
    if (!(normal.norm() > 0)) throw InputError("its normal is 0");
    const auto plane = [=](const Affine3d& map) {
        return Plane(map * point, map.linear().inverse().transpose() * normal);
    };
    const auto shape = [=](const Affine3d& map, AlignedBox3d box) {
        // Larger than the box, and cut by the plane, so that the piece's other faces come near nothing.
        box.extend(plane(map).project(box.center()));
        const Point margin = Point::Constant(box.diagonal().norm() / 10);
        return make_halfspace(point, normal, {box.min() - margin, box.max() + margin}, map);
    };
    return {.shape = shape,
            .outer = [=](const Affine3d& map) { return std::vector{plane(map)}; },
            .faces = {"plane"},
            .is_endless = true};
}

GeoBody geo_sphere(const Point& centre, double radius) {
    return finite_body(
        [=](const Affine3d& map) { return make_sphere(radius, map * Eigen::Translation3d(centre)); },
        {"surface"});
}

GeoBody geo_cylinder(const Point& a, const Point& b, double radius) {
    check_positive(radius, "its radius");
    return endless_cone(upright(a, b - a), radius, 0);
}

GeoBody geo_cone(const Point& a, double radius_a, const Point& b, double radius_b) {
    check_not_negative(radius_a, "its first radius");
    check_not_negative(radius_b, "its second radius");
    if (radius_a == 0 && radius_b == 0) throw InputError("both its radii are 0");
    return endless_cone(upright(a, b - a), radius_a, (radius_b - radius_a) / (b - a).norm());
}

GeoBody geo_elliptic_cylinder(const Point& centre, const Point& longer, const Point& shorter) {
    return endless_cone(elliptic_frame(centre, longer, shorter), 1, 0);
}

GeoBody geo_elliptic_cone(const Point& base, const Point& longer, const Point& shorter, double h,
                          double ratio) {
    check_positive(h, "its height");
    check_not_negative(ratio, "the ratio of its axes");
    return endless_cone(elliptic_frame(base, longer, shorter), 1, (ratio - 1) / h);
}

GeoBody geo_ellipsoid(const Point& centre, const std::array<Point, 3>& axes) {
    Eigen::Matrix3d back;
    for (int i = 0; i < 3; ++i) back.row(i) = axes[i].transpose() / axes[i].squaredNorm();
    if (!back.allFinite() || back.determinant() == 0)
        throw InputError("its axes have to differ in direction, and not be 0");
    Affine3d frame = Affine3d::Identity();
    frame.linear() = back.inverse();
    frame.translation() = centre;
    return finite_body([=](const Affine3d& map) { return make_sphere(1, map * frame); }, {"surface"});
}

GeoBody geo_brick(const Point& low, const Point& high) {
    if (!((high - low).minCoeff() > 0))
        throw InputError("its second corner has to be beyond the first in x, y and z");
    return finite_body(
        [=](const Affine3d& map) { return make_cube(high - low, false, map * Eigen::Translation3d(low)); },
        {"z-", "z+", "y-", "y+", "x-", "x+"});
}

GeoBody geo_torus(const Point& centre, const Point& normal, double major, double minor) {
    return finite_body([frame = upright(centre, normal), major,
                        minor](const Affine3d& map) { return make_torus(major, minor, map * frame); },
                       {"surface"});
}

GeoBody geo_polyhedron(const std::vector<Point>& points,
                       const std::vector<std::vector<std::uint32_t>>& faces) {
    std::vector<PolyhedronFace> polygons;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const std::string name = fmt::format("face{}", i);
        const auto& f = faces[i];
        for (const std::uint32_t v : f)
            if (v >= points.size())
                throw InputError(
                    fmt::format("there is no point {}: the {} points count from 1", v + 1, points.size()));
        if (f.size() == 4) {
            // Where it is not planar, the diagonal is the one from the first point.
            const Point normal =
                (points[f[1]] - points[f[0]]).cross(points[f[2]] - points[f[0]]).normalized();
            const Point diagonal = points[f[3]] - points[f[0]];
            if (std::abs(normal.dot(diagonal)) > 1e-13 * (diagonal.norm() + points[f[0]].norm())) {
                polygons.push_back({{{f[0], f[1], f[2]}}, name});
                polygons.push_back({{{f[0], f[2], f[3]}}, name});
                continue;
            }
        }
        polygons.push_back({{f}, name});
    }
    return finite_body([=](const Affine3d& map) { return make_polyhedron(points, polygons, map); },
                       numbered_faces("face", faces.size()));
}

GeoBody geo_revolution(const Point& a, const Point& b, const GeoCurve<2>& curve) {
    std::vector<ProfileEdge> edges = edges_of(curve, true);
    const auto swap = [](Point2& p) { p = Point2(p.y(), p.x()); };
    for (ProfileEdge& edge : edges) {
        swap(edge.from);
        swap(edge.to);
        if (edge.centre) swap(*edge.centre);
        edge.clockwise = !edge.clockwise;
    }
    const double size = (edges.front().from - edges.back().to).norm();
    const bool ends_on_axis =
        std::abs(edges.front().from.x()) <= 1e-12 * size && std::abs(edges.back().to.x()) <= 1e-12 * size;
    if (size > 0 && !ends_on_axis)
        throw InputError("its curve has to be closed, or to start and end on the axis, where y is 0");
    if (area_within(edges) < 0) turn_back(edges);
    if (size > 0) edges.push_back({.from = edges.back().to, .to = edges.front().from, .name = "axis"});
    return finite_body([frame = upright(a, b - a),
                        edges](const Affine3d& map) { return make_turned({edges}, 360, map * frame); },
                       numbered_faces("side", curve.size()));
}

}  // namespace maille::modeler
