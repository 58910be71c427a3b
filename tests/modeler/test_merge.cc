#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "modeler/merge.hh"
#include "volmesh/error.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

namespace {

using namespace maille;
using namespace maille::modeler;
using Eigen::Vector3d;
using volmesh::CellHandle;
using volmesh::EntityKind;
using volmesh::TetMesh;
using volmesh::VertexHandle;

CsgTree leaf(std::uint32_t i) {
    return {Operation::leaf, i, {}};
}
CsgTree pair_of(Operation operation) {
    return {operation, 0, {leaf(0), leaf(1)}};
}

/// n x n x n cubes of six tetrahedra each, all sides of the block in one face set, all cells in one cell set.
TetMesh block(const std::string& name, const Vector3d& low, const Vector3d& high, std::uint32_t n) {
    std::vector<Vector3d> points;
    const auto number = [n](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        return (i * (n + 1) + j) * (n + 1) + k;
    };
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j)
            for (std::uint32_t k = 0; k <= n; ++k)
                points.push_back(low + (high - low).cwiseProduct(Vector3d(i, j, k) / n));
    std::vector<std::array<std::uint32_t, 4>> cells;
    constexpr std::array<std::array<int, 3>, 6> orders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j)
            for (std::uint32_t k = 0; k < n; ++k)
                for (std::size_t o = 0; o < orders.size(); ++o) {
                    std::array<std::uint32_t, 3> at{i, j, k};
                    std::array<std::uint32_t, 4> cell{number(i, j, k), 0, 0, 0};
                    for (std::size_t step = 0; step < 3; ++step) {
                        ++at[static_cast<std::size_t>(orders[o][step])];
                        cell[step + 1] = number(at[0], at[1], at[2]);
                    }
                    if (o >= 3) std::swap(cell[1], cell[2]);
                    cells.push_back(cell);
                }
    TetMesh mesh = TetMesh::from_cells(points, cells);
    const auto cell_set = mesh.add_set(name, EntityKind::cell);
    for (const CellHandle c : mesh.cells()) mesh.insert(cell_set, c);
    const auto face_set = mesh.add_set(name + "/skin", EntityKind::face);
    for (const auto face : mesh.boundary_halffaces()) mesh.insert(face_set, face);
    return mesh;
}

double measure_of(const TetMesh& mesh, const std::string& name, EntityKind kind) {
    const auto set = mesh.find_set(name, kind);
    return set.is_valid() ? volmesh::measure(mesh, set) : 0;
}

TetMesh merged(const std::vector<TetMesh>& meshes, const CsgTree& tree, BuildReport& report) {
    TetMesh mesh = merge(meshes, tree, {}, &report);
    for (const std::string& warning : report.warnings) MESSAGE(warning);
    CHECK(volmesh::validate(mesh).ok());
    CHECK(report.kept_cells + report.new_cells == mesh.n_cells());
    return mesh;
}

std::set<std::array<double, 12>> cells_of(const TetMesh& mesh) {
    std::set<std::array<double, 12>> cells;
    for (const CellHandle c : mesh.cells()) {
        std::array<double, 12> numbers{};
        for (int k = 0; k < 4; ++k)
            for (int d = 0; d < 3; ++d)
                numbers[static_cast<std::size_t>(3 * k + d)] = mesh.point(mesh.cell_vertex(c, k))[d];
        cells.insert(numbers);
    }
    return cells;
}

doctest::Approx exactly(double value) {
    return doctest::Approx(value).epsilon(1e-9);
}

TEST_CASE("merging blocks keeps their cells and sets") {
    const std::vector<TetMesh> blocks{block("a", {0, 0, 0}, {1, 1, 1}, 8),
                                      block("b", {0.63, 0.52, 0.57}, {1.7, 1.6, 1.5}, 7)};
    const double both = 0.37 * 0.48 * 0.43, second = 1.07 * 1.08 * 0.93;
    BuildReport report;
    SUBCASE("union") {
        const TetMesh mesh = merged(blocks, pair_of(Operation::join), report);
        CHECK(volmesh::volume(mesh) == exactly(1 + second - both));
        CHECK(measure_of(mesh, "a", EntityKind::cell) == exactly(1));
        CHECK(measure_of(mesh, "b", EntityKind::cell) == exactly(second - both));
        const double inner = 0.37 * 0.48 + 0.48 * 0.43 + 0.43 * 0.37;
        CHECK(measure_of(mesh, "a/skin", EntityKind::face) == exactly(6 - inner));
        CHECK(measure_of(mesh, "a/skin/inner", EntityKind::face) == exactly(inner));
    }
    SUBCASE("difference") {
        const TetMesh mesh = merged(blocks, pair_of(Operation::difference), report);
        CHECK(volmesh::volume(mesh) == exactly(1 - both));
        CHECK(!mesh.find_set("b", EntityKind::cell).is_valid());
        CHECK(volmesh::boundary_area(mesh) == exactly(6));
    }
    SUBCASE("intersection") {
        const TetMesh mesh = merged(blocks, pair_of(Operation::intersection), report);
        CHECK(volmesh::volume(mesh) == exactly(both));
        return;
    }
    CHECK(report.kept_cells > 0);
    const TetMesh mesh = merge(blocks, pair_of(Operation::join));
    std::set<std::array<double, 12>> before = cells_of(blocks[0]);
    before.merge(cells_of(blocks[1]));
    std::size_t same = 0;
    for (const auto& cell : cells_of(mesh)) same += before.count(cell);
    CHECK(same > mesh.n_cells() / 4);
}

TEST_CASE("regions of one mesh stay apart, and what is inside kept cells is carried over") {
    TetMesh first = block("a", {0, 0, 0}, {1, 1, 1}, 8);
    const auto left = first.add_set("left", EntityKind::cell);
    for (const CellHandle c : first.cells()) {
        const auto p = first.cell_points(c);
        if ((p[0] + p[1] + p[2] + p[3]).x() / 4 < 0.5) first.insert(left, c);
    }
    const auto probe = first.add_set("probe", EntityKind::vertex);
    first.insert(probe, VertexHandle(0));
    const auto wall = first.add_set("wall", EntityKind::face);
    for (const auto face : first.halffaces()) {
        const auto v = first.halfface_vertices(face);
        if (std::ranges::all_of(v, [&](VertexHandle w) { return first.point(w).x() == 0.5; }))
            first.insert(wall, face);
    }
    BuildReport report;
    const TetMesh mesh = merged({first, block("b", {0.8, 0.8, 0.8}, {1.3, 1.3, 1.3}, 4)},
                                pair_of(Operation::difference), report);
    CHECK(measure_of(mesh, "a", EntityKind::cell) == exactly(1 - 0.008));
    CHECK(measure_of(mesh, "left", EntityKind::cell) == exactly(0.5));
    CHECK(measure_of(mesh, "wall", EntityKind::face) == exactly(1));
    const auto kept_probe = mesh.find_set("probe", EntityKind::vertex);
    REQUIRE(mesh.vertex_members(kept_probe).size() == 1);
    CHECK(mesh.point(mesh.vertex_members(kept_probe).front()) == Vector3d(0, 0, 0));
}

TEST_CASE("blocks that fit are joined without a new cell") {
    const std::vector<TetMesh> blocks{block("a", {0, 0, 0}, {1, 1, 1}, 4),
                                      block("b", {2, 0, 0}, {3, 1, 1}, 4)};
    BuildReport report;
    const TetMesh mesh = merged(blocks, pair_of(Operation::fragment), report);
    CHECK(report.new_cells == 0);
    CHECK(volmesh::volume(mesh) == exactly(2));
}

TEST_CASE("what cannot be merged is told") {
    const auto message_of = [](const std::function<void()>& action) -> std::string {
        try {
            action();
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    const std::vector<TetMesh> one{block("a", {0, 0, 0}, {1, 1, 1}, 2)};
    const std::vector<TetMesh> apart{one[0], block("b", {2, 0, 0}, {3, 1, 1}, 2)};
    CHECK(message_of([&] { merge(one, pair_of(Operation::join)); }).find("mesh 2") != std::string::npos);
    CHECK(message_of([&] { merge(apart, pair_of(Operation::intersection)); }).find("empty") !=
          std::string::npos);
    CHECK(message_of([&] { merge(std::vector<TetMesh>{TetMesh{}}, leaf(0)); }).find("no cells") !=
          std::string::npos);
    CHECK(message_of([&] { merge({}, leaf(0)); }).find("no meshes") != std::string::npos);
}

}  // namespace
