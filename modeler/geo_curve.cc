#include "modeler/geo_curve.hh"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace maille::modeler {
namespace {

double cross(const Point2& a, const Point2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// The centre of the circle that touches both tangents in the ends.
Point2 centre_of(const GeoSegment<2>& arc) {
    const Point2 first = arc.b - arc.a, second = arc.c - arc.b;
    const Point2 normal(-first.y(), first.x());
    // On the normal in a, as far as the bisector in b.
    const double half = std::atan2(std::abs(cross(first, second)), first.dot(second)) / 2;
    const double radius = first.norm() / std::tan(half);
    return arc.a + (cross(first, second) > 0 ? radius : -radius) * normal.normalized();
}

}  // namespace

std::vector<ProfileEdge> edges_of(const GeoCurve<2>& curve, bool keep_arcs) {
    std::vector<ProfileEdge> edges;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        const GeoSegment<2>& segment = curve[i];
        const std::string name = fmt::format("side{}", i);
        const bool bends = std::abs(cross(segment.b - segment.a, segment.c - segment.b)) >
                           1e-12 * (segment.c - segment.a).squaredNorm();
        if (keep_arcs && segment.is_arc() && bends) {
            edges.push_back({.from = segment.a,
                             .to = segment.c,
                             .name = name,
                             .centre = centre_of(segment),
                             .clockwise = cross(segment.b - segment.a, segment.c - segment.b) < 0});
            continue;
        }
        const int n = bends && !segment.is_straight
                          ? std::max(2, static_cast<int>(std::ceil(segment.turn() / finest_turn)))
                          : 1;
        for (int k = 0; k < n; ++k)
            edges.push_back({.from = segment.at(static_cast<double>(k) / n),
                             .to = segment.at(static_cast<double>(k + 1) / n),
                             .name = name});
    }
    return edges;
}

double area_within(const std::vector<ProfileEdge>& edges) {
    double sum = 0;
    for (const ProfileEdge& edge : edges) {
        sum += cross(edge.from, edge.to);
        if (!edge.centre) continue;
        const double sweep = edge.sweep();
        sum += std::pow(edge.radius(), 2) * (sweep - std::sin(sweep));
    }
    return sum + cross(edges.back().to, edges.front().from);
}

void turn_back(std::vector<ProfileEdge>& edges) {
    std::ranges::reverse(edges);
    for (ProfileEdge& edge : edges) {
        std::swap(edge.from, edge.to);
        edge.clockwise = !edge.clockwise;
    }
}

}  // namespace maille::modeler
