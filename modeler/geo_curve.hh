#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "modeler/profile.hh"

namespace maille::modeler {

/// A piece of a curve of Netgen's: straight from `a` to `c`, or the conic from `a` to `c` whose end tangents
/// meet in `b`, with the weight that makes it an arc of a circle where both tangents are equally long.
template <int N>
struct GeoSegment {
    using P = Eigen::Vector<double, N>;
    P a, b, c;
    bool is_straight = true;

    bool is_arc() const {
        const double first = (b - a).norm(), second = (c - b).norm();
        return !is_straight && std::abs(first - second) <= 1e-12 * (first + second);
    }
    P at(double t) const {
        if (t == 0) return a;
        if (t == 1) return c;
        if (is_straight) return a + t * (c - a);
        const double u = (1 - t) * (1 - t), v = weight() * t * (1 - t), w = t * t;
        return (u * a + v * b + w * c) / (u + v + w);
    }
    P tangent(double t) const {
        if (is_straight) return (c - a).normalized();
        if (t == 0) return (b - a).normalized();
        if (t == 1) return (c - b).normalized();
        const double k = weight();
        return ((1 - t) * ((k - 2) * t - k) * a + k * (1 - 2 * t) * b + t * ((k - 2) * t + 2) * c)
            .normalized();
    }
    /// By how much the direction changes, in radians.
    double turn() const {
        return is_straight ? 0 : std::acos(std::clamp(tangent(0).dot(tangent(1)), -1.0, 1.0));
    }
    double weight() const {
        return (c - a).norm() / std::sqrt(((b - a).squaredNorm() + (c - b).squaredNorm()) / 2);
    }
};

template <int N>
using GeoCurve = std::vector<GeoSegment<N>>;

/// By how much the chords of a curve turn at most: 7.5 degrees.
inline constexpr double finest_turn = 0.1308996938995747;

/// A curve as edges named `side<i>` by the segment, in the given coordinates: arcs of circles as arcs where
/// `keep_arcs`, everything else that is curved as chords, each of which turns by `finest_turn` at most.
std::vector<ProfileEdge> edges_of(const GeoCurve<2>& curve, bool keep_arcs);

/// Twice the area within the edges, whose ends are joined; negative where they run clockwise.
double area_within(const std::vector<ProfileEdge>& edges);

/// The other way round.
void turn_back(std::vector<ProfileEdge>& edges);

}  // namespace maille::modeler
