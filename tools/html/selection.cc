#include "tools/html/selection.hh"

#include <algorithm>
#include <cstdlib>

namespace maille::html {
namespace {

using volmesh::CellHandle;
using volmesh::TetMesh;

/// Cuts are at multiples of this part of the mesh's extent, or of a few times as much.
constexpr int finest_cuts = 60;
constexpr std::array<int, 11> cut_steps{1, 2, 3, 4, 5, 6, 10, 12, 15, 20, 30};

std::int32_t cut_place(const Grid& grid, int axis, int k) {
    return static_cast<std::int32_t>(std::int64_t{grid.extent[axis]} * k / finest_cuts);
}

/// Cuts at least here and below there are between the cell and one of its neighbours.
struct Span {
    std::int32_t low, high;
};

Span span_to_neighbors(const std::vector<Grid::GridPoint>& sums, const TetMesh& mesh, CellHandle c,
                       int axis) {
    Span span{sums[c.idx()][axis], sums[c.idx()][axis]};
    for (const CellHandle other : mesh.cc_range(c)) {
        span.low = std::min(span.low, sums[other.idx()][axis]);
        span.high = std::max(span.high, sums[other.idx()][axis]);
    }
    return span;
}

/// Calls visit(k) for the finest cuts in the span, of sums of four coordinates.
void for_cuts_in(const Grid& grid, int axis, const Span& span, const auto& visit) {
    const std::int64_t extent = std::max(grid.extent[axis], 1);
    for (auto k = std::max<std::int64_t>(1, span.low / 4 * finest_cuts / extent); k < finest_cuts; ++k) {
        const std::int64_t place = 4 * std::int64_t{cut_place(grid, axis, static_cast<int>(k))};
        if (place >= span.high) return;
        if (place >= span.low) visit(static_cast<int>(k));
    }
}

/// On the boundary, or where sets of cells or of faces are seen.
bool is_seen_uncut(const TetMesh& mesh, CellHandle c) {
    for (int k = 0; k < 4; ++k) {
        const auto hf = TetMesh::halfface(c, k);
        const auto other = mesh.opposite_halfface_handle(hf);
        if (!other.is_valid() || mesh.combination(hf) != 0 ||
            mesh.combination(TetMesh::incident_cell(other)) != mesh.combination(c))
            return true;
    }
    return false;
}

/// Marks the n worst cells; of equally bad ones the first.
void mark_worst(const TetMesh& mesh, const Quantity& quantity, std::size_t n, std::vector<char>& is_in) {
    const int best = encode(quantity, quantity.best);
    const auto badness = [&](CellHandle c) { return std::abs(quantity.codes[c.idx()] - best); };
    std::vector<std::size_t> counts(1U << 16);
    for (const CellHandle c : mesh.cells()) ++counts[badness(c)];
    int threshold = static_cast<int>(counts.size()) - 1;
    std::size_t n_above = 0;
    while (threshold > 0 && n_above + counts[threshold] < n) n_above += counts[threshold--];
    for (const CellHandle c : mesh.cells()) {
        const int bad = badness(c);
        if (bad < threshold || (bad == threshold && n_above == n)) continue;
        if (bad == threshold) ++n_above;
        is_in[c.idx()] = true;
    }
}

/// The smallest step between cuts whose cells fit in what is left of the budget.
int cut_step(const Grid& grid, const TetMesh& mesh, const std::vector<Grid::GridPoint>& sums,
             std::size_t left) {
    std::array<std::size_t, finest_cuts> counts{};
    for (const CellHandle c : mesh.cells())
        for (int axis = 0; axis < 3; ++axis)
            for_cuts_in(grid, axis, span_to_neighbors(sums, mesh, c, axis), [&](int k) { ++counts[k]; });
    for (const int step : cut_steps) {
        std::size_t n = 0;
        for (int k = step; k < finest_cuts; k += step) n += counts[k];
        if (n <= left) return step;
    }
    return cut_steps.back();
}

void mark_cuts(Selection& selection, const Grid& grid, const TetMesh& mesh, std::size_t left,
               std::vector<char>& is_in) {
    std::vector<Grid::GridPoint> sums(mesh.n_cells());
    for (const CellHandle c : mesh.cells()) sums[c.idx()] = sum_of_points(grid, mesh, c);
    const int step = cut_step(grid, mesh, sums, left);
    for (int axis = 0; axis < 3; ++axis) {
        for (int k = step; k < finest_cuts; k += step)
            selection.cuts[axis].push_back(cut_place(grid, axis, k));
        for (const CellHandle c : mesh.cells())
            for_cuts_in(grid, axis, span_to_neighbors(sums, mesh, c, axis), [&](int k) {
                if (k % step == 0) is_in[c.idx()] = true;
            });
    }
}

}  // namespace

Selection select_cells(const TetMesh& mesh, const Grid& grid, std::span<const Quantity> quantities,
                       std::span<const CellHandle> listed, std::size_t budget) {
    Selection selection;
    std::vector<char> is_in(mesh.n_cells());
    std::size_t n_cells = 0;
    for ([[maybe_unused]] const CellHandle c : mesh.cells()) ++n_cells;
    selection.is_whole = n_cells <= budget;
    if (selection.is_whole) {
        std::ranges::fill(is_in, true);
        selection.n_worst = n_cells;
    } else {
        selection.n_worst = budget / 4 / quantities.size();
        for (const CellHandle c : mesh.cells()) is_in[c.idx()] = is_seen_uncut(mesh, c);
        for (const CellHandle c : listed) is_in[c.idx()] = true;
        for (const Quantity& quantity : quantities) mark_worst(mesh, quantity, selection.n_worst, is_in);
        const auto n_so_far = static_cast<std::size_t>(std::ranges::count(is_in, true));
        mark_cuts(selection, grid, mesh, budget > n_so_far ? budget - n_so_far : 0, is_in);
    }
    for (const CellHandle c : mesh.cells())
        if (is_in[c.idx()]) selection.cells.push_back(c.idx());
    return selection;
}

}  // namespace maille::html
