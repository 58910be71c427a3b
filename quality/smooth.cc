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

/// How the sum of beta bends on a line, for each cell, the shortest edge being 1: by experience nearly always
/// within a factor of 1.6. It gives the first step, the sum there the bend for a better one.
constexpr double usual_bend = 0.3;
/// Longest first step, in lengths of the shortest edge.
constexpr double longest_step = 0.3;
constexpr int max_trials = 3;
/// A slope on which the sum would rise by less than this over the shortest edge isn't worth a step.
constexpr double least_slope = 1e-2;

/// The length of the shortest edge at the vertex.
double reach_of(const Bases& bases, const Point& start) {
    double reach = std::numeric_limits<double>::infinity();
    for (const Base& base : bases)
        for (const Point& q : base) reach = std::min(reach, (q - start).squaredNorm());
    return std::sqrt(reach);
}

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
    const double reach = reach_of(bases, start);
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

std::optional<Place> higher_place(const Bases& bases, const Point& start, double floor,
                                  const Constraint& constraint, const IsAllowed& is_allowed) {
    const double reach = reach_of(bases, start);
    const auto tangent = constraint.tangent(reach);
    if (!tangent) return std::nullopt;
    Point slope = Point::Zero();
    double before = 0;
    for (const Base& base : bases) {
        const Slope one = beta_slope(start, base);
        slope += one.gradient;
        before += one.value;
    }
    slope = *tangent * slope;
    const double steepness = slope.norm();
    if (!(steepness * reach > least_slope)) return std::nullopt;

    Place tried;
    /// By how much the sum would rise; nothing where the vertex may not be there.
    const auto gain_at = [&](const Point& p) -> std::optional<double> {
        const auto there = constraint.nearest(p);
        if (!there) return std::nullopt;
        tried.point = *there;
        tried.shapes.clear();
        double sum = 0;
        for (const Base& base : bases) {
            tried.shapes.push_back(shape(*there, base[0], base[1], base[2]));
            if (!(tried.shapes.back().objective > floor)) return std::nullopt;
            sum += tried.shapes.back().beta;
        }
        if (!is_allowed(*there)) return std::nullopt;
        return sum - before;
    };
    std::optional<Place> best;
    double most = 0;
    double step = std::min(longest_step * reach,
                           steepness * reach * reach / (2 * usual_bend * static_cast<double>(bases.size())));
    for (int trial = 0; trial < max_trials; ++trial) {
        const auto gain = gain_at(start + step / steepness * slope);
        if (!gain && best) break;
        if (!gain) {
            step *= 0.3;
            continue;
        }
        if (*gain > most) {
            most = *gain;
            best = tried;
        }
        // The top of the parabola through what is known.
        const double bend = (steepness * step - *gain) / (step * step);
        if (!(bend > 0)) break;
        const double top = std::min(steepness / (2 * bend), 2 * step);
        const bool is_near = top > 0.7 * step && top < 1.4 * step;
        if (best && (is_near || trial > 0)) break;
        step = top;
    }
    return best;
}

}  // namespace maille::quality
