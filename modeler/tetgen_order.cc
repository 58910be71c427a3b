#include "modeler/tetgen_order.hh"

#include <algorithm>
#include <numeric>
#include <utility>

#include "volmesh/renumber.hh"

namespace maille::modeler::tetgen {
namespace {

std::vector<std::uint32_t> inverse(const std::vector<std::uint32_t>& order) {
    std::vector<std::uint32_t> numbers(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) numbers[order[i]] = i;
    return numbers;
}

template <class T>
void reorder(std::vector<T>& values, const std::vector<std::uint32_t>& order) {
    std::vector<T> ordered(values.size());
    std::ranges::transform(order, ordered.begin(), [&](std::uint32_t i) { return values[i]; });
    values = std::move(ordered);
}

/// The cells in ascending order of the least rank of their points; of equal ones, as they are.
std::vector<std::uint32_t> order_by_first_point(const std::vector<std::array<std::uint32_t, 4>>& cells,
                                                const std::vector<std::uint32_t>& ranks) {
    const auto first_rank = [&](const std::array<std::uint32_t, 4>& cell) {
        return std::min({ranks[cell[0]], ranks[cell[1]], ranks[cell[2]], ranks[cell[3]]});
    };
    std::vector<std::uint32_t> begins(ranks.size() + 1);
    for (const auto& cell : cells) ++begins[first_rank(cell) + 1];
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<std::uint32_t> order(cells.size());
    for (std::uint32_t c = 0; c < cells.size(); ++c) order[begins[first_rank(cells[c])]++] = c;
    return order;
}

}  // namespace

void order_along_curve(Answer& answer, std::size_t n_fixed) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : answer.points) box.extend(p);
    const std::vector<std::uint32_t> along = volmesh::order_along_curve(
        answer.points.size(), box, [&](std::uint32_t v) { return answer.points[v]; });
    const std::vector<std::uint32_t> cells = order_by_first_point(answer.cells, inverse(along));
    std::vector<std::uint32_t> points = along;
    std::ranges::stable_partition(points, [&](std::uint32_t v) { return v < n_fixed; });
    std::ranges::sort(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(n_fixed));

    reorder(answer.points, points);
    reorder(answer.cells, cells);
    reorder(answer.neighbors, cells);
    const std::vector<std::uint32_t> point_numbers = inverse(points), cell_numbers = inverse(cells);
    for (auto& cell : answer.cells)
        for (std::uint32_t& v : cell) v = point_numbers[v];
    for (auto& facet : answer.facets)
        for (std::uint32_t& v : facet) v = point_numbers[v];
    for (auto& neighbors : answer.neighbors)
        for (std::uint32_t& c : neighbors)
            if (c != no_cell) c = cell_numbers[c];
}

}  // namespace maille::modeler::tetgen
