#include <algorithm>
#include <random>
#include <set>

#include <doctest/doctest.h>

#include "tests/support/kuhn.hh"
#include "tools/html/selection.hh"

using namespace maille;
using html::Selection;
using volmesh::CellHandle;
using volmesh::TetMesh;

namespace {

struct Case {
    TetMesh mesh;
    html::Grid grid;
    std::vector<html::Quantity> quantities;

    explicit Case(int n) : mesh(test::kuhn_cube(n)) {
        std::mt19937 random(12);
        std::uniform_real_distribution<double> shift(-0.2 / n, 0.2 / n);
        for (std::uint32_t i = 0; i < mesh.n_vertices(); ++i) {
            volmesh::Point p = mesh.point(volmesh::VertexHandle(i));
            p += volmesh::Point(shift(random), shift(random), shift(random));
            mesh.set_point(volmesh::VertexHandle(i), p.cwiseProduct(volmesh::Point(1, 2, 0.5)));
        }
        const auto set = mesh.add_set("part", volmesh::EntityKind::cell);
        for (const CellHandle c : mesh.cells())
            if (quality::centroid(mesh, c).norm() < 0.7) mesh.insert(set, c);
        grid = html::grid_of(mesh);
        quantities = html::quantities_of(mesh, quality::assess(mesh), nullptr, {});
    }
};

}  // namespace

TEST_CASE("a mesh within the budget is sent whole") {
    Case c(4);
    c.mesh.delete_cell(CellHandle(7));
    const Selection all = html::select_cells(c.mesh, c.grid, c.quantities, {}, 383);
    CHECK(all.is_whole);
    CHECK(all.cells.size() == 383);
    CHECK(!std::ranges::binary_search(all.cells, 7U));
    CHECK(all.cuts[0].empty());
}

TEST_CASE("of a larger mesh, all that can be seen is sent, and the worst") {
    const Case c(16);
    const std::array listed{CellHandle(12345), CellHandle(20001)};
    std::size_t cuts = 0;
    for (const std::size_t budget : {1U, 6000U, 9000U, 19000U}) {
        const Selection selection = html::select_cells(c.mesh, c.grid, c.quantities, listed, budget);
        CAPTURE(budget);
        CHECK(!selection.is_whole);
        CHECK(std::ranges::is_sorted(selection.cells));
        CHECK(selection.cells.size() < c.mesh.n_cells());
        const auto is_in = [&](CellHandle cell) {
            return std::ranges::binary_search(selection.cells, cell.idx());
        };

        // Both cells of each face where sets change or a cut goes through, and those at the boundary.
        std::size_t missing = 0;
        for (const CellHandle cell : c.mesh.cells()) {
            const auto sum = html::sum_of_points(c.grid, c.mesh, cell);
            for (int k = 0; k < 4; ++k) {
                const auto other = c.mesh.opposite_halfface_handle(TetMesh::halfface(cell, k));
                if (!other.is_valid()) {
                    missing += !is_in(cell);
                    continue;
                }
                const CellHandle neighbor = TetMesh::incident_cell(other);
                bool is_seen = c.mesh.combination(cell) != c.mesh.combination(neighbor);
                const auto sum_there = html::sum_of_points(c.grid, c.mesh, neighbor);
                for (int axis = 0; axis < 3; ++axis)
                    for (const std::int64_t place : selection.cuts[axis])
                        is_seen = is_seen || (sum[axis] <= 4 * place) != (sum_there[axis] <= 4 * place);
                if (is_seen) missing += !is_in(cell);
            }
        }
        CHECK(missing == 0);

        for (const CellHandle cell : listed) CHECK(is_in(cell));

        CHECK(selection.n_worst == budget / 4 / c.quantities.size());
        for (const html::Quantity& q : c.quantities) {
            const int best = html::encode(q, q.best);
            std::vector<std::pair<int, std::uint32_t>> order;
            for (std::uint32_t i = 0; i < c.mesh.n_cells(); ++i)
                order.emplace_back(-std::abs(q.codes[i] - best), i);
            std::ranges::sort(order);
            for (std::size_t k = 0; k < selection.n_worst; ++k)
                missing += !is_in(CellHandle(order[k].second));
        }
        CHECK(missing == 0);

        CHECK(selection.cuts[0].size() >= std::max<std::size_t>(cuts, 1));
        CHECK(selection.cuts[1].size() == selection.cuts[0].size());
        cuts = selection.cuts[0].size();
    }
    CHECK(cuts > 3);
}

TEST_CASE("the grid is as long as the longest side, and has the points to half a step") {
    const Case c(3);
    CHECK(std::ranges::max(c.grid.extent) == html::Grid::steps);
    for (std::uint32_t i = 0; i < c.mesh.n_vertices(); ++i)
        for (int k = 0; k < 3; ++k) {
            const double there = c.grid.origin[k] + c.grid.step * c.grid.points[i][k];
            CHECK(std::abs(there - c.mesh.point(volmesh::VertexHandle(i))[k]) <= 0.501 * c.grid.step);
        }
    CHECK(html::grid_of(TetMesh::from_cells({}, {})).points.empty());
}
