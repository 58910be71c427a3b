#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <doctest/doctest.h>

#include "quality/mean_collapses.hh"
#include "quality/mean_flips.hh"
#include "quality/mean_moves.hh"
#include "quality/support.hh"
#include "tests/support/kuhn.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

using namespace maille::quality;
using namespace maille::volmesh;
using maille::test::kuhn_cube;

namespace {

constexpr double mean = 0.8;  // below which cells are to be bettered
const SizeLimit no_limit(nullptr, 1);

std::vector<Shape> shapes_of(const TetMesh& mesh) {
    std::vector<Shape> shapes(mesh.n_cells(), perfect_shape);
    for (const CellHandle c : mesh.cells()) {
        const auto p = mesh.cell_points(c);
        shapes[c.idx()] = shape(p[0], p[1], p[2], p[3]);
    }
    return shapes;
}

struct Sum {
    double above_mean = 0, worst = 1;
};

Sum sum_of(const std::vector<Shape>& shapes, const TetMesh& mesh) {
    Sum sum;
    for (const CellHandle c : mesh.cells()) {
        sum.above_mean += shapes[c.idx()].beta - mean;
        sum.worst = std::min(sum.worst, shapes[c.idx()].objective);
    }
    return sum;
}

bool are_right(const std::vector<Shape>& shapes, const TetMesh& mesh) {
    const std::vector<Shape> anew = shapes_of(mesh);
    return std::ranges::equal(shapes, anew, [](const Shape& a, const Shape& b) {
        return std::abs(a.objective - b.objective) < 1e-12 && std::abs(a.beta - b.beta) < 1e-12;
    });
}

/// The one inner vertex of eight bricks, `shift` from the middle, and what has it.
TetMesh star(const Point& shift) {
    TetMesh mesh = kuhn_cube(2);
    const auto middle = std::ranges::find(mesh.points(), Point(0.5, 0.5, 0.5)) - mesh.points().begin();
    mesh.set_point(VertexHandle(static_cast<std::uint32_t>(middle)), Point(0.5, 0.5, 0.5) + shift);
    std::vector<CellHandle> others;
    for (const CellHandle c : mesh.cells())
        if (mesh.local_vertex(c, VertexHandle(static_cast<std::uint32_t>(middle))) < 0) others.push_back(c);
    for (const CellHandle c : others) mesh.delete_cell(c);
    mesh.garbage_collection();
    return mesh;
}

/// Cells round an edge of any length, whose ring is a regular polygon that has been shaken.
TetMesh ring(std::uint32_t n, double shake, std::mt19937& random) {
    std::uniform_real_distribution<double> shift(-shake, shake);
    const double half = std::uniform_real_distribution<double>(0.4, 1.6)(random);
    std::vector<Point> points{{0, 0, -half}, {0, 0, half}};
    std::vector<std::array<std::uint32_t, 4>> cells;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n;
        points.push_back({std::cos(angle) + shift(random), std::sin(angle) + shift(random), shift(random)});
        cells.push_back({0, 1, 2 + i, 2 + (i + 1) % n});
    }
    return TetMesh::from_cells(std::move(points), std::move(cells));
}

/// Does what `better` does to a mesh and its shapes, and checks that it keeps these right, and the volume,
/// and raises the sum of beta - mean and the worst cell; returns whether it has done anything. The mesh has
/// no cells but those that it may change.
template <class Better>
bool has_bettered(TetMesh& mesh, const Better& better) {
    std::vector<Shape> shapes = shapes_of(mesh);
    const Sum before = sum_of(shapes, mesh);
    if (before.worst <= 0) return false;
    const double volume_before = volume(mesh);
    const std::size_t n = better(shapes);
    const Sum after = sum_of(shapes, mesh);
    CHECK(are_right(shapes, mesh));
    CHECK(volume(mesh) == doctest::Approx(volume_before).epsilon(1e-12));
    if (n == 0) return false;
    CHECK(after.above_mean > before.above_mean);
    CHECK(after.worst > before.worst);
    mesh.garbage_collection();
    CHECK(validate(mesh).ok());
    return true;
}

}  // namespace

TEST_CASE("a vertex's move raises the sum of beta and not at the cost of the worst cell at it") {
    constexpr unsigned seed = 71;
    CAPTURE(seed);
    std::mt19937 random(seed);
    int n_moved = 0;
    for (int i = 0; i < 300; ++i) {
        const double far = 0.05 + 0.3 * (i % 3) / 2;
        std::uniform_real_distribution<double> shift(-far, far);
        TetMesh mesh = star({shift(random), shift(random), shift(random)});
        n_moved += has_bettered(mesh, [&](std::vector<Shape>& shapes) {
            return move_for_mean(mesh, shapes, no_limit, free_vertices(mesh));
        });
    }
    CHECK(n_moved > 50);
}

TEST_CASE("an edge's removal raises the sum of beta - mean and not at the cost of the worst cell round it") {
    constexpr unsigned seed = 72;
    CAPTURE(seed);
    std::mt19937 random(seed);
    int n_removed = 0;
    for (int i = 0; i < 600; ++i) {
        TetMesh mesh = ring(3 + i % 5, 0.1 + 0.3 * (i % 4) / 3, random);
        n_removed += has_bettered(
            mesh, [&](std::vector<Shape>& shapes) { return flip_for_mean(mesh, shapes, mean, no_limit); });
    }
    CHECK(n_removed > 50);
}

TEST_CASE("a collapse raises the sum of beta - mean and not at the cost of the worst cell at its vertex") {
    constexpr unsigned seed = 73;
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shift(-0.45, 0.45);
    int n_collapsed = 0;
    for (int i = 0; i < 400; ++i) {
        TetMesh mesh = star({shift(random), shift(random), shift(random)});
        const std::uint32_t n_cells = mesh.n_cells();
        const bool has_collapsed = has_bettered(mesh, [&](std::vector<Shape>& shapes) {
            return collapse_for_mean(mesh, shapes, mean, no_limit, free_vertices(mesh));
        });
        CHECK((mesh.n_cells() < n_cells) == has_collapsed);
        n_collapsed += has_collapsed;
    }
    CHECK(n_collapsed > 50);
}

TEST_CASE("a vertex that may not go anywhere, or whose cells are good, collapses into no other") {
    TetMesh mesh = star({0.1, 0.05, 0});
    std::vector<Shape> shapes = shapes_of(mesh);
    CHECK(collapse_for_mean(mesh, shapes, mean, no_limit, std::vector<std::uint8_t>(mesh.n_vertices(), 0)) ==
          0);
    CHECK(collapse_for_mean(mesh, shapes, 0, no_limit, free_vertices(mesh)) == 0);
}
