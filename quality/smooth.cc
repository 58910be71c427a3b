#include "quality/smooth.hh"

#include <algorithm>
#include <cmath>

namespace maille::quality {
namespace {

/// Steps of ascent at one visit, and halvings of one step.
constexpr int max_steps = 8;
constexpr int max_halvings = 6;
/// Functions whose values are this near the least one have a say in the direction.
constexpr double active_margin = 0.03;
/// A visit that gains less isn't worth a move: passes come to an end.
constexpr double least_gain = 1e-3;

/// The point nearest to the origin of the convex hull (Gilbert's algorithm): along it all of the gradients
/// rise.
Point shortest_combination(const Slopes& slopes) {
    Point nearest = slopes.front().gradient;
    for (int round = 0; round < 30; ++round) {
        const auto lowest = std::ranges::min_element(slopes, [&](const Slope& a, const Slope& b) {
            return a.gradient.dot(nearest) < b.gradient.dot(nearest);
        });
        const Point to = lowest->gradient - nearest;
        const double gap = -to.dot(nearest);
        if (gap <= 1e-2 * nearest.squaredNorm()) break;
        nearest += std::min(1.0, gap / to.squaredNorm()) * to;
    }
    return nearest;
}

}  // namespace

std::optional<Point> better_place(const Bases& bases, const Point& start, const Constraint& constraint,
                                  const IsAllowed& is_allowed) {
    double reach = std::numeric_limits<double>::infinity();
    for (const Base& base : bases)
        for (const Point& q : base) reach = std::min(reach, (q - start).squaredNorm());
    reach = std::sqrt(reach);
    const auto tangent = constraint.tangent(reach);
    if (!tangent) return std::nullopt;

    const double at_start = least_objective(start, bases);
    Point place = start;
    double worst = at_start;
    double length = 0.5 * reach;
    Slopes slopes;
    for (int step = 0; step < max_steps; ++step) {
        slopes.clear();
        for (const Base& base : bases) append_slopes(place, base, worst + active_margin, slopes);
        if (slopes.empty()) break;
        for (Slope& slope : slopes) slope.gradient = *tangent * slope.gradient;
        const Point direction = shortest_combination(slopes);
        const double rise = direction.norm();
        if (!(rise * reach > least_gain)) break;
        const double before = worst;
        for (int halving = 0; halving < max_halvings && worst == before; ++halving, length /= 2) {
            const auto tried = constraint.nearest(place + length / rise * direction);
            if (!tried) continue;
            const double found = least_objective(*tried, bases, worst);
            if (!(found > worst) || !is_allowed(*tried)) continue;
            worst = found;
            place = *tried;
        }
        if (worst - before < least_gain) break;
        length *= 2;
    }
    if (worst - at_start < least_gain) return std::nullopt;
    return place;
}

}  // namespace maille::quality
