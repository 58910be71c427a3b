#include "modeler/profile.hh"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace maille::modeler {
namespace {

constexpr double full = 2 * std::numbers::pi;

double cross(const Point2& a, const Point2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// Whether a ray to the right passes the straight way between the ends.
bool is_passed(const ProfileEdge& edge, const Point2& q) {
    const Point2 &a = edge.from, &b = edge.to;
    return (a.y() <= q.y()) != (b.y() <= q.y()) &&
           a.x() + (q.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > q.x();
}

/// Whether the point is between an arc and the straight way between its ends.
bool in_segment(const ProfileEdge& arc, const Point2& q) {
    if ((q - *arc.centre).norm() >= arc.radius()) return false;
    if (arc.from == arc.to) return true;
    const double side = cross(arc.to - arc.from, q - arc.from);
    return arc.clockwise ? side > 0 : side < 0;
}

}  // namespace

double ProfileEdge::start_angle() const {
    const Point2 start = from - *centre;
    return std::atan2(start.y(), start.x());
}

double ProfileEdge::sweep() const {
    if (from == to) return clockwise ? -full : full;
    const Point2 start = from - *centre, end = to - *centre;
    const double angle = std::atan2(cross(start, end), start.dot(end));
    if (clockwise) return angle >= 0 ? angle - full : angle;
    return angle <= 0 ? angle + full : angle;
}

double ProfileEdge::length() const {
    return centre ? radius() * std::abs(sweep()) : (to - from).norm();
}

Point2 ProfileEdge::at(double t) const {
    if (t == 0) return from;
    if (t == 1) return to;
    if (!centre) return from + t * (to - from);
    const double angle = start_angle() + t * sweep();
    return *centre + radius() * Point2(std::cos(angle), std::sin(angle));
}

bool faces_arc(const ProfileEdge& arc, const Point2& q) {
    if (arc.from == arc.to) return true;
    const Point2 direction = q - *arc.centre;
    double angle = std::atan2(direction.y(), direction.x()) - arc.start_angle();
    if (arc.clockwise) angle = -angle;
    angle -= full * std::floor(angle / full);
    return angle <= std::abs(arc.sweep());
}

double distance(const ProfileEdge& edge, const Point2& q) {
    if (edge.centre && faces_arc(edge, q)) return std::abs((q - *edge.centre).norm() - edge.radius());
    if (edge.centre) return std::min((q - edge.from).norm(), (q - edge.to).norm());
    const Point2 way = edge.to - edge.from;
    const double t = std::clamp((q - edge.from).dot(way) / way.squaredNorm(), 0.0, 1.0);
    return (edge.from + t * way - q).norm();
}

bool surrounds(const Profile& profile, const Point2& q) {
    bool inside = false;
    for (const auto& loop : profile)
        for (const ProfileEdge& edge : loop) {
            inside ^= is_passed(edge, q);
            if (edge.centre) inside ^= in_segment(edge, q);
        }
    return inside;
}

}  // namespace maille::modeler
