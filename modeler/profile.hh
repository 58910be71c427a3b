#pragma once

#include <optional>
#include <string>
#include <vector>

#include "modeler/outline.hh"

namespace maille::modeler {

/// A straight edge or an arc in the half-plane of points (distance from an axis, height). What it bounds is
/// on its left.
struct ProfileEdge {
    Point2 from, to;  ///< equal for a whole circle
    std::string name;
    std::optional<Point2> centre{};  ///< of an arc
    bool clockwise = false;          ///< how an arc runs round its centre

    double radius() const { return (from - *centre).norm(); }
    double start_angle() const;
    double sweep() const;  ///< of an arc, in radians; negative where it is clockwise
    double length() const;
    Point2 at(double t) const;  ///< from 0 to 1
    bool on_axis() const { return from.x() == 0 && to.x() == 0 && !centre; }

    friend bool operator==(const ProfileEdge&, const ProfileEdge&) = default;
};

/// Loops of edges: an outline, counter-clockwise, and holes, clockwise. They don't meet.
using Profile = std::vector<std::vector<ProfileEdge>>;

/// Whether the direction of `q` from the centre of an arc is one of the arc's.
bool faces_arc(const ProfileEdge& arc, const Point2& q);

double distance(const ProfileEdge& edge, const Point2& q);

/// Whether the point is inside an odd number of the loops.
bool surrounds(const Profile& profile, const Point2& q);

}  // namespace maille::modeler
