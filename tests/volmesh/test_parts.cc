#include <algorithm>
#include <map>
#include <random>
#include <tuple>

#include <doctest/doctest.h>

#include "tests/support/kuhn.hh"
#include "tests/support/random_sets.hh"
#include "volmesh/error.hh"
#include "volmesh/measure.hh"
#include "volmesh/renumber.hh"
#include "volmesh/submesh.hh"
#include "volmesh/validate.hh"

using namespace maille;
using namespace maille::volmesh;

namespace {

using Place = std::array<double, 3>;

Place place_of(const Point& p) {
    return {p.x(), p.y(), p.z()};
}

/// What is known of one entity, numbers aside: the sorted places of its vertices, and what is told of it.
struct Told {
    std::vector<Place> places;
    std::vector<std::string> sets;
    double value;
    auto operator<=>(const Told&) const = default;
};

std::vector<std::string> names_of(const TetMesh& mesh, CombinationId id) {
    std::vector<std::string> names;
    for (SetHandle s : mesh.sets_of(id)) names.push_back(mesh.set_info(s).name);
    std::ranges::sort(names);
    return names;
}

template <class H>
double value_of(const TetMesh& mesh, H h) {
    PropertyHandle<H, double> ph;
    return mesh.get_property_handle(ph, "value") ? mesh.property(ph, h) : 0;
}

Told told(const TetMesh& mesh, const auto& vertices, CombinationId id, double value) {
    Told all{{}, names_of(mesh, id), value};
    for (VertexHandle v : vertices) all.places.push_back(place_of(mesh.point(v)));
    std::ranges::sort(all.places);
    return all;
}

/// All that can be told of a mesh without its numbers.
std::array<std::vector<Told>, 4> contents(const TetMesh& mesh) {
    std::array<std::vector<Told>, 4> all;
    for (auto v : mesh.vertices())
        all[0].push_back(told(mesh, std::array{VertexHandle(v)}, mesh.combination(VertexHandle(v)),
                              value_of<VertexHandle>(mesh, v)));
    for (auto e : mesh.edges()) {
        const auto [c, local] = mesh.edge_place(e);
        all[1].push_back(told(mesh, e.vertices(), mesh.combination(c, local), value_of<EdgeHandle>(mesh, e)));
    }
    for (auto f : mesh.faces())
        all[2].push_back(told(mesh, f.vertices(), mesh.combination(mesh.halfface_handle(f, 0)),
                              value_of<FaceHandle>(mesh, f)));
    for (auto c : mesh.cells())
        all[3].push_back(
            told(mesh, c.vertices(), mesh.combination(CellHandle(c)), value_of<CellHandle>(mesh, c)));
    for (auto& of_kind : all) std::ranges::sort(of_kind);
    return all;
}

template <class H>
void add_values(TetMesh& mesh, const auto& entities, std::mt19937& random) {
    PropertyHandle<H, double> ph;
    mesh.add_property(ph, "value", PropertyRule::copy, -1);
    for (const H h : entities) mesh.property(ph, h) = double(random() % 1000);
}

/// Sets and values of all kinds, edges and faces numbered, some cells deleted.
TetMesh rich_mesh(unsigned seed, int n = 3) {
    std::mt19937 random(seed);
    TetMesh mesh = test::kuhn_cube(n);
    test::shake(mesh, 0.1 / n, random);
    test::add_random_sets(mesh, random);
    add_values<VertexHandle>(mesh, mesh.vertices(), random);
    add_values<EdgeHandle>(mesh, mesh.edges(), random);
    add_values<FaceHandle>(mesh, mesh.faces(), random);
    add_values<CellHandle>(mesh, mesh.cells(), random);
    for (int i = 0; i < 10; ++i)
        mesh.delete_cell(CellHandle(static_cast<std::uint32_t>(random() % mesh.n_cells())));
    mesh.delete_isolated_vertices();
    return mesh;
}

void require_valid(const TetMesh& mesh) {
    const auto found = validate(mesh);
    for (const auto& error : found.errors) MESSAGE(error);
    REQUIRE(found.ok());
}

std::vector<Told> both(std::vector<Told> a, const std::vector<Told>& b) {
    a.insert(a.end(), b.begin(), b.end());
    std::ranges::sort(a);
    return a;
}

}  // namespace

TEST_CASE("a part of a mesh has what the whole has there") {
    for (unsigned seed = 1; seed <= 4; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        const TetMesh mesh = rich_mesh(seed);
        std::vector<CellHandle> cells;
        for (const CellHandle c : mesh.cells())
            if (random() % 3 == 0) cells.push_back(c);
        std::ranges::shuffle(cells, random);
        const SubMesh part = submesh(mesh, cells);
        require_valid(part.mesh);
        CHECK(part.mesh.n_cells() == cells.size());
        CHECK(std::ranges::is_sorted(part.cells));
        CHECK(std::ranges::is_sorted(part.vertices));
        for (auto v : part.mesh.vertices()) {
            CHECK(v.point() == mesh.point(part.vertices[v.idx()]));
            CHECK(!v.cells().empty());
        }
        for (auto c : part.mesh.cells())
            for (int i = 0; i < 4; ++i)
                CHECK(part.vertices[c.vertices()[i].idx()] == mesh.cell_vertex(part.cells[c.idx()], i));
        // Everything in the part is in the whole, with the same sets and values.
        const auto in_part = contents(part.mesh);
        const auto in_whole = contents(mesh);
        for (int kind = 0; kind < 4; ++kind) CHECK(std::ranges::includes(in_whole[kind], in_part[kind]));
        CHECK(in_part[3].size() == cells.size());
    }
}

TEST_CASE("a part is told by a set of cells, and wrong cells are refused") {
    TetMesh mesh = test::kuhn_cube(2);
    const auto lower = mesh.add_set("lower", EntityKind::cell);
    const auto faces = mesh.add_set("faces", EntityKind::face);
    for (auto c : mesh.cells())
        if (std::ranges::all_of(c.vertices(), [](auto v) { return v.point().z() <= 0.5; }))
            mesh.insert(lower, c);
    const SubMesh part = submesh(mesh, lower);
    CHECK(volume(part.mesh) == doctest::Approx(0.5).epsilon(1e-14));
    CHECK(part.mesh.n_vertices() == 18);
    CHECK(part.mesh.set_size(part.mesh.find_set("lower", EntityKind::cell)) == 24);
    CHECK_THROWS_AS(submesh(mesh, faces), std::invalid_argument);
    const std::vector twice{CellHandle(1), CellHandle(1)};
    CHECK_THROWS_AS(submesh(mesh, twice), std::invalid_argument);
    const std::vector beyond{CellHandle(999)};
    CHECK_THROWS_AS(submesh(mesh, beyond), std::invalid_argument);
    CHECK_THROWS_AS(mesh.taken({}, std::vector{CellHandle(0)}), std::invalid_argument);
    CHECK(mesh.taken({}, {}).n_cells() == 0);
}

TEST_CASE("appending puts two meshes side by side, with all that they have") {
    for (unsigned seed = 1; seed <= 4; ++seed) {
        CAPTURE(seed);
        TetMesh first = rich_mesh(seed, 2);
        TetMesh second = rich_mesh(seed + 10, 2);
        for (auto v : second.vertices()) second.set_point(v, v.point() + Point(3, 0, 0));
        const auto in_first = contents(first);
        const auto in_second = contents(second);
        TetMesh together = first;
        together.append(second);
        require_valid(together);
        const auto in_both = contents(together);
        for (int kind = 0; kind < 4; ++kind) CHECK(in_both[kind] == both(in_first[kind], in_second[kind]));
        CHECK(together.n_sets() == first.n_sets());
        CHECK(together.n_boundary_faces() == first.n_boundary_faces() + second.n_boundary_faces());
        // The first mesh's handles still mean the same, the second's are shifted.
        for (auto c : second.cells())
            CHECK(together.cell_points(CellHandle(c.idx() + first.n_cells())) == second.cell_points(c));
        for (auto e : first.edges()) CHECK(together.edge_vertices(e) == first.edge_vertices(e));
        // It lives on as any mesh.
        together.split_edge(CellHandle(together.n_cells() - 1), 2);
        together.garbage_collection();
        require_valid(together);
    }
}

TEST_CASE("appending unites sets and properties by name, and minds cells that merely touch") {
    TetMesh plain = test::kuhn_cube(1);
    CPropHandleT<int> mark;
    plain.add_property(mark, "mark", {}, 7);
    TetMesh other = TetMesh::from_cells({{5, 0, 0}, {5, 0, 1}, {6, 0, 0}, {6, 1, 0}, {4, 0, 0}, {4, -1, 0}},
                                        {{0, 2, 3, 1}, {0, 4, 5, 1}});  // touch in the edge 0-1
    const auto faces = other.add_set("wall", EntityKind::face);
    const auto fixed = other.add_set("fixed", EntityKind::vertex, SetRule::from_faces(faces));
    other.insert(faces, HalffaceHandle(0));
    other.insert(fixed, VertexHandle(2));
    VPropHandleT<double> heat;
    other.add_property(heat, "heat", PropertyRule::interpolate, 20);
    MPropHandleT<std::string> title;
    other.add_property(title, "title", "other");
    plain.append(other);
    require_valid(plain);
    CHECK(plain.property(mark, CellHandle(6)) == 7);
    REQUIRE(plain.get_property_handle(heat, "heat"));
    CHECK(plain.property(heat, VertexHandle(0)) == 20);
    REQUIRE(plain.get_property_handle(title, "title"));
    const auto source = plain.set_info(plain.find_set("fixed", EntityKind::vertex)).rule.source;
    CHECK(source == plain.find_set("wall", EntityKind::face));
    CHECK(plain.cells_around(VertexHandle(8), VertexHandle(9)).size() == 2);
    CHECK(plain.vc_range(VertexHandle(8)).size() == 2);

    TetMesh clash = test::kuhn_cube(1);
    CPropHandleT<double> real_mark;
    clash.add_property(real_mark, "mark");
    const auto before = plain.n_cells();
    CHECK_THROWS_WITH_AS(plain.append(clash), doctest::Contains("'mark'"), InputError);
    CHECK(plain.n_cells() == before);
    plain.append(plain);
    CHECK(plain.n_cells() == 2 * before);
    require_valid(plain);
}

TEST_CASE("Hilbert's curve comes to every cell of a grid, and steps to a neighbour each time") {
    for (int n : {2, 4, 8}) {
        std::vector<std::pair<std::uint64_t, std::array<int, 3>>> cells;
        for (int x = 0; x < n; ++x)
            for (int y = 0; y < n; ++y)
                for (int z = 0; z < n; ++z)
                    cells.push_back({hilbert_index((Point(x, y, z) + Point::Constant(0.5)) / n), {x, y, z}});
        std::ranges::sort(cells);
        for (std::size_t i = 1; i < cells.size(); ++i) {
            CHECK(cells[i].first > cells[i - 1].first);
            int distance = 0;
            for (int k = 0; k < 3; ++k) distance += std::abs(cells[i].second[k] - cells[i - 1].second[k]);
            CHECK(distance == 1);
        }
    }
    CHECK(hilbert_index({-1, 0, 0}) == hilbert_index({0, 0, 0}));
    CHECK(hilbert_index({2, 1, 1}) == hilbert_index({1, 1, 1}));
}

TEST_CASE("renumbering changes numbers only, tells them, and brings neighbours together") {
    for (unsigned seed = 1; seed <= 3; ++seed) {
        CAPTURE(seed);
        TetMesh mesh = rich_mesh(seed, 4);
        const TetMesh before = mesh;
        const IndexMaps maps = renumber(mesh);
        require_valid(mesh);
        CHECK(contents(mesh) == contents(before));
        CHECK(!mesh.has_deleted());
        for (auto v : before.vertices()) CHECK(mesh.point(VertexHandle(maps.vertices[v.idx()])) == v.point());
        for (auto e : before.edges()) {
            auto ends = before.edge_vertices(e);
            for (auto& v : ends) v = VertexHandle(maps.vertices[v.idx()]);
            CHECK(mesh.find_edge(ends[0], ends[1]).idx() == maps.edges[e.idx()]);
        }
        for (auto f : before.faces()) {
            auto v = before.face_vertices(f);
            for (auto& corner : v) corner = VertexHandle(maps.vertices[corner.idx()]);
            CHECK(mesh.find_face(v[0], v[1], v[2]).idx() == maps.faces[f.idx()]);
        }
        for (auto c : before.cells())
            CHECK(mesh.cell_points(CellHandle(maps.cells[c.idx()])) == before.cell_points(c));
        for (std::uint32_t c = 0; c < before.n_cells(); ++c)
            CHECK((maps.cells[c] == TetMesh::none) == before.is_deleted(CellHandle(c)));
    }
    // A mesh whose numbers are at random: the mean step to a neighbour becomes many times shorter.
    TetMesh mesh = test::kuhn_cube(10);
    std::mt19937 random(3);
    std::vector<VertexHandle> vertices(mesh.vertices().begin(), mesh.vertices().end());
    std::vector<CellHandle> cells(mesh.cells().begin(), mesh.cells().end());
    std::ranges::shuffle(vertices, random);
    std::ranges::shuffle(cells, random);
    mesh = mesh.taken(vertices, cells);
    const auto mean_step = [](const TetMesh& m) {
        double sum = 0;
        for (auto c : m.cells())
            for (auto other : c.neighbors()) sum += std::abs(double(c.idx()) - other.idx());
        return sum / (4.0 * m.n_cells());
    };
    const double at_random = mean_step(mesh);
    renumber(mesh);
    CHECK(mean_step(mesh) < at_random / 8);
    const TetMesh once = mesh;
    renumber(mesh);
    CHECK(std::ranges::equal(once.cell_vertex_indices(), mesh.cell_vertex_indices()));
}
