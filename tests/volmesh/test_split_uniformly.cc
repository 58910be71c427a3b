#include <algorithm>
#include <map>
#include <numeric>
#include <random>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include "tests/support/kuhn.hh"
#include "volmesh/measure.hh"
#include "volmesh/octasection.hh"
#include "volmesh/validate.hh"

using namespace maille;
using namespace maille::volmesh;

namespace {

void check_valid(const TetMesh& mesh) {
    const Validation validation = validate(mesh);
    CHECK_MESSAGE(validation.ok(), (validation.ok() ? "" : validation.errors.front()));
}

/// Two cubes that touch along an edge, a third that touches the first in a vertex.
TetMesh pinched_cubes() {
    const TetMesh cube = test::kuhn_cube(1);
    std::vector<Point> points;
    std::vector<std::array<std::uint32_t, 4>> cells;
    for (const Point& offset : {Point(0, 0, 0), Point(1, 1, 0), Point(-1, -1, -1)}) {
        std::vector<std::uint32_t> image;
        for (const Point& p : cube.points()) {
            const auto known = std::ranges::find(points, p + offset);
            image.push_back(static_cast<std::uint32_t>(known - points.begin()));
            if (known == points.end()) points.push_back(p + offset);
        }
        for (const auto& cell : cube.cell_vertex_indices())
            cells.push_back({image[cell[0]], image[cell[1]], image[cell[2]], image[cell[3]]});
    }
    return TetMesh::from_cells(points, cells);
}

/// A mesh whose points were moved about by up to a tenth of a cube.
TetMesh shaken_cube(int n, std::mt19937& random) {
    TetMesh mesh = test::kuhn_cube(n);
    std::uniform_real_distribution<double> step(-0.1 / n, 0.1 / n);
    for (const VertexHandle v : mesh.vertices())
        mesh.set_point(v, mesh.point(v) + Point(step(random), step(random), step(random)));
    return mesh;
}

double total_volume(const TetMesh& mesh, std::span<const CellHandle> cells) {
    double sum = 0;
    for (const CellHandle c : cells) sum += volume(mesh, c);
    return sum;
}

double total_area(const TetMesh& mesh, SetHandle set) {
    double sum = 0;
    for (const HalffaceHandle hf : mesh.face_members(set)) sum += area(mesh, hf);
    return sum;
}

double total_length(const TetMesh& mesh, SetHandle set) {
    double sum = 0;
    for (const auto& [c, e] : mesh.edge_members(set)) {
        const auto [i, j] = tet::edge_vertices[e];
        sum += (mesh.point(mesh.cell_vertex(c, i)) - mesh.point(mesh.cell_vertex(c, j))).norm();
    }
    return sum;
}

}  // namespace

TEST_CASE("a cut into eight is one: 24 sides lie on the parent's faces, the rest in pairs inside") {
    for (const tet::Octasection& cut : tet::octasections) {
        std::array<int, 4> n_on_face{};
        for (int child = 0; child < 8; ++child)
            for (int f = 0; f < 4; ++f) {
                if (const int face = cut.outer[child][f]; face != tet::Octasection::no_face) {
                    ++n_on_face[face];
                    continue;
                }
                const int other = cut.inner[child][f];
                CHECK(other / 4 != child);
                CHECK(cut.inner[other / 4][other % 4] == 4 * child + f);
            }
        for (int face = 0; face < 4; ++face) {
            CHECK(n_on_face[face] == 4);
            CHECK(cut.outer[cut.middle[face] / 4][cut.middle[face] % 4] == face);
        }
    }
}

TEST_CASE("every cell is cut into eight of its volume, and the mesh stays right") {
    std::mt19937 random(7);
    for (TetMesh mesh : {test::kuhn_cube(3), shaken_cube(3, random), pinched_cubes()}) {
        const TetMesh before = mesh;
        std::uint32_t n_edges = TetMesh(before).n_edges();
        const auto ends = mesh.split_uniformly();
        CHECK_FALSE(mesh.has_edges());
        CHECK(mesh.n_cells() == 8 * before.n_cells());
        CHECK(mesh.n_vertices() == before.n_vertices() + n_edges);
        CHECK(mesh.n_boundary_faces() == 4 * before.n_boundary_faces());
        check_valid(mesh);
        for (const CellHandle c : before.cells())
            for (std::uint32_t child = 0; child < 8; ++child)
                CHECK(volume(mesh, CellHandle(8 * c.idx() + child)) ==
                      doctest::Approx(volume(before, c) / 8).epsilon(1e-12));
        for (std::uint32_t i = 0; i < ends.size(); ++i)
            CHECK(mesh.point(VertexHandle(before.n_vertices() + i)) ==
                  0.5 * before.point(ends[i][0]) + 0.5 * before.point(ends[i][1]));
    }
}

TEST_CASE("cut again and again, a cube's shapes come back: no cell gets worse") {
    TetMesh mesh = test::kuhn_cube(1);
    const std::array first{1.0, 1.0, 1.0, std::sqrt(2.0), std::sqrt(2.0), std::sqrt(3.0)};
    for (int level = 1; level <= 3; ++level) {
        mesh.split_uniformly();
        for (const CellHandle c : mesh.cells()) {
            const auto p = mesh.cell_points(c);
            std::vector<double> lengths;
            for (const auto& [i, j] : tet::edge_vertices) lengths.push_back((p[i] - p[j]).norm());
            std::ranges::sort(lengths);
            for (int e = 0; e < 6; ++e) CHECK(lengths[e] == doctest::Approx(first[e] / (1 << level)));
        }
    }
    CHECK(mesh.n_cells() == 6 * 512);
    check_valid(mesh);
}

TEST_CASE("sets keep their volume, area and length, and vertices are born into them by their rules") {
    for (const unsigned seed : {1U, 2U, 3U}) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        TetMesh mesh = shaken_cube(3, random);
        const SetHandle part = mesh.add_set("part", EntityKind::cell);
        const SetHandle skin = mesh.add_set("skin", EntityKind::face);
        const SetHandle line = mesh.add_set("line", EntityKind::edge);
        const SetHandle gone = mesh.add_set("gone", EntityKind::face, SetRule::none());
        const SetHandle ends = mesh.add_set("ends", EntityKind::vertex, SetRule::both_ends());
        const SetHandle on_skin = mesh.add_set("on skin", EntityKind::vertex, SetRule::from_faces(skin));
        const SetHandle on_line = mesh.add_set("on line", EntityKind::vertex, SetRule::from_edges(line));
        for (const CellHandle c : mesh.cells()) {
            if (random() % 3 == 0) mesh.insert(part, c);
            if (random() % 3 == 0) mesh.insert(skin, TetMesh::halfface(c, static_cast<int>(random() % 4)));
            if (random() % 3 == 0) mesh.insert(gone, TetMesh::halfface(c, static_cast<int>(random() % 4)));
            if (random() % 3 == 0) mesh.insert(line, c, static_cast<int>(random() % 6));
        }
        for (const VertexHandle v : mesh.vertices())
            if (random() % 2 == 0) mesh.insert(ends, v);
        const TetMesh before = mesh;
        const auto parents = mesh.split_uniformly();
        check_valid(mesh);
        CHECK(total_volume(mesh, mesh.cell_members(part)) ==
              doctest::Approx(total_volume(before, before.cell_members(part))));
        CHECK(mesh.cell_members(part).size() == 8 * before.cell_members(part).size());
        CHECK(total_area(mesh, skin) == doctest::Approx(total_area(before, skin)));
        CHECK(mesh.face_members(skin).size() == 4 * before.face_members(skin).size());
        CHECK(total_length(mesh, line) == doctest::Approx(total_length(before, line)));
        CHECK(mesh.edge_members(line).size() == 2 * before.edge_members(line).size());
        CHECK(mesh.face_members(gone).empty());
        for (std::uint32_t i = 0; i < parents.size(); ++i) {
            const VertexHandle m(before.n_vertices() + i);
            const auto [a, b] = parents[i];
            CHECK(mesh.contains(ends, m) == (before.contains(ends, a) && before.contains(ends, b)));
            bool is_on_skin = false, is_on_line = false;
            for (const CellHandle c : before.cells_around(a, b)) {
                const int e = before.local_edge(c, a, b);
                is_on_line |= before.contains(line, c, e);
                for (int f : tet::edge_vertices[tet::opposite_edge(e)])
                    is_on_skin |= before.contains(skin, TetMesh::halfface(c, f));
            }
            CHECK(mesh.contains(on_skin, m) == is_on_skin);
            CHECK(mesh.contains(on_line, m) == is_on_line);
        }
    }
}

TEST_CASE("properties pass on: linear ones exactly, extensive ones in equal parts, others as they are") {
    std::mt19937 random(5);
    TetMesh mesh = shaken_cube(2, random);
    VPropHandleT<double> height;
    EPropHandleT<double> load;
    FPropHandleT<double> flux;
    CPropHandleT<double> mass;
    CPropHandleT<int> region;
    FPropHandleT<int> side;
    mesh.add_property(height, "height", {PropertyRule::interpolate});
    mesh.add_property(load, "load", {PropertyRule::share});
    mesh.add_property(flux, "flux", {PropertyRule::share});
    mesh.add_property(mass, "mass", {PropertyRule::share});
    mesh.add_property(region, "region");
    mesh.add_property(side, "side", {}, -1);
    const auto linear = [](const Point& p) { return 3 * p.x() - 2 * p.y() + p.z(); };
    for (const VertexHandle v : mesh.vertices()) mesh.property(height, v) = linear(mesh.point(v));
    for (const EdgeHandle e : mesh.edges()) mesh.property(load, e) = 1 + e.idx();
    for (const FaceHandle f : mesh.faces()) {
        mesh.property(flux, f) = 1 + f.idx();
        mesh.property(side, f) = static_cast<int>(f.idx());
    }
    for (const CellHandle c : mesh.cells()) {
        mesh.property(mass, c) = 1 + c.idx();
        mesh.property(region, c) = static_cast<int>(c.idx());
    }
    const TetMesh before = mesh;
    mesh.split_uniformly();
    check_valid(mesh);
    for (const VertexHandle v : mesh.vertices())
        CHECK(mesh.property(height, v) == doctest::Approx(linear(mesh.point(v))));
    for (const CellHandle c : mesh.cells()) {
        CHECK(mesh.property(region, c) == static_cast<int>(c.idx() / 8));
        CHECK(mesh.property(mass, c) == (1.0 + c.idx() / 8) / 8);
    }
    // A half of an edge lies on it, and has half of what it had.
    double sum = 0;
    std::size_t n_halves = 0;
    for (const EdgeHandle e : mesh.edges()) {
        const double value = mesh.property(load, e);
        sum += value;
        if (value == 0) continue;
        ++n_halves;
        const EdgeHandle parent(static_cast<std::uint32_t>(2 * value) - 1);
        const auto [a, b] = before.edge_vertices(parent);
        const auto [old, middle] = mesh.edge_vertices(e);
        CHECK((old == a || old == b));
        CHECK(mesh.point(middle) == 0.5 * before.point(a) + 0.5 * before.point(b));
    }
    const double n_edges = before.n_edges(), n_faces = before.n_faces();
    CHECK(n_halves == 2 * before.n_edges());
    CHECK(sum == n_edges * (n_edges + 1) / 2);
    std::map<int, double> area_of;
    double flow = 0;
    for (const FaceHandle f : mesh.faces()) {
        flow += mesh.property(flux, f);
        area_of[mesh.property(side, f)] += area(mesh, mesh.halfface_handle(f, 0));
        if (mesh.property(side, f) >= 0) CHECK(mesh.property(flux, f) == (1.0 + mesh.property(side, f)) / 4);
    }
    CHECK(flow == n_faces * (n_faces + 1) / 2);
    for (const FaceHandle f : before.faces())
        CHECK(area_of[static_cast<int>(f.idx())] ==
              doctest::Approx(area(before, before.halfface_handle(f, 0))));
}

TEST_CASE("custom rules choose among the children") {
    TetMesh mesh = test::kuhn_cube(2);
    const auto is_low = [](const TetMesh& m, std::span<const VertexHandle> entity, VertexHandle a,
                           VertexHandle b, VertexHandle middle) {
        CHECK(m.point(middle) == 0.5 * m.point(a) + 0.5 * m.point(b));
        CHECK(std::ranges::find(entity, middle) != entity.end());
        return std::ranges::all_of(entity, [&](VertexHandle v) { return m.point(v).z() <= 0.25; });
    };
    const SetHandle cells = mesh.add_set("cells", EntityKind::cell, SetRule::custom(is_low));
    const SetHandle faces = mesh.add_set("faces", EntityKind::face, SetRule::custom(is_low));
    const SetHandle edges = mesh.add_set("edges", EntityKind::edge, SetRule::custom(is_low));
    const SetHandle vertices = mesh.add_set("vertices", EntityKind::vertex, SetRule::custom(is_low));
    for (const CellHandle c : mesh.cells()) {
        mesh.insert(cells, c);
        for (int f = 0; f < 4; ++f) mesh.insert(faces, TetMesh::halfface(c, f));
        for (int e = 0; e < 6; ++e) mesh.insert(edges, c, e);
    }
    mesh.split_uniformly();
    check_valid(mesh);
    // The lowest quarter of the cube's height: 4 x 4 x 1 of the 4 x 4 x 4 little cubes.
    CHECK(total_volume(mesh, mesh.cell_members(cells)) == doctest::Approx(0.25));
    CHECK(!mesh.face_members(faces).empty());
    CHECK(!mesh.edge_members(edges).empty());
    for (const HalffaceHandle hf : mesh.face_members(faces))
        for (const VertexHandle v : mesh.halfface_vertices(hf)) CHECK(mesh.point(v).z() <= 0.25);
    for (const VertexHandle v : mesh.vertices())
        if (v.idx() >= 27) CHECK(mesh.contains(vertices, v) == (mesh.point(v).z() <= 0.25));
}

TEST_CASE("the number of threads makes no difference") {
    const auto refined = [](int threads) {
        std::mt19937 random(3);
        TetMesh mesh = shaken_cube(6, random);
        const SetHandle skin = mesh.add_set("skin", EntityKind::face);
        for (const HalffaceHandle hf : mesh.boundary_halffaces()) mesh.insert(skin, hf);
        tbb::task_arena(threads).execute([&] {
            mesh.split_uniformly();
            mesh.split_uniformly();
        });
        return mesh;
    };
    const TetMesh one = refined(1), four = refined(4);
    CHECK(std::ranges::equal(one.cell_vertex_indices(), four.cell_vertex_indices()));
    CHECK(std::ranges::equal(one.points(), four.points()));
    for (std::uint32_t i = 0; i < one.n_halffaces(); ++i)
        REQUIRE(one.opposite_halfface_handle(HalffaceHandle(i)) ==
                four.opposite_halfface_handle(HalffaceHandle(i)));
    CHECK(one.face_members(SetHandle(0)) == four.face_members(SetHandle(0)));
}

TEST_CASE("a mesh with deleted cells is refused") {
    TetMesh mesh = test::kuhn_cube(1);
    mesh.delete_cell(CellHandle(0));
    CHECK_THROWS_WITH(mesh.split_uniformly(),
                      "the mesh has deleted entities: collect them (garbage_collection) first");
}
