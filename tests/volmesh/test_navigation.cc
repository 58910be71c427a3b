#include <algorithm>
#include <ranges>
#include <set>
#include <sstream>

#include <doctest/doctest.h>

#include "tests/support/kuhn.hh"
#include "volmesh/property_stats.hh"
#include "volmesh/tet_mesh.hh"

using namespace maille;
using namespace maille::volmesh;

namespace {

static_assert(std::ranges::random_access_range<SmartList<CellList>>);
static_assert(std::ranges::sized_range<SmartList<CellList>>);
static_assert(std::ranges::random_access_range<SmartArray<4, FaceHandle>>);
static_assert(std::ranges::forward_range<EntityRange<HalfedgeHandle>>);
static_assert(std::same_as<std::ranges::range_value_t<SmartList<CellList>>, SmartHandle<CellHandle>>);

/// The handles of a list, each of which must be there once.
template <class H, class Range>
std::set<H> set_of(const Range& range) {
    std::set<H> handles;
    for (const auto& h : range) CHECK(handles.insert(h).second);
    return handles;
}

bool has(const auto& vertices, VertexHandle v) {
    return std::ranges::find(vertices, v) != vertices.end();
}

/// A cube with a hole through a corner, cells that touch in an edge and in a vertex, and a lone tetrahedron.
TetMesh odd_mesh() {
    TetMesh mesh = test::kuhn_cube(2);
    for (std::uint32_t c : {0U, 7U, 20U, 21U, 40U}) mesh.delete_cell(CellHandle(c));
    mesh.append(TetMesh::from_cells({{5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {5, 0, 1}}, {{0, 1, 2, 3}}));
    return mesh;
}

}  // namespace

TEST_CASE("Every incidence is what a search through the whole mesh finds") {
    for (const TetMesh& mesh : {test::kuhn_cube(2), odd_mesh()}) {
        for (auto v : mesh.vertices()) {
            std::set<HalfedgeHandle> outgoing;
            std::set<HalfedgeHandle> incoming;
            std::set<FaceHandle> faces;
            std::set<HalffaceHandle> halffaces;
            for (auto he : mesh.halfedges()) {
                if (he.from() == v) outgoing.insert(he);
                if (he.to() == v) incoming.insert(he);
            }
            for (auto f : mesh.faces())
                if (has(f.vertices(), v)) faces.insert(f);
            for (auto hf : mesh.halffaces())
                if (has(hf.vertices(), v)) halffaces.insert(hf);
            CHECK(set_of<HalfedgeHandle>(v.outgoing_halfedges()) == outgoing);
            CHECK(set_of<HalfedgeHandle>(v.incoming_halfedges()) == incoming);
            CHECK(set_of<FaceHandle>(v.faces()) == faces);
            CHECK(set_of<HalffaceHandle>(v.halffaces()) == halffaces);
            CHECK(v.valence() == outgoing.size());
            CHECK(v.edges().size() == outgoing.size());
        }
        for (auto e : mesh.edges()) {
            const auto [a, b] = e.vertices();
            std::set<FaceHandle> faces;
            std::set<HalffaceHandle> halffaces;
            std::set<HalffaceHandle> along;  // that run from a to b
            for (auto f : mesh.faces())
                if (has(f.vertices(), a) && has(f.vertices(), b)) faces.insert(f);
            for (auto hf : mesh.halffaces())
                for (int i = 0; i < 3; ++i) {
                    const auto v = hf.vertices();
                    if (v[i] == a && v[(i + 1) % 3] == b) along.insert(hf);
                    if (std::minmax(v[i], v[(i + 1) % 3]) == std::minmax(a, b)) halffaces.insert(hf);
                }
            CHECK(set_of<FaceHandle>(e.faces()) == faces);
            CHECK(e.valence() == faces.size());
            CHECK(set_of<HalffaceHandle>(e.halffaces()) == halffaces);
            CHECK(set_of<HalffaceHandle>(e.halfedge(0).halffaces()) == along);
            CHECK(e.halfedge(1).halffaces().size() == e.cells().size());
            CHECK(set_of<CellHandle>(e.halfedge(1).cells()) == set_of<CellHandle>(e.cells()));
            CHECK(mesh.find_halfedge(a, b) == e.halfedge(0));
            CHECK(mesh.find_halfedge(b, a) == e.halfedge(0).opposite());
            CHECK(e.halfedges()[1].edge() == e);
            CHECK(e.halfedge(1).is_boundary() == e.is_boundary());
        }
        for (auto f : mesh.faces()) {
            std::set<CellHandle> cells;
            for (auto c : mesh.cells())
                if (std::ranges::all_of(f.vertices(), [&](auto v) { return has(c.vertices(), v); }))
                    cells.insert(c);
            CHECK(set_of<CellHandle>(f.cells()) == cells);
            for (auto hf : f.halffaces()) CHECK(hf.face() == f);
            CHECK(f.halffaces().size() == cells.size());
            CHECK(f.is_boundary() == (cells.size() == 1));
        }
        for (auto hf : mesh.halffaces()) {
            const auto v = hf.vertices();
            const auto halfedges = hf.halfedges();
            for (int i = 0; i < 3; ++i) {
                const auto he = halfedges[i];
                CHECK(he.from() == v[i]);
                CHECK(he.to() == v[(i + 1) % 3]);
                CHECK(hf.edges()[i] == he.edge());
                CHECK(mesh.next_halfedge_in_halfface(he, hf) == halfedges[(i + 1) % 3]);
                CHECK(mesh.prev_halfedge_in_halfface(he, hf) == halfedges[(i + 2) % 3]);
                CHECK(!mesh.next_halfedge_in_halfface(he.opposite(), hf).is_valid());
                // The neighbour in the cell has the opposite half-edge, and leads back.
                const auto beside = hf.adjacent_in_cell(he.edge());
                CHECK(beside != hf);
                CHECK(beside.cell() == hf.cell());
                CHECK(has(beside.halfedges() | std::views::transform([](auto h) { return h.from(); }), v[i]));
                CHECK(set_of<HalfedgeHandle>(beside.halfedges()).contains(he.opposite()));
                CHECK(beside.adjacent_in_cell(he.edge()) == hf);
                CHECK(mesh.adjacent_halfface_in_cell(hf, he.opposite()) == beside);
            }
            CHECK(!has(v, hf.opposite_vertex()));
            CHECK(has(hf.cell().vertices(), hf.opposite_vertex()));
            CHECK(mesh.halfface_opposite_vertex(hf.cell(), hf.opposite_vertex()) == hf);
            CHECK(!mesh.adjacent_halfface_in_cell(hf, mesh.find_edge(v[0], hf.opposite_vertex())).is_valid());
        }
        for (auto c : mesh.cells()) {
            CHECK(c.halffaces()[2].cell() == c);
            for (auto he : c.halfedges()) {
                CHECK(has(c.vertices(), he.from()));
                CHECK(has(c.vertices(), he.to()));
            }
            CHECK(set_of<HalfedgeHandle>(c.halfedges()).size() == 12);
            for (int f = 0; f < 4; ++f) CHECK(c.faces()[f] == c.halffaces()[f].face());
        }
    }
}

TEST_CASE("Nothing has a vertex twice") {
    const TetMesh mesh = test::kuhn_cube(1);
    for (auto a : mesh.vertices())
        for (auto b : mesh.vertices()) {
            for (const auto& [u, v, w] : {std::tuple(a, b, b), {b, a, b}, {b, b, a}}) {
                CHECK(!mesh.find_halfface(u, v, w).is_valid());
                CHECK(!mesh.find_face(u, v, w).is_valid());
                CHECK(!mesh.find_cell(u, v, w, VertexHandle(7)).is_valid());
            }
            if (a == b) CHECK(!mesh.find_edge(a, b).is_valid());
        }
}

TEST_CASE("Smart handles work with ranges' algorithms and views") {
    const TetMesh mesh = test::kuhn_cube(2);
    const auto v = make_smart(VertexHandle(13), mesh);
    const auto inner = [](auto c) { return !c.is_boundary(); };
    std::size_t n = 0;
    for (auto c : v.cells() | std::views::filter(inner)) n += c.neighbors().size() == 4;
    CHECK(n == std::size_t(std::ranges::count_if(v.cells(), inner)));
    const auto cells = v.cells();
    CHECK(cells.end() - cells.begin() == std::ptrdiff_t(cells.size()));
    CHECK(cells.begin()[3] == cells[3]);
    CHECK(*(cells.end() - 1) == cells.back());
    const CellList plain = cells;
    CHECK(std::ranges::equal(plain, cells));
    CPropHandleT<int> mark;
    TetMesh copy = mesh;
    copy.add_property(mark, "mark");
    for (auto c : copy.cells()) copy.property(mark, c) = int(c.idx());  // deduces from a smart handle
    CHECK(copy.property(mark, CellHandle(5)) == 5);
}

TEST_CASE("Marks are there between request and release, and pass to what a split creates") {
    TetMesh mesh = test::kuhn_cube(1);
    const TetMesh& constant = mesh;
    CHECK(!mesh.has_cell_status());
    CHECK(!constant.status(CellHandle(2)).selected());
    CHECK_THROWS_AS(mesh.status(CellHandle(2)).set_selected(true), std::logic_error);
    CHECK_THROWS_AS(mesh.release_vertex_status(), std::logic_error);
    mesh.request_cell_status();
    mesh.request_cell_status();
    mesh.request_edge_status();
    mesh.status(CellHandle(2)).set_selected(true);
    mesh.status(CellHandle(2)).set_tagged(true);
    mesh.status(CellHandle(2)).set_tagged(false);
    const EdgeHandle e = mesh.edge_handle(CellHandle(2), 0);
    mesh.status(e).set_feature(true);
    const std::uint32_t first = mesh.n_cells();
    const std::size_t n_around = mesh.ec_range(e).size();
    mesh.split_edge(CellHandle(2), 0);
    std::size_t n_selected = 0;
    for (auto c : mesh.cells()) {
        n_selected += mesh.status(c).selected();
        CHECK(!constant.status(c).tagged());
    }
    CHECK(mesh.n_cells() == first + n_around);
    CHECK(n_selected == 2);
    CHECK(std::ranges::count_if(mesh.edges(), [&](auto x) { return mesh.status(x).feature(); }) == 2);
    mesh.release_cell_status();
    CHECK(mesh.has_cell_status());
    CHECK(mesh.status(CellHandle(2)).selected());
    mesh.release_cell_status();
    CHECK(!mesh.has_cell_status());
    CHECK(!mesh.status(CellHandle(2)).selected());
    mesh.request_cell_status();
    CHECK(!mesh.status(CellHandle(2)).selected());
    mesh.delete_cell(CellHandle(2));
    CHECK(mesh.status(CellHandle(2)).deleted());
}

TEST_CASE("The mesh as a whole has properties, and all of them print") {
    TetMesh mesh = test::kuhn_cube(1);
    MPropHandleT<std::string> author;
    MPropHandleT<Eigen::Vector3d> gravity;
    mesh.add_property(author, "author", "A. Uthor");
    mesh.add_property(gravity, "gravity", {0, 0, -9.81});
    CHECK_THROWS_AS(mesh.add_property(gravity, "gravity"), std::invalid_argument);
    mesh.property(author) += ", B.";
    const TetMesh copy = mesh;
    mesh.property(gravity).z() = 0;
    CHECK(copy.property(gravity).z() == -9.81);
    MPropHandleT<std::string> found;
    REQUIRE(copy.get_property_handle(found, "author"));
    CHECK(copy.property(found) == "A. Uthor, B.");
    MPropHandleT<int> other_type;
    CHECK(!copy.get_property_handle(other_type, "author"));

    CPropHandleT<double> density;
    VPropHandleT<bool> fixed;
    EPropHandleT<std::vector<int>> list;
    FPropHandleT<Eigen::Matrix2d> matrix;
    mesh.add_property(density, "density", PropertyRule::share, 0.1);
    mesh.add_property(fixed, "fixed");
    mesh.add_property(list, "list", {}, {1, 2});
    mesh.add_property(matrix, "matrix", PropertyHeritage<Eigen::Matrix2d>(), Eigen::Matrix2d::Identity());
    std::ostringstream out;
    property_stats(mesh, out);
    CHECK(out.str() ==
          "vertex 'fixed': 8 x bool, copy\n"
          "edge 'list': 19 x std::vector<int, std::allocator<int> >, copy\n"
          "face 'matrix': 18 x Eigen::Matrix<double, 2, 2, 0, 2, 2>, copy\n"
          "cell 'density': 6 x double, share\n"
          "mesh 'author': string = A. Uthor, B.\n"
          "mesh 'gravity': Vector3d = (0, 0, 0)\n");
    CHECK(mesh.properties(EntityKind::cell).all()[0]->text(3) == "0.1");
    CHECK(mesh.properties(EntityKind::vertex).all()[0]->text(0) == "false");
    CHECK(mesh.properties(EntityKind::edge).all()[0]->default_text() == "(1, 2)");
    CHECK(mesh.properties(EntityKind::face).all()[0]->text(0) == "1 0\n0 1");
    mesh.remove_property(author);
    CHECK(!author.is_valid());
    CHECK(!mesh.get_property_handle(found, "author"));
}
