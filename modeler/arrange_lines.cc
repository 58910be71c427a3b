#include "modeler/arrange_lines.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include "modeler/arrange_scene.hh"

namespace maille::modeler::detail {

namespace {

/// Lines at a greater angle than this (its sine) surely cross in one point only.
constexpr double clear_angle = 1e-3;

std::size_t count_common(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
    std::size_t n = 0;
    for (auto p = a.begin(), q = b.begin(); p != a.end() && q != b.end();) {
        if (*p == *q) ++n;
        if (*p <= *q)
            ++p;
        else
            ++q;
    }
    return n;
}

}  // namespace

bool FlatLines::Line::has(std::uint32_t point) const {
    return std::ranges::binary_search(points, point);
}

void FlatLines::Line::insert(std::uint32_t point) {
    const auto at = std::ranges::lower_bound(points, point);
    if (at == points.end() || *at != point) points.insert(at, point);
}

std::uint32_t FlatLines::add(std::uint32_t from, std::uint32_t to, std::uint32_t across) {
    const auto [at, is_new] = numbers_.try_emplace(edge_key(from, to), size());
    if (is_new) lines_.push_back({std::min(from, to), std::max(from, to), {from, to}, across});
    return at->second;
}

std::uint32_t FlatLines::find(std::uint64_t ends) const {
    const auto at = numbers_.find(ends);
    return at == numbers_.end() ? none : at->second;
}

const Exact::Point_2& FlatLines::flat(std::uint32_t point) {
    const auto [at, is_new] = flat_.try_emplace(point);
    if (is_new) at->second = projection_(registry_[point]);
    return at->second;
}

void FlatLines::cut() {
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, std::uint32_t,
                                                          CGAL::Box_intersection_d::ID_EXPLICIT>;
    std::vector<Box> boxes;
    for (std::uint32_t i = 0; i < lines_.size(); ++i) {
        prepare(lines_[i]);
        boxes.emplace_back(flat(lines_[i].from).bbox() + flat(lines_[i].to).bbox(), i);
    }
    std::vector<std::array<std::uint32_t, 2>> pairs;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
        const auto [i, j] = std::minmax({a.info(), b.info()});
        pairs.push_back({i, j});
    });
    std::ranges::sort(pairs);
    for (const auto& [i, j] : pairs) meet(lines_[i], lines_[j]);
    for (Line& line : lines_) order(line);
}

void FlatLines::prepare(Line& line) {
    std::ranges::sort(line.points);
    line.points.erase(std::unique(line.points.begin(), line.points.end()), line.points.end());
    const CGAL::Bbox_2 a = flat(line.from).bbox(), b = flat(line.to).bbox();
    const double dx = (b.xmin() + b.xmax() - a.xmin() - a.xmax()) / 2,
                 dy = (b.ymin() + b.ymax() - a.ymin() - a.ymax()) / 2;
    const double unsure =
        a.xmax() - a.xmin() + a.ymax() - a.ymin() + b.xmax() - b.xmin() + b.ymax() - b.ymin();
    const double length = std::hypot(dx, dy);
    if (unsure < 1e-2 * clear_angle * length) line.dx = dx / length, line.dy = dy / length;
}

/// On which side of the line the point is.
CGAL::Sign FlatLines::turn(const Line& line, std::uint32_t point) {
    if (line.has(point)) return CGAL::ZERO;
    const std::array asked{line.from, line.to, point};
    const auto n = positions_.points.size();
    if (std::ranges::all_of(asked, [&](std::uint32_t p) { return p < n; }) && positions_.collinear(asked))
        return CGAL::ZERO;
    return CGAL::orientation(flat(line.from), flat(line.to), flat(point));
}

void FlatLines::meet(Line& a, Line& b) {
    if (std::abs(a.dx * b.dy - a.dy * b.dx) > clear_angle && count_common(a.points, b.points) > 0) return;
    const std::array of_b{turn(a, b.from), turn(a, b.to)};
    if (of_b[0] != CGAL::ZERO && of_b[0] == of_b[1]) return;
    const std::array of_a{turn(b, a.from), turn(b, a.to)};
    if (of_a[0] != CGAL::ZERO && of_a[0] == of_a[1]) return;

    if (of_b[0] == CGAL::ZERO && of_b[1] == CGAL::ZERO) {
        const auto put_if_within = [&](Line& line, std::uint32_t p) {
            if (!line.has(p) &&
                CGAL::collinear_are_ordered_along_line(flat(line.from), flat(p), flat(line.to)))
                line.insert(p);
        };
        // Points of the one that lie on the common part are on both.
        const std::vector<std::uint32_t> at_a = a.points, at_b = b.points;
        for (const auto p : at_b) put_if_within(a, p);
        for (const auto p : at_a) put_if_within(b, p);
        return;
    }
    bool touches = false;
    for (const auto& [line, side, point] : {std::tuple(&a, of_b[0], b.from), std::tuple(&a, of_b[1], b.to),
                                            std::tuple(&b, of_a[0], a.from), std::tuple(&b, of_a[1], a.to)})
        if (side == CGAL::ZERO) {
            line->insert(point);
            touches = true;
        }
    if (touches) return;

    const std::uint32_t point = crossing(a, b);
    a.insert(point);
    b.insert(point);
}

/// The number of the one point that both are known to have in common.
std::uint32_t FlatLines::crossing(const Line& a, const Line& b) {
    if (a.across == none || b.across == none) return new_crossing(a, b);
    std::uint32_t& point = crossings_.point_of({number_, a.across, b.across});
    if (point == none) point = new_crossing(a, b);
    return point;
}

std::uint32_t FlatLines::new_crossing(const Line& a, const Line& b) {
    const auto crossing =
        CGAL::intersection(Exact::Line_2(flat(a.from), flat(a.to)), Exact::Line_2(flat(b.from), flat(b.to)));
    const auto* place = crossing ? boost::get<Exact::Point_2>(&*crossing) : nullptr;
    if (place == nullptr) throw std::logic_error("lines that cross have no point in common");
    return registry_.add(projection_.lift(*place, plane_));
}

void FlatLines::order(Line& line) {
    const bool rises = flat(line.from) < flat(line.to);
    std::ranges::sort(line.points, [&](std::uint32_t p, std::uint32_t q) {
        if (p == q) return false;
        return rises ? flat(p) < flat(q) : flat(q) < flat(p);
    });
}

}  // namespace maille::modeler::detail
