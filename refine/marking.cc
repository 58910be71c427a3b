#include "refine/marking.hh"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "quality/measures.hh"
#include "volmesh/error.hh"

namespace maille::refine {
namespace {

Point centroid(const TetMesh& mesh, CellHandle c) {
    const auto p = mesh.cell_points(c);
    return 0.25 * (p[0] + p[1] + p[2] + p[3]);
}

/// Midpoints of edges this short, next to the coordinates' own size, begin to lose their places to rounding.
void require_room(double length, const Point& at, double size) {
    constexpr double least = 1e-9;
    if (length > least * at.cwiseAbs().maxCoeff()) return;
    throw InputError(fmt::format("the size {} at ({}, {}, {}) is too small for double precision", size,
                                 at.x(), at.y(), at.z()));
}

bool is_too_long(const Bisector& bisector, CellHandle c, const Point& at, const SizeField& size,
                 double ratio) {
    const double wanted = size(at);
    const double length = std::sqrt(bisector.longest_squared(c));
    if (length <= ratio * wanted) return false;
    require_room(length, at, wanted);
    return true;
}

constexpr std::size_t look_ahead = 12;  // cells, to hide the memory's latency

/// Lets the processor begin to read a cell's points.
void fetch_points(const TetMesh& mesh, CellHandle c) {
    for (const VertexHandle v : mesh.cell_vertices(c)) __builtin_prefetch(mesh.point(v).data());
}

double sigma(const TetMesh& mesh, CellHandle c) {
    const auto p = mesh.cell_points(c);
    return quality::sigma(quality::tet_geometry(p[0], p[1], p[2], p[3]));
}

/// Calls `judge(i, centroid)` for the i-th of the cells, by as many threads as there are.
template <class Judge>
void look_at(const TetMesh& mesh, std::span<const CellHandle> cells, const Judge& judge) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size(), 1024), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            if (i + look_ahead < cells.size()) fetch_points(mesh, cells[i + look_ahead]);
            judge(i, centroid(mesh, cells[i]));
        }
    });
}

}  // namespace

std::vector<CellHandle> cells_to_refine(const Bisector& bisector, std::span<const CellHandle> cells,
                                        const SizeField& size, double ratio) {
    std::vector<std::uint8_t> marked(cells.size());
    look_at(bisector.mesh(), cells, [&](std::size_t i, const Point& at) {
        marked[i] = is_too_long(bisector, cells[i], at, size, ratio) ? 1 : 0;
    });
    std::vector<CellHandle> chosen;
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (marked[i] != 0) chosen.push_back(cells[i]);
    return chosen;
}

std::vector<CellHandle> cells_to_refine(const Bisector& bisector, std::span<const CellHandle> cells,
                                        const SizeField& size, double ratio, CurveOrder& curve) {
    const std::span<CurveOrder::Place> places = curve.places(cells.size());
    look_at(bisector.mesh(), cells, [&](std::size_t i, const Point& at) {
        const bool is_marked = is_too_long(bisector, cells[i], at, size, ratio);
        places[i] = is_marked ? curve.place(at) : CurveOrder::nowhere;
    });
    return curve.sorted(cells);
}

void sort_cells(std::vector<CellHandle>& cells, const Bisector& bisector, Order order) {
    if (order == Order::none) return;
    std::vector<std::pair<double, CellHandle>> keyed;
    keyed.reserve(cells.size());
    for (const CellHandle c : cells)
        keyed.emplace_back(order == Order::longest ? -bisector.longest_squared(c) : sigma(bisector.mesh(), c),
                           c);
    std::ranges::sort(keyed);
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = keyed[i].second;
}

}  // namespace maille::refine
