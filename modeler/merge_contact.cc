#include "modeler/merge_contact.hh"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "volmesh/tet_topology.hh"

namespace maille::modeler {
namespace {

using Eigen::Vector3d;

struct Interval {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
};

Interval shadow(std::span<const Vector3d> points, const Vector3d& origin, const Vector3d& axis) {
    Interval interval;
    for (const Vector3d& p : points) {
        const double along = (p - origin).dot(axis);
        interval.low = std::min(interval.low, along);
        interval.high = std::max(interval.high, along);
    }
    return interval;
}

}  // namespace

bool may_touch(const std::array<Vector3d, 4>& cell, const std::array<Vector3d, 3>& triangle, double margin) {
    const auto separates = [&](const Vector3d& axis) {
        const double length = axis.norm();
        if (length == 0) return false;
        const Interval a = shadow(cell, cell[0], axis), b = shadow(triangle, cell[0], axis);
        return std::max(b.low - a.high, a.low - b.high) > margin * length;
    };
    // Two convex bodies are apart if and only if the normal of a face of one, or of an edge of each,
    // separates them.
    std::array<Vector3d, 3> sides;
    for (int i = 0; i < 3; ++i) sides[i] = triangle[(i + 1) % 3] - triangle[i];
    if (separates(sides[0].cross(sides[1]))) return false;
    for (const auto& f : volmesh::tet::face_vertices)
        if (separates((cell[f[1]] - cell[f[0]]).cross(cell[f[2]] - cell[f[0]]))) return false;
    for (const auto& e : volmesh::tet::edge_vertices)
        for (const Vector3d& side : sides)
            if (separates((cell[e[1]] - cell[e[0]]).cross(side))) return false;
    return true;
}

}  // namespace maille::modeler
