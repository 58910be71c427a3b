#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include "tests/support/kuhn.hh"
#include "tests/support/messages.hh"
#include "volmesh/tet_mesh.hh"

using namespace maille;
using namespace maille::volmesh;

namespace {

using Index = TetMesh::Index;

struct Soup {
    std::vector<Point> points;
    std::vector<std::array<Index, 4>> cells;

    TetMesh mesh() const { return TetMesh::from_cells(points, cells); }
};

Soup soup_of(const TetMesh& mesh) {
    Soup soup{{mesh.points().begin(), mesh.points().end()}, {}};
    for (const auto& cell : mesh.cell_vertex_indices()) soup.cells.push_back(cell);
    return soup;
}

/// Vertices and cells in any order, and vertices that no cell has.
Soup shuffled(const Soup& soup, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Index> place(2 * soup.points.size());
    std::iota(place.begin(), place.end(), 0U);
    std::ranges::shuffle(place, random);
    Soup result{std::vector<Point>(place.size(), Point::Zero()), soup.cells};
    for (std::size_t v = 0; v < soup.points.size(); ++v) result.points[place[v]] = soup.points[v];
    std::ranges::shuffle(result.cells, random);
    for (auto& cell : result.cells)
        for (Index& v : cell) v = place[v];
    return result;
}

/// Round one edge: all cells have both of its ends.
Soup fan(Index n) {
    Soup soup{{Point(0, 0, -1), Point(0, 0, 1)}, {}};
    for (Index i = 0; i < n; ++i) {
        const double angle = 2 * 3.14159265358979 * i / n;
        soup.points.emplace_back(std::cos(angle), std::sin(angle), 0);
        soup.cells.push_back({0, 1, 2 + i, 2 + (i + 1) % n});
    }
    return soup;
}

/// What a map of all faces says.
void check_links(const Soup& soup) {
    const TetMesh mesh = soup.mesh();
    std::map<std::array<Index, 3>, std::vector<HalffaceHandle>> sides;
    for (Index c = 0; c < soup.cells.size(); ++c)
        for (int f = 0; f < 4; ++f) {
            std::array<Index, 3> face{};
            for (int k = 0; k < 3; ++k) face[k] = soup.cells[c][tet::face_vertices[f][k]];
            std::ranges::sort(face);
            sides[face].push_back(TetMesh::halfface(CellHandle(c), f));
        }
    std::size_t n_boundary = 0;
    std::size_t n_wrong = 0;
    for (const auto& [face, of_face] : sides) {
        n_boundary += of_face.size() == 1;
        for (HalffaceHandle hf : of_face) {
            const HalffaceHandle other = of_face.front() == hf ? of_face.back() : of_face.front();
            n_wrong += mesh.opposite_halfface_handle(hf) != (other == hf ? HalffaceHandle() : other);
        }
    }
    CHECK(n_wrong == 0);
    CHECK(mesh.n_boundary_faces() == n_boundary);
}

Column<TetMesh::Cell> linked_cells(const TetMesh& mesh) {
    Column<TetMesh::Cell> cells;
    for (const auto& vertices : mesh.cell_vertex_indices()) cells.push_back({vertices, {}});
    for (Index hf = 0; hf < mesh.n_halffaces(); ++hf)
        cells[hf / 4].neighbors[hf % 4] = mesh.opposite_halfface_handle(HalffaceHandle(hf)).idx();
    return cells;
}

}  // namespace

TEST_CASE("cells find their neighbours, whatever the numbers and the threads") {
    for (const std::size_t threads : {1U, 3U}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        for (const int n : {1, 2, 13}) {
            const Soup soup = soup_of(test::kuhn_cube(n));
            check_links(soup);
            check_links(shuffled(soup, 1));
        }
        check_links(fan(50'000));
        check_links(shuffled(fan(20'000), 2));
        check_links({});
        check_links({{Point::Zero()}, {}});
    }
}

TEST_CASE("neighbours that are known already need not be found") {
    for (const Soup& soup : {shuffled(soup_of(test::kuhn_cube(13)), 3), fan(500)}) {
        const TetMesh whole = soup.mesh();
        const auto n = static_cast<Index>(soup.cells.size());
        // Links among the first cells are told, but for one in so many.
        for (const Index n_known : {n / 2, n})
            for (const Index one_in : {3U, 90U}) {
                Column<TetMesh::Cell> cells = linked_cells(whole);
                for (Index hf = 0; hf < 4 * n; ++hf) {
                    Index& other = cells[hf / 4].neighbors[hf % 4];
                    if (std::max(hf, other) >= 4 * n_known || (hf + other) % one_in == 0)
                        other = TetMesh::none;
                }
                const TetMesh mesh = TetMesh::from_linked_cells(soup.points, std::move(cells));
                std::size_t n_wrong = 0;
                for (const HalffaceHandle hf : whole.halffaces())
                    n_wrong += mesh.opposite_halfface_handle(hf) != whole.opposite_halfface_handle(hf);
                CHECK(mesh.n_boundary_faces() == whole.n_boundary_faces());
                for (const VertexHandle v : whole.vertices())
                    n_wrong += !std::ranges::equal(mesh.vc_range(v), whole.vc_range(v));
                CHECK(n_wrong == 0);
            }
    }
}

TEST_CASE("a third cell at a face is found among neighbours that are not known") {
    const TetMesh whole = test::kuhn_cube(13);
    Column<TetMesh::Cell> cells = linked_cells(whole);
    const HalffaceHandle face = TetMesh::halfface(CellHandle(5000), 1);
    const HalffaceHandle other = whole.opposite_halfface_handle(face);
    REQUIRE(other.is_valid());
    for (const HalffaceHandle hf : {face, other}) cells[hf.idx() / 4].neighbors[hf.idx() % 4] = TetMesh::none;
    const auto [a, b, c] = whole.halfface_vertices(face);
    std::vector<Point> points(whole.points().begin(), whole.points().end());
    points.emplace_back(9, 9, 9);
    cells.push_back({{whole.n_vertices(), a.idx(), b.idx(), c.idx()},
                     {TetMesh::none, TetMesh::none, TetMesh::none, TetMesh::none}});
    const std::string told = test::message([&] { TetMesh::from_linked_cells(points, std::move(cells)); });
    CHECK(test::has(told, "cells " + std::to_string(std::min(face, other).idx() / 4)));
    CHECK(test::has(told, "all have the face of vertices"));
}

TEST_CASE("a face of three cells is refused by its vertices, always the same one") {
    Soup soup = soup_of(test::kuhn_cube(6));
    const auto n = static_cast<Index>(soup.points.size());
    // One more cell each on two faces inside the mesh.
    std::vector<std::array<Index, 3>> faces;
    const TetMesh mesh = soup.mesh();
    for (const HalffaceHandle hf :
         {TetMesh::halfface(CellHandle(1000), 0), TetMesh::halfface(CellHandle(400), 2)}) {
        REQUIRE(!mesh.is_boundary(hf));
        const auto [a, b, c] = mesh.halfface_vertices(hf);
        faces.push_back({a.idx(), b.idx(), c.idx()});
        soup.points.emplace_back(9, 9, 9);
        soup.cells.push_back({n + static_cast<Index>(faces.size()) - 1, c.idx(), b.idx(), a.idx()});
        std::ranges::sort(faces.back());
    }
    const auto lowest = std::ranges::min(faces);
    const std::string told = test::message([&] { soup.mesh(); });
    CHECK(test::has(told, "all have the face of vertices " + std::to_string(lowest[0]) + ", " +
                              std::to_string(lowest[1]) + " and " + std::to_string(lowest[2])));
    for (int i = 0; i < 5; ++i) CHECK(test::message([&] { soup.mesh(); }) == told);
}
