#include <algorithm>
#include <random>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include "tests/support/kuhn.hh"
#include "volmesh/cell_table.hh"
#include "volmesh/column.hh"
#include "volmesh/validate.hh"

using namespace maille;
using namespace maille::volmesh;

namespace {

/// Edges of which no two have a cell in common, as many as come up at random.
EdgeStars random_stars(const TetMesh& mesh, std::mt19937& random) {
    EdgeStars stars;
    std::vector<std::uint8_t> taken(mesh.n_cells());
    for (std::uint32_t i = 0; i < mesh.n_cells(); ++i) {
        const CellHandle c(static_cast<std::uint32_t>(random() % mesh.n_cells()));
        const int local = static_cast<int>(random() % 6);
        const CellList ring = mesh.cells_around(c, local);
        if (std::ranges::any_of(ring, [&](CellHandle r) { return taken[r.idx()] != 0; })) continue;
        for (const CellHandle r : ring) taken[r.idx()] = 1;
        const auto [a, b] = tet::edge_vertices[local];
        stars.add({mesh.cell_vertex(c, a), mesh.cell_vertex(c, b)}, {ring.data(), ring.size()});
    }
    return stars;
}

/// Sets and properties of every kind, at random.
void carry_much(TetMesh& mesh, std::mt19937& random, bool with_edges_and_faces) {
    const SetHandle part = mesh.add_set("part", EntityKind::cell);
    const SetHandle skin = mesh.add_set("skin", EntityKind::face);
    const SetHandle passing = mesh.add_set("passing", EntityKind::face, SetRule::none());
    const SetHandle line = mesh.add_set("line", EntityKind::edge);
    const SetHandle ends = mesh.add_set("ends", EntityKind::vertex, SetRule::both_ends(part));
    mesh.add_set("on skin", EntityKind::vertex, SetRule::from_faces(skin));
    mesh.add_set("on line", EntityKind::vertex, SetRule::from_edges(line));
    for (const auto c : mesh.cells()) {
        if (random() % 3 == 0) mesh.insert(part, CellHandle(c));
        if (random() % 3 == 0) mesh.insert(skin, TetMesh::halfface(c, static_cast<int>(random() % 4)));
        if (random() % 5 == 0) mesh.insert(passing, TetMesh::halfface(c, static_cast<int>(random() % 4)));
        if (random() % 4 == 0) mesh.insert(line, c, static_cast<int>(random() % 6));
    }
    for (const auto v : mesh.vertices())
        if (random() % 2 == 0) mesh.insert(ends, VertexHandle(v));
    VPropHandleT<double> heat;
    CPropHandleT<double> mass;
    mesh.add_property(heat, "heat", {PropertyRule::interpolate});
    mesh.add_property(mass, "mass", {PropertyRule::share});
    for (const auto v : mesh.vertices()) mesh.property(heat, VertexHandle(v)) = static_cast<double>(random());
    for (const auto c : mesh.cells()) mesh.property(mass, CellHandle(c)) = static_cast<double>(random());
    if (!with_edges_and_faces) return;
    EPropHandleT<double> load;
    FPropHandleT<int> mark;
    mesh.add_property(load, "load", {PropertyRule::share});
    mesh.add_property(mark, "mark");
    for (const auto e : mesh.edges()) mesh.property(load, EdgeHandle(e)) = static_cast<double>(random());
    for (const auto f : mesh.faces()) mesh.property(mark, FaceHandle(f)) = static_cast<int>(random() % 100);
}

template <class Entity, class T>
void check_same_values(const TetMesh& a, const TetMesh& b, const char* name, std::uint32_t n) {
    PropertyHandle<Entity, T> of_a, of_b;
    REQUIRE(a.get_property_handle(of_a, name));
    REQUIRE(b.get_property_handle(of_b, name));
    bool are_same = true;
    for (std::uint32_t i = 0; i < n; ++i)
        are_same &= a.property(of_a, Entity(i)) == b.property(of_b, Entity(i));
    CHECK(are_same);
}

void check_same(const TetMesh& a, const TetMesh& b, bool with_edges_and_faces) {
    CHECK(std::ranges::equal(a.cell_vertex_indices(), b.cell_vertex_indices()));
    CHECK(std::ranges::equal(a.points(), b.points()));
    REQUIRE(a.n_boundary_faces() == b.n_boundary_faces());
    bool are_same = true;
    for (std::uint32_t i = 0; i < a.n_halffaces(); ++i)
        are_same &=
            a.opposite_halfface_handle(HalffaceHandle(i)) == b.opposite_halfface_handle(HalffaceHandle(i));
    for (std::uint32_t i = 0; i < a.n_sets(); ++i) {
        const SetHandle s(i);
        are_same &= a.vertex_members(s) == b.vertex_members(s) && a.cell_members(s) == b.cell_members(s) &&
                    a.face_members(s) == b.face_members(s) && a.edge_members(s) == b.edge_members(s);
    }
    CHECK(are_same);
    check_same_values<VertexHandle, double>(a, b, "heat", a.n_vertices());
    check_same_values<CellHandle, double>(a, b, "mass", a.n_cells());
    if (!with_edges_and_faces) return;
    REQUIRE(a.n_edges() == b.n_edges());
    check_same_values<EdgeHandle, double>(a, b, "load", a.n_edges());
    check_same_values<FaceHandle, int>(a, b, "mark", a.n_faces());
}

}  // namespace

TEST_CASE("many edges split at once are as if split one after another, by any number of threads") {
    for (const unsigned seed : {1U, 2U, 3U, 4U}) {
        CAPTURE(seed);
        const bool with_edges_and_faces = seed % 2 == 0;
        std::mt19937 random(seed);
        TetMesh one_by_one = test::kuhn_cube(5);
        carry_much(one_by_one, random, with_edges_and_faces);
        std::vector<TetMesh> at_once(3, one_by_one);
        for (int pass = 0; pass < 4; ++pass) {
            const EdgeStars stars = random_stars(one_by_one, random);
            for (std::size_t i = 0; i < stars.size(); ++i) {
                const CellHandle c = stars.ring(i).front();
                const auto [a, b] = stars.edge(i);
                const CellList ring(stars.ring(i).begin(), stars.ring(i).end());
                const int local = one_by_one.local_edge(c, a, b);
                // The end that the old cells keep is the first in the cell given; have it so in both.
                if (one_by_one.cell_vertex(c, tet::edge_vertices[local][0]) == a)
                    one_by_one.split_edge(c, local, 0.5, ring);
                else
                    one_by_one.split_edges([&] {
                        EdgeStars one;
                        one.add({a, b}, stars.ring(i));
                        return one;
                    }());
            }
            for (int threads = 1; threads <= 3; ++threads)
                tbb::task_arena(threads).execute([&] { at_once[threads - 1].split_edges(stars); });
        }
        CHECK(validate(one_by_one).ok());
        for (const TetMesh& mesh : at_once) check_same(one_by_one, mesh, with_edges_and_faces);
    }
}

TEST_CASE("edges of a pinched mesh can be split at once") {
    // Two pairs of cells that have just the edge 0-1 in common.
    TetMesh mesh = TetMesh::from_cells(
        {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 0, 0}, {-1, -1, 0}, {0, -1, 0}},
        {{0, 2, 3, 1}, {0, 3, 4, 1}, {0, 5, 6, 1}, {0, 6, 7, 1}});
    const CellList ring = mesh.cells_around(VertexHandle(0), VertexHandle(1));
    REQUIRE(ring.size() == 4);
    EdgeStars stars;
    stars.add({VertexHandle(0), VertexHandle(1)}, {ring.data(), ring.size()});
    const VertexHandle m = mesh.split_edges(stars);
    CHECK(validate(mesh).ok());
    CHECK(mesh.vc_range(m).size() == 8);
    CHECK(mesh.cells_around(m, VertexHandle(1)).size() == 4);
}

TEST_CASE("tables of cells hold what walks find") {
    std::mt19937 random(5);
    TetMesh mesh = test::kuhn_cube(3);
    for (int i = 0; i < 100; ++i)
        mesh.split_edge(CellHandle(static_cast<std::uint32_t>(random() % mesh.n_cells())),
                        static_cast<int>(random() % 6));
    mesh.delete_cell(CellHandle(7));
    const auto at_vertices = vertex_cells(mesh);
    const auto at_edges = edge_cells(mesh);
    for (const auto v : mesh.vertices()) {
        CellList walked = mesh.vc_range(v);
        std::ranges::sort(walked);
        CHECK(std::ranges::equal(at_vertices[v], walked));
    }
    for (const auto e : mesh.edges()) {
        CellList walked = mesh.ec_range(e);
        std::ranges::sort(walked);
        CHECK(std::ranges::equal(at_edges[e], walked));
    }
}

TEST_CASE("a column keeps its values as it grows, and copies deeply") {
    Column<int> column;
    for (int i = 0; i < 100'000; ++i) column.push_back(i);
    const Column<int> copy = column;
    column.grow(5'000'000);
    column[3] = 0;
    bool are_kept = true;
    for (int i = 0; i < 100'000; ++i) are_kept &= copy[i] == i && (i == 3 || column[i] == i);
    CHECK(are_kept);
    column.push_back(column[7]);
    CHECK(column[5'000'000] == 7);
    column.assign(3, 9);
    CHECK(column.size() == 3);
    CHECK(std::ranges::equal(column, std::vector{9, 9, 9}));
    Column<int> moved = std::move(column);
    CHECK(moved.size() == 3);
}
