#include <algorithm>
#include <map>
#include <random>
#include <tuple>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/kuhn.hh"
#include "tests/support/random_sets.hh"
#include "volmesh/cell_exchange.hh"
#include "volmesh/error.hh"
#include "volmesh/submesh.hh"
#include "volmesh/validate.hh"

using namespace maille;
using namespace maille::volmesh;

namespace {

using Index = TetMesh::Index;
using Place = std::array<double, 3>;

/// The places of an entity's vertices, the names of its sets, and its value.
using Told = std::tuple<std::vector<Place>, std::vector<std::string>, double>;

template <class H>
double value_of(const TetMesh& mesh, H h) {
    PropertyHandle<H, double> ph;
    return mesh.get_property_handle(ph, "value") ? mesh.property(ph, h) : 0;
}

Told told(const TetMesh& mesh, const auto& vertices, CombinationId sets, double value) {
    std::vector<Place> places;
    for (const VertexHandle v : vertices) {
        const Point& p = mesh.point(v);
        places.push_back({p.x(), p.y(), p.z()});
    }
    std::ranges::sort(places);
    std::vector<std::string> names;
    for (const SetHandle s : mesh.sets_of(sets)) names.push_back(mesh.set_info(s).name);
    return {places, names, value};
}

/// All vertices, cells, half-faces and edges of cells, numbers aside.
std::vector<Told> contents(const TetMesh& mesh) {
    std::vector<Told> all;
    for (const VertexHandle v : mesh.vertices())
        all.push_back(told(mesh, std::array{v}, mesh.combination(v), value_of(mesh, v)));
    for (const CellHandle c : mesh.cells()) {
        all.push_back(told(mesh, mesh.cell_vertices(c), mesh.combination(c), value_of(mesh, c)));
        for (int f = 0; f < 4; ++f) {
            const HalffaceHandle face = TetMesh::halfface(c, f);
            all.push_back(told(mesh, mesh.halfface_vertices(face), mesh.combination(face), -2));
        }
        for (int e = 0; e < 6; ++e) {
            const auto [i, j] = tet::edge_vertices[e];
            const std::array ends{mesh.cell_vertex(c, i), mesh.cell_vertex(c, j)};
            all.push_back(told(mesh, ends, mesh.combination(c, e), -3));
        }
    }
    std::ranges::sort(all);
    return all;
}

TetMesh mesh_with_sets(std::mt19937& random) {
    TetMesh mesh = test::kuhn_cube(4);
    test::shake(mesh, .02, random);
    test::add_random_sets(mesh, random);
    VPropHandleT<double> of_vertex;
    mesh.add_property(of_vertex, "value", PropertyRule::copy, -1);
    for (const VertexHandle v : mesh.vertices()) mesh.property(of_vertex, v) = double(random() % 1000);
    CPropHandleT<double> of_cell;
    mesh.add_property(of_cell, "value", PropertyRule::copy, -1);
    for (const CellHandle c : mesh.cells()) mesh.property(of_cell, c) = double(random() % 1000);
    return mesh;
}

/// Cells near a place, or one in so many.
std::vector<CellHandle> some_cells(const TetMesh& mesh, std::mt19937& random) {
    std::vector<CellHandle> cells;
    const unsigned kind = random() % 4;
    const Point middle(double(random() % 3) / 2, .4, .6);
    for (const CellHandle c : mesh.cells())
        if (kind == 0 ? random() % 3 == 0 : (mesh.cell_points(c)[0] - middle).norm() < .2 * kind)
            cells.push_back(c);
    std::ranges::shuffle(cells, random);
    return cells;
}

/// The cells given as they are to be put in again, after they are taken out; some neighbours are not told.
CellExchange round_trip(const TetMesh& mesh, const std::vector<CellHandle>& cells, std::mt19937& random) {
    CellExchange change{cells, {}, {}};
    std::map<CellHandle, Index> places;
    for (const CellHandle c : cells) places.emplace(c, static_cast<Index>(places.size()));
    std::map<VertexHandle, Index> numbers;
    const auto number = [&](VertexHandle v) {
        if (std::ranges::any_of(mesh.vc_range(v), [&](CellHandle c) { return !places.contains(c); }))
            return v.idx();
        const auto [at, is_new] = numbers.try_emplace(v, mesh.n_vertices() + numbers.size());
        if (is_new) change.points.push_back(mesh.point(v));
        return at->second;
    };
    std::map<HalffaceHandle, bool> tells;  // by the lower half-face
    for (const CellHandle c : cells) {
        TetMesh::Cell cell{};
        for (int k = 0; k < 4; ++k) {
            cell.vertices[k] = number(mesh.cell_vertex(c, k));
            const HalffaceHandle face = TetMesh::halfface(c, k), other = mesh.opposite_halfface_handle(face);
            const bool is_inside = other.is_valid() && places.contains(TetMesh::incident_cell(other));
            if (is_inside && tells.try_emplace(std::min(face, other), random() % 2 == 0).first->second)
                cell.neighbors[k] = 4 * places.at(TetMesh::incident_cell(other)) + TetMesh::local_face(other);
            else
                cell.neighbors[k] = TetMesh::none;
        }
        change.cells.push_back(cell);
    }
    return change;
}

void require_valid(const TetMesh& mesh) {
    const auto found = validate(mesh);
    for (const auto& error : found.errors) MESSAGE(error);
    REQUIRE(found.ok());
}

/// Whether every question about who is beside whom has the answer that a mesh made from the cells gives.
void check_incidences(const TetMesh& mesh) {
    std::vector<std::array<Index, 4>> cells(mesh.cell_vertex_indices().begin(),
                                            mesh.cell_vertex_indices().end());
    const TetMesh anew = TetMesh::from_cells({mesh.points().begin(), mesh.points().end()}, cells);
    CHECK(mesh.n_boundary_faces() == anew.n_boundary_faces());
    const auto ascending = [](CellList list) {
        std::ranges::sort(list);
        return list;
    };
    for (const HalffaceHandle face : anew.halffaces())
        REQUIRE(mesh.opposite_halfface_handle(face) == anew.opposite_halfface_handle(face));
    for (const VertexHandle v : anew.vertices())
        REQUIRE(ascending(mesh.vc_range(v)) == ascending(anew.vc_range(v)));
    for (const CellHandle c : anew.cells())
        for (int e = 0; e < 6; ++e)
            REQUIRE(ascending(mesh.cells_around(c, e)) == ascending(anew.cells_around(c, e)));
}

}  // namespace

TEST_CASE("cells taken out leave what a part of the mesh has") {
    std::mt19937 random(1);
    for (int i = 0; i < 12; ++i) {
        CAPTURE(i);
        const TetMesh before = mesh_with_sets(random);
        const std::vector<CellHandle> gone = some_cells(before, random);
        std::vector<CellHandle> left;
        for (const CellHandle c : before.cells())
            if (std::ranges::find(gone, c) == gone.end()) left.push_back(c);
        TetMesh mesh = before;
        const ExchangedNumbers numbers = mesh.exchange_cells({gone, {}, {}});
        require_valid(mesh);
        check_incidences(mesh);
        CHECK(numbers.n_cells == left.size());
        CHECK(numbers.n_vertices == mesh.n_vertices());
        CHECK(contents(mesh) == contents(submesh(before, left).mesh));
        for (const CellHandle c : left)
            CHECK(mesh.cell_points(CellHandle(numbers.cell(c.idx()))) == before.cell_points(c));
        for (const CellHandle c : gone)
            CHECK((c.idx() < numbers.n_cells || numbers.cell(c.idx()) == TetMesh::none));
    }
}

TEST_CASE("cells put in again where they were make the mesh that was") {
    std::mt19937 random(2);
    for (int i = 0; i < 12; ++i) {
        CAPTURE(i);
        const TetMesh before = mesh_with_sets(random);
        std::vector<CellHandle> cells = some_cells(before, random);
        if (i == 0) cells.assign(before.cells().begin(), before.cells().end());
        TetMesh mesh = before;
        const ExchangedNumbers numbers = mesh.exchange_cells(round_trip(before, cells, random));
        require_valid(mesh);
        check_incidences(mesh);
        REQUIRE(mesh.n_cells() == before.n_cells());
        REQUIRE(mesh.n_vertices() == before.n_vertices());
        for (const CellHandle c : before.cells()) {
            const auto at = std::ranges::find(cells, c) - cells.begin();
            const CellHandle after(static_cast<std::size_t>(at) == cells.size()
                                       ? numbers.cell(c.idx())
                                       : numbers.n_cells + static_cast<Index>(at));
            CHECK(mesh.cell_points(after) == before.cell_points(c));
            const bool is_new = after.idx() >= numbers.n_cells;
            CHECK(value_of(mesh, after) == (is_new ? -1 : value_of(before, c)));
            CHECK((is_new ? mesh.sets_of(mesh.combination(after)).empty()
                          : std::ranges::equal(mesh.sets_of(mesh.combination(after)),
                                               before.sets_of(before.combination(c)))));
            // What is new has the sets of the faces and edges that it shares.
            for (int f = 0; f < 4; ++f) {
                const HalffaceHandle face = TetMesh::halfface(after, f),
                                     other = mesh.opposite_halfface_handle(face);
                if (other.is_valid() && is_new && TetMesh::incident_cell(other).idx() < numbers.n_cells)
                    CHECK(mesh.combination(face) == mesh.combination(other));
            }
        }
    }
}

TEST_CASE("cells that cannot be exchanged are refused") {
    TetMesh mesh = test::kuhn_cube(2);
    const auto corner = [&](CellHandle c, int k) { return mesh.cell_vertex(c, k).idx(); };
    const CellHandle c(7);
    const TetMesh::Cell same{{corner(c, 0), corner(c, 1), corner(c, 2), corner(c, 3)},
                             {TetMesh::none, TetMesh::none, TetMesh::none, TetMesh::none}};
    const auto with = [](const TetMesh::Cell& cell) {
        CellExchange change;
        change.cells.push_back(cell);
        return change;
    };
    TetMesh copy = mesh;
    CHECK_THROWS_AS(copy.exchange_cells(with(same)), InputError);  // each of its faces has two cells already

    copy = mesh;
    TetMesh::Cell wrong = same;
    wrong.vertices[2] = mesh.n_vertices();
    CHECK_THROWS_AS(copy.exchange_cells(with(wrong)), std::invalid_argument);  // no such point is given

    copy = mesh;
    CellExchange all = with(same);
    all.gone.assign(mesh.cells().begin(), mesh.cells().end());
    CHECK_THROWS_AS(copy.exchange_cells(all), std::invalid_argument);  // its vertices are gone

    copy = mesh;
    copy.delete_cell(c);
    CHECK_THROWS_AS(copy.exchange_cells({}), std::logic_error);

    copy = mesh;
    EPropHandleT<int> of_edges;
    copy.add_property(of_edges, "bends");
    CHECK_THROWS_AS(copy.exchange_cells({}), std::logic_error);
}
