#include <algorithm>
#include <random>
#include <ranges>
#include <set>

#include <doctest/doctest.h>

#include "tests/support/kuhn.hh"
#include "volmesh/error.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

using namespace maille;
using namespace maille::volmesh;

namespace {

void check_valid(const TetMesh& mesh) {
    const Validation found = validate(mesh);
    for (const std::string& error : found.errors) MESSAGE(error);
    CHECK(found.ok());
}

template <class A, class B>
concept Comparable = requires(A a, B b) {
    a == b;
};
static_assert(Comparable<VertexHandle, VertexHandle>);
static_assert(!Comparable<VertexHandle, CellHandle>);
static_assert(!std::convertible_to<VertexHandle, EdgeHandle>);
static_assert(std::ranges::forward_range<EntityRange<CellHandle>>);
static_assert(std::ranges::view<EntityRange<VertexHandle>>);

TetMesh one_tet() {
    return TetMesh::from_cells({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}});
}

/// Two tets that share only the edge 0-1.
TetMesh pinched_edge() {
    return TetMesh::from_cells({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}},
                               {{0, 2, 3, 1}, {0, 4, 5, 1}});
}

/// Two tets that share only vertex 0.
TetMesh pinched_vertex() {
    return TetMesh::from_cells(
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
        {{0, 1, 2, 3}, {0, 5, 4, 6}});
}

}  // namespace

TEST_CASE("A Kuhn cube has the counts that combinatorics gives") {
    for (int n : {1, 2, 5}) {
        const TetMesh mesh = test::kuhn_cube(n);
        check_valid(mesh);
        const int cube = n * n * n;
        const int square = n * n;
        CHECK(int(mesh.n_cells()) == 6 * cube);
        CHECK(int(mesh.n_vertices()) == (n + 1) * (n + 1) * (n + 1));
        CHECK(int(mesh.n_boundary_faces()) == 12 * square);
        CHECK(int(mesh.n_faces()) == 12 * cube + 6 * square);
        // Euler: V - E + F - C = 1 for a ball.
        CHECK(int(mesh.n_vertices()) - int(mesh.n_edges()) + int(mesh.n_faces()) - int(mesh.n_cells()) == 1);
        CHECK(std::ranges::distance(mesh.faces()) == mesh.n_faces());
        CHECK(std::ranges::distance(mesh.boundary_faces()) == mesh.n_boundary_faces());
        CHECK(std::ranges::distance(mesh.boundary_halffaces()) == mesh.n_boundary_faces());
        CHECK(volume(mesh) == doctest::Approx(1).epsilon(1e-14));
        CHECK(boundary_area(mesh) == doctest::Approx(6).epsilon(1e-14));
    }
}

TEST_CASE("Incidences agree with a search through all cells") {
    const TetMesh mesh = test::kuhn_cube(3);
    for (auto v : mesh.vertices()) {
        std::set<CellHandle> cells;
        std::set<VertexHandle> vertices;
        for (auto c : mesh.cells())
            if (mesh.local_vertex(c, v) >= 0) {
                cells.insert(c);
                for (VertexHandle w : c.vertices())
                    if (w != v) vertices.insert(w);
            }
        const CellList found = v.cells();
        CHECK(std::set<CellHandle>(found.begin(), found.end()) == cells);
        CHECK(found.size() == cells.size());
        const VertexList around = v.vertices();
        CHECK(std::set<VertexHandle>(around.begin(), around.end()) == vertices);
        CHECK(v.edges().size() == vertices.size());
        const Point p = v.point();
        CHECK(v.is_boundary() == (p.minCoeff() == 0 || p.maxCoeff() == 1));
    }
    for (auto e : mesh.edges()) {
        const auto [a, b] = e.vertices();
        CHECK(a < b);
        CHECK(mesh.find_edge(b, a) == e);
        CHECK(mesh.from_vertex_handle(mesh.halfedge_handle(e, 0)) == a);
        CHECK(mesh.to_vertex_handle(mesh.opposite_halfedge_handle(mesh.halfedge_handle(e, 0))) == a);
        std::size_t n_cells = 0;
        for (auto c : mesh.cells()) n_cells += mesh.local_edge(c, a, b) >= 0 ? 1 : 0;
        CHECK(e.cells().size() == n_cells);
        // Round an inner edge there are as many faces as cells, round one of the boundary one more.
        CHECK(e.faces().size() == n_cells + (e.is_boundary() ? 1 : 0));
        // Cells that follow each other share a face.
        const CellList ring = e.cells();
        for (std::size_t i = 1; i < ring.size(); ++i) {
            const CellList next = mesh.cc_range(ring[i - 1]);
            CHECK(std::ranges::find(next, ring[i]) != next.end());
        }
    }
    for (auto hf : mesh.halffaces()) {
        const auto [a, b, c] = hf.vertices();
        CHECK(mesh.find_halfface(b, c, a) == hf);
        CHECK(mesh.find_halfface(c, b, a) == (hf.is_boundary() ? HalffaceHandle(hf) : hf.opposite()));
        CHECK(mesh.find_face(a, c, b) == mesh.face_handle(hf));
    }
    for (auto c : mesh.cells()) {
        const auto [v0, v1, v2, v3] = c.vertices();
        CHECK(mesh.find_cell(v3, v1, v0, v2) == c);
    }
}

TEST_CASE("Cells that touch in an edge or a vertex only are found by every query, also after splits") {
    TetMesh edge = pinched_edge();
    edge.request_edges();
    edge.request_faces();
    check_valid(edge);
    CHECK(edge.cells_around(VertexHandle(0), VertexHandle(1)).size() == 2);
    CHECK(edge.vc_range(VertexHandle(0)).size() == 2);
    const VertexHandle m = edge.split_edge(edge.find_edge(VertexHandle(0), VertexHandle(1)));
    CHECK(edge.n_cells() == 4);
    CHECK(edge.vc_range(m).size() == 4);
    check_valid(edge);
    edge.split_edge(edge.find_edge(m, VertexHandle(1)));
    edge.split_edge(edge.find_edge(VertexHandle(1), VertexHandle(2)));
    check_valid(edge);

    TetMesh vertex = pinched_vertex();
    check_valid(vertex);
    CHECK(vertex.vc_range(VertexHandle(0)).size() == 2);
    vertex.split_edge(vertex.find_edge(VertexHandle(0), VertexHandle(4)));
    vertex.split_edge(vertex.find_edge(VertexHandle(0), VertexHandle(1)));
    CHECK(vertex.vc_range(VertexHandle(0)).size() == 2);
    check_valid(vertex);
}

TEST_CASE("Random splits keep the mesh valid and its volume, numbered or not") {
    for (unsigned seed : {1U, 2U, 3U}) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        TetMesh mesh = test::kuhn_cube(2);
        if (seed % 2 == 1) {
            mesh.request_edges();
            mesh.request_faces();
        }
        for (int i = 0; i < 200; ++i) {
            const CellHandle c(static_cast<std::uint32_t>(random() % mesh.n_cells()));
            const int local = static_cast<int>(random() % 6);
            const std::size_t before = mesh.n_cells();
            const std::size_t n = mesh.cells_around(c, local).size();
            mesh.split_edge(c, local);
            CHECK(mesh.n_cells() == before + n);
        }
        check_valid(mesh);
        CHECK(volume(mesh) == doctest::Approx(1).epsilon(1e-12));
        CHECK(boundary_area(mesh) == doctest::Approx(6).epsilon(1e-12));
    }
}

TEST_CASE("The old cells keep the end that comes first, the new ones follow in the ring's order") {
    TetMesh mesh = test::kuhn_cube(2);
    const CellHandle c(5);
    const auto [i, j] = tet::edge_vertices[3];
    const VertexHandle a = mesh.cell_vertex(c, i);
    const VertexHandle b = mesh.cell_vertex(c, j);
    const CellList ring = mesh.cells_around(c, 3);
    const std::uint32_t first_new = mesh.n_cells();
    const VertexHandle m = mesh.split_edge(c, 3, 0.25);
    CHECK((mesh.point(m) - (0.75 * mesh.point(a) + 0.25 * mesh.point(b))).norm() < 1e-15);
    for (std::uint32_t r = 0; r < ring.size(); ++r) {
        CHECK(mesh.local_edge(ring[r], a, m) >= 0);
        CHECK(mesh.local_edge(CellHandle(first_new + r), m, b) >= 0);
    }
}

TEST_CASE("Deleting and collecting garbage leaves a valid mesh, and add_cell puts cells back") {
    for (unsigned seed : {11U, 12U, 13U, 14U}) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        TetMesh mesh = test::kuhn_cube(3);
        if (seed % 2 == 0) {
            mesh.request_edges();
            mesh.request_faces();
        }
        std::vector<std::array<VertexHandle, 4>> gone;
        double expected = 1;
        for (int i = 0; i < 60; ++i) {
            const CellHandle c(static_cast<std::uint32_t>(random() % mesh.n_cells()));
            if (mesh.status(c).deleted()) continue;
            gone.push_back(mesh.cell_vertices(c));
            expected -= volume(mesh, c);
            mesh.delete_cell(c);
        }
        check_valid(mesh);
        TetMesh collected = mesh;
        collected.delete_isolated_vertices();
        const IndexMaps maps = collected.garbage_collection();
        check_valid(collected);
        CHECK(volume(collected) == doctest::Approx(expected).epsilon(1e-12));
        for (auto c : mesh.cells()) {
            const auto old = mesh.cell_points(c);
            const auto moved = collected.cell_points(CellHandle(maps.cells[c.idx()]));
            for (int k = 0; k < 4; ++k) CHECK(old[k] == moved[k]);
        }
        for (const auto& v : gone) mesh.add_cell(v[0], v[1], v[2], v[3]);
        check_valid(mesh);
        CHECK(volume(mesh) == doctest::Approx(1).epsilon(1e-12));
        CHECK(mesh.n_boundary_faces() == 108);
    }
}

TEST_CASE("add_cell refuses what cannot be, saying why") {
    TetMesh mesh = one_tet();
    const VertexHandle above = mesh.add_vertex({1, 1, 1});
    const VertexHandle inside = mesh.add_vertex({.1, .1, .1});
    const auto v = [](std::uint32_t i) { return VertexHandle(i); };
    CHECK_THROWS_WITH_AS(mesh.add_cell(v(1), v(3), v(2), above), doctest::Contains("inverted"),
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(mesh.add_cell(v(1), v(3), v(2), inside), doctest::Contains("overlaps cell 0"),
                         std::invalid_argument);
    CHECK_THROWS_AS(mesh.add_cell(v(1), v(2), v(3), v(99)), std::invalid_argument);
    mesh.add_cell(v(1), v(2), v(3), above);
    check_valid(mesh);
    const VertexHandle beyond = mesh.add_vertex({2, 2, 2});
    CHECK_THROWS_AS(mesh.add_cell(v(1), v(2), v(3), beyond), std::invalid_argument);
    mesh.delete_cell(CellHandle(0));
    mesh.garbage_collection();
    CHECK(mesh.n_cells() == 1);
}

TEST_CASE("from_cells names what it cannot use") {
    const std::vector<Point> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {2, 2, 2}};
    CHECK_THROWS_WITH_AS(TetMesh::from_cells(points, {{0, 1, 2, 9}}), doctest::Contains("vertex 9"),
                         InputError);
    CHECK_THROWS_WITH_AS(TetMesh::from_cells(points, {{0, 1, 2, 1}}), doctest::Contains("twice"), InputError);
    CHECK_THROWS_WITH_AS(TetMesh::from_cells(points, {{0, 1, 2, 3}, {1, 2, 3, 4}, {1, 2, 3, 5}}),
                         doctest::Contains("vertices 1, 2 and 3"), InputError);
}

TEST_CASE("validate finds what is wrong") {
    TetMesh flat = one_tet();
    flat.set_point(VertexHandle(3), {.25, .25, 0});
    REQUIRE(validate(flat).errors.size() == 1);
    CHECK(validate(flat).errors[0] == "cell 0 is flat");
    flat.set_point(VertexHandle(3), {0, 0, -1e-300});
    CHECK(validate(flat).errors[0] == "cell 0 is inverted");
    flat.set_point(VertexHandle(3), {0, 0, 1e-300});
    CHECK(validate(flat).ok());
    // Two cells on the same side of their common face.
    const TetMesh overlapping = TetMesh::from_cells({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 2}},
                                                    {{0, 1, 2, 3}, {0, 1, 2, 4}});
    CHECK(validate(overlapping).errors.at(0).find("same side") != std::string::npos);
}

TEST_CASE("A copy is deep") {
    TetMesh mesh = one_tet();
    CPropHandleT<int> mark;
    mesh.add_property(mark, "mark");
    mesh.property(mark, CellHandle(0)) = 7;
    TetMesh copy = mesh;
    mesh.property(mark, CellHandle(0)) = 8;
    mesh.split_edge(CellHandle(0), 0);
    CHECK(copy.n_cells() == 1);
    CHECK(copy.property(mark, CellHandle(0)) == 7);
    const TetMesh moved = std::move(copy);
    CHECK(moved.property(mark, CellHandle(0)) == 7);
    check_valid(moved);
}
