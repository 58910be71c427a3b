#include "modeler/outline_split.hh"

#include <algorithm>
#include <iterator>
#include <utility>

namespace maille::modeler {
namespace {

/// The loops that a loop consists of.
std::vector<PlaneLoop> simple_loops(const PlaneLoop& loop) {
    std::vector<PlaneLoop> loops;
    PlaneLoop way;
    for (const Point2& p : loop) {
        const auto before = std::ranges::find(way, p);
        if (before != way.end()) {
            loops.emplace_back(before, way.end());
            way.erase(before, way.end());
        }
        way.push_back(p);
    }
    loops.push_back(std::move(way));
    std::erase_if(loops, [](const PlaneLoop& l) { return l.size() < 3; });
    return loops;
}

double area(const PlaneLoop& loop) {
    double sum = 0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const Point2 a = loop[k] - loop[0], b = loop[(k + 1) % loop.size()] - loop[0];
        sum += (a.x() * b.y() - a.y() * b.x()) / 2;
    }
    return sum;
}

bool is_inside(const Point2& p, const PlaneLoop& loop) {
    bool inside = false;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const Point2 &a = loop[k], &b = loop[(k + 1) % loop.size()];
        if ((a.y() <= p.y()) != (b.y() <= p.y()) &&
            p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
            inside = !inside;
    }
    return inside;
}

/// Whether a hole that crosses no outline is within that one: they may have corners in common.
bool is_hole_of(const PlaneLoop& hole, const PlaneLoop& outline) {
    const auto off = std::ranges::find_if(
        hole, [&](const Point2& p) { return std::ranges::find(outline, p) == outline.end(); });
    return is_inside(off != hole.end() ? *off : Point2((hole[0] + hole[1]) / 2), outline);
}

}  // namespace

Outline split_where_touching(const Outline& shape) {
    Outline result;
    for (const PlaneRegion& region : shape) {
        std::vector<PlaneLoop> loops;
        for (const PlaneLoop& loop : region) std::ranges::move(simple_loops(loop), std::back_inserter(loops));
        const auto holes =
            std::ranges::stable_partition(loops, [](const PlaneLoop& loop) { return area(loop) > 0; });
        const std::size_t first = result.size();
        for (auto outline = loops.begin(); outline != holes.begin(); ++outline)
            result.push_back({std::move(*outline)});
        for (PlaneLoop& hole : holes) {
            const auto around =
                std::find_if(result.begin() + static_cast<std::ptrdiff_t>(first), result.end(),
                             [&](const auto& r) { return is_hole_of(hole, r.front()); });
            if (around != result.end()) around->push_back(std::move(hole));
        }
    }
    return result;
}

}  // namespace maille::modeler
