#include "modeler/shape_turned.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/LU>

#include "modeler/openscad_facets.hh"
#include "modeler/shape_frame.hh"

namespace maille::modeler {

Turned::Turned(Profile profile, double span, const std::array<std::string, 2>& cap_names,
               const Eigen::Affine3d& map)
    : profile_(std::move(profile)),
      span_(span),
      map_((check_frame(map), map)),
      inverse_(map.inverse()),
      least_stretch_(smallest_stretch(map.linear())) {
    for (const auto& loop : profile_)
        for (const ProfileEdge& edge : loop) {
            size_ = std::max(size_, edge.from.cwiseAbs().maxCoeff());
            if (!edge.on_axis()) add_edge(edge);
        }
    if (is_full()) return;
    for (const bool end : {false, true}) {
        const double angle = end ? span : 0, outwards = end ? 1 : -1;
        const Point normal = outwards * Point(-sin_degrees(angle), cos_degrees(angle), 0);
        faces_.push_back({cap_names[end], true});
        surfaces_.emplace_back(Plane(map.translation(), inverse_.linear().transpose() * normal));
    }
}

void Turned::add_edge(const ProfileEdge& edge) {
    const double rise = edge.to.y() - edge.from.y();
    faces_.push_back({edge.name, !edge.centre && rise == 0});
    if (edge.centre) {
        surfaces_.emplace_back(TurnedArc(*edge.centre, edge.radius(), !edge.clockwise, map_));
    } else if (rise == 0) {
        const double outwards = edge.to.x() > edge.from.x() ? -1 : 1;
        surfaces_.emplace_back(
            Plane(map_ * Point(0, 0, edge.from.y()), outwards * inverse_.linear().transpose().col(2)));
    } else {
        const Point2& low = rise > 0 ? edge.from : edge.to;
        const Point2& high = rise > 0 ? edge.to : edge.from;
        const double widest = std::max(low.x(), high.x());
        const Eigen::Affine3d in_space =
            map_ * Eigen::Translation3d(0, 0, low.y()) * Eigen::Scaling(widest, widest, std::abs(rise));
        surfaces_.emplace_back(
            Side{ConeSide(low.x() / widest, high.x() / widest, in_space), rise > 0 ? 1.0 : -1.0});
    }
}

/// Of the turned profile: the greatest value of direction * (x, y, z).
double Turned::farthest_along(const Eigen::RowVector3d& direction) const {
    const auto at_angle = [&](double degrees) {
        return direction.x() * cos_degrees(degrees) + direction.y() * sin_degrees(degrees);
    };
    const double best_angle = std::atan2(direction.y(), direction.x()) * 180 / std::numbers::pi;
    const double turned = best_angle < 0 ? best_angle + 360 : best_angle;
    const double outwards = is_full() || turned <= span_ ? std::hypot(direction.x(), direction.y())
                                                         : std::max(at_angle(0), at_angle(span_));
    const Point2 in_plane(outwards, direction.z());
    double farthest = -std::numeric_limits<double>::infinity();
    for (const auto& loop : profile_)
        for (const ProfileEdge& edge : loop) {
            farthest = std::max(farthest, in_plane.dot(edge.from));
            if (!edge.centre) continue;
            const Point2 summit = *edge.centre + edge.radius() * in_plane.stableNormalized();
            if (faces_arc(edge, summit)) farthest = std::max(farthest, in_plane.dot(summit));
        }
    return farthest;
}

Eigen::AlignedBox3d Turned::bounding_box() const {
    Point low, high;
    for (int axis = 0; axis < 3; ++axis) {
        const Eigen::RowVector3d direction = map_.linear().row(axis);
        low[axis] = map_.translation()[axis] - farthest_along(-direction);
        high[axis] = map_.translation()[axis] + farthest_along(direction);
    }
    return {low, high};
}

double Turned::implicit(const Point& p) const {
    const Point reference = inverse_ * p;
    const Point2 q(reference.head<2>().norm(), reference.z());
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& loop : profile_)
        for (const ProfileEdge& edge : loop)
            if (!edge.on_axis()) nearest = std::min(nearest, distance(edge, q));
    // Edges on the axis bound the profile, but not the solid.
    const bool inside = surrounds(profile_, Point2(std::max(q.x(), 1e-14 * size_), q.y()));
    const double from_profile = least_stretch_ * (inside ? -nearest : nearest);
    if (is_full()) return from_profile;
    const double from_start = plane(cap(false)).distance(p), from_end = plane(cap(true)).distance(p);
    return std::max(from_profile,
                    span_ <= 180 ? std::max(from_start, from_end) : std::min(from_start, from_end));
}

namespace {

template <class... Visitors>
struct Overloaded : Visitors... {
    using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

}  // namespace

double Turned::face_implicit(std::uint32_t face, const Point& p) const {
    return std::visit(Overloaded{[&](const Plane& plane) { return plane.distance(p); },
                                 [&](const Side& side) { return side.sense * side.cone.implicit(p); },
                                 [&](const TurnedArc& arc) { return arc.implicit(p); }},
                      surfaces_[face]);
}

Point Turned::face_normal(std::uint32_t face, const Point& p) const {
    return std::visit(Overloaded{[&](const Plane& plane) { return plane.normal(); },
                                 [&](const Side& side) -> Point { return side.sense * side.cone.normal(p); },
                                 [&](const TurnedArc& arc) { return arc.normal(p); }},
                      surfaces_[face]);
}

Eigen::Matrix3d Turned::face_curvature(std::uint32_t face, const Point& p) const {
    return std::visit(
        Overloaded{[&](const Plane&) -> Eigen::Matrix3d { return Eigen::Matrix3d::Zero(); },
                   [&](const Side& side) -> Eigen::Matrix3d { return side.sense * side.cone.curvature(p); },
                   [&](const TurnedArc& arc) { return arc.curvature(p); }},
        surfaces_[face]);
}

Point Turned::project(std::uint32_t face, const Point& p) const {
    return std::visit(Overloaded{[&](const Plane& plane) { return plane.project(p); },
                                 [&](const Side& side) { return side.cone.project(p); },
                                 [&](const TurnedArc& arc) { return arc.project(p); }},
                      surfaces_[face]);
}

double Turned::max_curvature(std::uint32_t face) const {
    return std::visit(Overloaded{[&](const Plane&) { return 0.0; },
                                 [&](const Side& side) { return side.cone.max_curvature(); },
                                 [&](const TurnedArc& arc) {
                                     // Around the tube or, where that is less than its radius, around the
                                     // hole.
                                     const double hole = arc.centre().x() - arc.radius();
                                     const double thinnest =
                                         hole > 0 ? std::min(arc.radius(), hole) : arc.radius();
                                     return 1 / (least_stretch_ * thinnest);
                                 }},
                      surfaces_[face]);
}

}  // namespace maille::modeler
