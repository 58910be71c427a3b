#include <algorithm>
#include <functional>
#include <map>
#include <random>

#include <doctest/doctest.h>

#include "tests/support/kuhn.hh"
#include "volmesh/collapse.hh"
#include "volmesh/edge_removal.hh"
#include "volmesh/face_removal.hh"
#include "volmesh/measure.hh"
#include "volmesh/split_inside.hh"
#include "volmesh/strata.hh"
#include "volmesh/validate.hh"

using namespace maille::volmesh;
using maille::test::kuhn_cube;

namespace {

constexpr double tolerance = 1e-12;

bool is_valid(const TetMesh& mesh) {
    const Validation found = validate(mesh);
    for (const std::string& error : found.errors) MESSAGE(error);
    return found.ok();
}

bool near(double a, double b) {
    return std::abs(a - b) < 1e-9;
}

bool all_at(const TetMesh& mesh, std::span<const VertexHandle> vertices,
            const std::function<bool(const Point&)>& is_there) {
    return std::ranges::all_of(vertices, [&](VertexHandle v) { return is_there(mesh.point(v)); });
}

/// Sets of the unit cube that geometry alone can tell, and extensive quantities on all kinds.
struct Scene {
    TetMesh mesh = kuhn_cube(4);
    VertexHandle loaded{62};
    SetHandle left, top, middle, axis, load;
    CPropHandleT<double> mass;
    FPropHandleT<double> force;
    EPropHandleT<double> wire;
    CPropHandleT<int> color;
    FPropHandleT<int> mark;
    VPropHandleT<Point> place;

    explicit Scene(bool is_numbered) {
        left = mesh.add_set("left", EntityKind::cell);
        top = mesh.add_set("top", EntityKind::face);
        middle = mesh.add_set("middle", EntityKind::face);
        axis = mesh.add_set("axis", EntityKind::edge);
        load = mesh.add_set("load", EntityKind::vertex);
        mesh.insert(load, loaded);
        for (CellHandle c : mesh.cells()) {
            if (is_left(c)) mesh.insert(left, c);
            for (int e = 0; e < 6; ++e)
                if (is_on_axis(c, e)) mesh.insert(axis, c, e);
        }
        for (HalffaceHandle hf : mesh.halffaces()) {
            if (is_on_top(hf)) mesh.insert(top, hf);
            if (is_in_middle(hf)) mesh.insert(middle, hf);
        }
        mesh.add_property(mass, "mass", {PropertyRule::share}, 0.0);
        mesh.add_property(color, "color", {PropertyRule::copy}, -1);
        for (CellHandle c : mesh.cells()) {
            mesh.property(mass, c) = volume(mesh, c) * (is_left(c) ? 1 : 5);
            mesh.property(color, c) = is_left(c) ? 1 : 2;
        }
        mesh.add_property(place, "place", {PropertyRule::interpolate}, Point(0, 0, 0));
        for (VertexHandle v : mesh.vertices()) mesh.property(place, v) = mesh.point(v);
        if (!is_numbered) return;
        mesh.add_property(force, "force", {PropertyRule::share}, 0.0);
        mesh.add_property(mark, "mark", {PropertyRule::copy}, 0);
        mesh.add_property(wire, "wire", {PropertyRule::share}, 0.0);
        for (FaceHandle f : mesh.faces()) {
            const HalffaceHandle hf = mesh.halfface_handle(f, 0);
            mesh.property(force, f) = is_on_top(hf) ? area(mesh, hf) : is_in_middle(hf) ? 100 : 0;
            mesh.property(mark, f) = is_on_top(hf) ? 7 : 0;
        }
        for (EdgeHandle e : mesh.edges()) mesh.property(wire, e) = 1;
    }

    bool is_left(CellHandle c) const {
        const auto p = mesh.cell_points(c);
        return p[0].x() + p[1].x() + p[2].x() + p[3].x() < 2;
    }
    bool is_on_top(HalffaceHandle hf) const {
        return all_at(mesh, mesh.halfface_vertices(hf), [](const Point& p) { return near(p.z(), 1); });
    }
    bool is_in_middle(HalffaceHandle hf) const {
        return all_at(mesh, mesh.halfface_vertices(hf), [](const Point& p) { return near(p.x(), .5); });
    }
    bool is_on_axis(CellHandle c, int e) const {
        const auto [i, j] = tet::edge_vertices[e];
        return all_at(mesh, std::array{mesh.cell_vertex(c, i), mesh.cell_vertex(c, j)},
                      [](const Point& p) { return near(p.x(), .5) && near(p.y(), .5); });
    }

    template <class H>
    double sum(const auto& range, PropertyHandle<H, double> values) const {
        double total = 0;
        for (auto h : range) total += mesh.property(values, static_cast<H>(h));
        return total;
    }

    void check() const {
        CHECK(volume(mesh) == doctest::Approx(1).epsilon(1e-12));
        CHECK(boundary_area(mesh) == doctest::Approx(6).epsilon(1e-12));
        for (CellHandle c : mesh.cells()) {
            CHECK(mesh.contains(left, c) == is_left(c));
            CHECK(mesh.property(color, c) == (is_left(c) ? 1 : 2));
            for (int e = 0; e < 6; ++e) CHECK(mesh.contains(axis, c, e) == is_on_axis(c, e));
        }
        for (HalffaceHandle hf : mesh.halffaces()) {
            CHECK(mesh.contains(top, hf) == is_on_top(hf));
            CHECK(mesh.contains(middle, hf) == is_in_middle(hf));
        }
        CHECK(measure(mesh, left) == doctest::Approx(.5).epsilon(1e-12));
        CHECK(measure(mesh, top) == doctest::Approx(1).epsilon(1e-12));
        CHECK(measure(mesh, middle) == doctest::Approx(1).epsilon(1e-12));
        CHECK(measure(mesh, axis) == doctest::Approx(1).epsilon(1e-12));
        CHECK(mesh.vertex_members(load) == std::vector{loaded});
        for (VertexHandle v : mesh.vertices())
            CHECK((mesh.property(place, v) - mesh.point(v)).norm() < 1e-12);
        double left_mass = 0;
        for (CellHandle c : mesh.cells())
            if (is_left(c)) left_mass += mesh.property(mass, c);
        CHECK(left_mass == doctest::Approx(.5).epsilon(1e-12));
        CHECK(sum(mesh.cells(), mass) == doctest::Approx(3).epsilon(1e-12));
        if (force.is_valid()) {
            double on_top = 0;
            for (FaceHandle f : mesh.faces()) {
                if (is_on_top(mesh.halfface_handle(f, 0))) {
                    on_top += mesh.property(force, f);
                    CHECK(mesh.property(mark, f) == 7);
                }
            }
            CHECK(on_top == doctest::Approx(1).epsilon(1e-12));
            CHECK(sum(mesh.faces(), force) == doctest::Approx(1 + 100 * 32).epsilon(1e-12));
        }
    }
};

/// Triangles that fan out from one ring vertex.
std::vector<RingTriangle> fan(std::size_t n, std::uint32_t centre) {
    std::vector<RingTriangle> triangles;
    const auto size = static_cast<std::uint32_t>(n);
    for (std::uint32_t i = 1; i + 1 < size; ++i) {
        RingTriangle t{centre, (centre + i) % size, (centre + i + 1) % size};
        std::ranges::sort(t);
        triangles.push_back(t);
    }
    return triangles;
}

/// Moves a vertex inside a region a little, where its cells stay positive.
void move_at_random(Scene& scene, std::mt19937& random) {
    TetMesh& mesh = scene.mesh;
    const VertexHandle v(static_cast<std::uint32_t>(random() % mesh.n_vertices()));
    if (mesh.is_deleted(v) || stratum(mesh, v) != 3) return;
    const Point before = mesh.point(v);
    std::uniform_real_distribution<double> shift(-0.05, 0.05);
    mesh.set_point(v, before + Point(shift(random), shift(random), shift(random)));
    const auto is_good = [&](CellHandle c) { return volume(mesh, c) > 1e-6; };
    if (!std::ranges::all_of(mesh.vc_range(v), is_good)) mesh.set_point(v, before);
    mesh.property(scene.place, v) = mesh.point(v);
}

enum class Edit { split_edge, split_face, split_cell, flip_23, flip_32, flip_44, remove_edge, collapse };

/// One edit at random, if it is ok; what was done.
std::optional<Edit> edit_at_random(TetMesh& mesh, std::mt19937& random) {
    CellHandle c;
    do c = CellHandle(static_cast<std::uint32_t>(random() % mesh.n_cells()));
    while (mesh.is_deleted(c));
    const int e = static_cast<int>(random() % 6);
    const HalffaceHandle hf = TetMesh::halfface(c, static_cast<int>(random() % 4));
    const auto done = [](Edit edit) { return std::optional(edit); };
    const auto kind = static_cast<Edit>(random() % 12);
    switch (kind) {
        case Edit::split_edge:
            if (random() % 2 == 0) return std::nullopt;
            mesh.split_edge(c, e, (1 + static_cast<double>(random() % 3)) / 4);
            return done(kind);
        case Edit::split_face:
            if (random() % 4 != 0 || !is_split_face_ok(mesh, hf)) return std::nullopt;
            split_face(mesh, hf);
            return done(kind);
        case Edit::split_cell:
            if (random() % 4 != 0 || !is_split_cell_ok(mesh, c)) return std::nullopt;
            split_cell(mesh, c);
            return done(kind);
        case Edit::flip_23:
            if (!is_flip_23_ok(mesh, hf)) return std::nullopt;
            flip_23(mesh, hf);
            return done(kind);
        case Edit::flip_32:
            if (!is_flip_32_ok(mesh, c, e)) return std::nullopt;
            flip_32(mesh, c, e);
            return done(kind);
        case Edit::flip_44: {
            const auto diagonal = random() % 2 == 0 ? Diagonal::first : Diagonal::second;
            if (!is_flip_44_ok(mesh, c, e, diagonal, tolerance)) return std::nullopt;
            flip_44(mesh, c, e, diagonal);
            return done(kind);
        }
        case Edit::remove_edge: {
            const auto ring = edge_ring(mesh, c, e);
            REQUIRE(ring);
            const auto triangles = fan(ring->size(), static_cast<std::uint32_t>(random() % ring->size()));
            if (!is_edge_removal_ok(mesh, *ring, triangles, tolerance)) return std::nullopt;
            remove_edge(mesh, *ring, triangles);
            return done(kind);
        }
        default: {
            if (random() % 4 != 0) return std::nullopt;
            const auto [i, j] = tet::edge_vertices[e];
            if (!is_collapse_ok(mesh, mesh.cell_vertex(c, i), mesh.cell_vertex(c, j), tolerance))
                return std::nullopt;
            collapse_edge(mesh, mesh.cell_vertex(c, i), mesh.cell_vertex(c, j));
            return done(Edit::collapse);
        }
    }
}

}  // namespace

TEST_CASE("random local edits keep the mesh valid, its sets in their place and quantities conserved") {
    std::map<Edit, int> n_done;
    for (unsigned seed = 1; seed <= 8; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        Scene scene(seed % 2 == 0);
        for (int step = 1; step <= 1500; ++step) {
            CAPTURE(step);
            move_at_random(scene, random);
            const auto edit = edit_at_random(scene.mesh, random);
            if (edit) ++n_done[*edit];
            if (step % 50 != 0) continue;
            REQUIRE(is_valid(scene.mesh));
            scene.check();
            if (step % 500 == 0) {
                const IndexMaps maps = scene.mesh.garbage_collection();
                scene.loaded = VertexHandle(maps.vertices[scene.loaded.idx()]);
                REQUIRE(is_valid(scene.mesh));
                scene.check();
            }
        }
    }
    CHECK(n_done.size() == 8);
    for (const auto& [edit, n] : n_done) {
        MESSAGE("edit " << static_cast<int>(edit) << ": " << n << " times");
        CHECK(n >= 10);
    }
}

namespace {

/// n cells round the edge 0-1, upright in the middle of a regular polygon.
TetMesh wheel(std::uint32_t n) {
    std::vector<Point> points{{0, 0, -1}, {0, 0, 1}};
    std::vector<std::array<TetMesh::Index, 4>> cells;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double angle = 2 * M_PI * i / n;
        points.emplace_back(std::cos(angle), std::sin(angle), 0);
        cells.push_back({0, 1, 2 + i, 2 + (i + 1) % n});
    }
    return TetMesh::from_cells(points, cells);
}

}  // namespace

TEST_CASE("an edge's removal and its faces' removal undo each other") {
    for (std::uint32_t n = 3; n <= 7; ++n) {
        CAPTURE(n);
        TetMesh mesh = wheel(n);
        const double whole = volume(mesh);
        const auto ring = edge_ring(mesh, CellHandle(0), 0);
        REQUIRE(ring);
        CHECK(ring->is_closed);
        REQUIRE(ring->size() == n);
        const auto triangles = fan(n, 1);
        REQUIRE(is_edge_removal_ok(mesh, *ring, triangles));
        remove_edge(mesh, *ring, triangles);
        mesh.garbage_collection();
        CHECK(is_valid(mesh));
        CHECK(mesh.n_cells() == 2 * (n - 2));
        CHECK(mesh.cells_around(VertexHandle(0), VertexHandle(1)).empty());
        CHECK(volume(mesh) == doctest::Approx(whole).epsilon(1e-14));

        std::vector<HalffaceHandle> faces;
        for (HalffaceHandle hf : mesh.halffaces())
            if (!mesh.is_boundary(hf) &&
                mesh.cell_vertex(TetMesh::incident_cell(hf), TetMesh::local_face(hf)) == VertexHandle(0))
                faces.push_back(hf);
        REQUIRE(faces.size() == n - 2);
        REQUIRE(is_face_removal_ok(mesh, faces));
        remove_faces(mesh, faces);
        mesh.garbage_collection();
        CHECK(is_valid(mesh));
        CHECK(mesh.n_cells() == n);
        CHECK(mesh.cells_around(VertexHandle(0), VertexHandle(1)).size() == n);
        CHECK(volume(mesh) == doctest::Approx(whole).epsilon(1e-14));
    }
}

TEST_CASE("edits that would change sets, interfaces or the solid are refused") {
    const auto triangles = fan(5, 0);
    {
        TetMesh mesh = wheel(5);
        mesh.insert(mesh.add_set("wire", EntityKind::edge), CellHandle(0), 0);
        CHECK_FALSE(is_edge_removal_ok(mesh, *edge_ring(mesh, CellHandle(0), 0), triangles));
    }
    {
        TetMesh mesh = wheel(5);
        mesh.insert(mesh.add_set("one", EntityKind::cell), CellHandle(0));
        CHECK_FALSE(is_edge_removal_ok(mesh, *edge_ring(mesh, CellHandle(0), 0), triangles));
    }
    {
        TetMesh mesh = wheel(5);
        const auto ring = *edge_ring(mesh, CellHandle(0), 0);
        CHECK_FALSE(is_edge_removal_ok(mesh, ring, fan(4, 0)));
        CHECK_FALSE(
            is_edge_removal_ok(mesh, ring, std::vector<RingTriangle>{{0, 1, 2}, {0, 1, 3}, {0, 3, 4}}));
        mesh.set_point(VertexHandle(3), {0, -2, 0});
        CHECK_FALSE(is_edge_removal_ok(mesh, ring, triangles));
    }
    {
        TetMesh mesh = wheel(3);
        flip_32(mesh, CellHandle(0), 0);
        mesh.garbage_collection();
        REQUIRE(mesh.n_cells() == 2);
        const HalffaceHandle inner =
            mesh.is_boundary(TetMesh::halfface(CellHandle(0), 0))
                ? mesh.find_halfface(VertexHandle(2), VertexHandle(3), VertexHandle(4))
                : TetMesh::halfface(CellHandle(0), 0);
        REQUIRE_FALSE(mesh.is_boundary(inner));
        CHECK(is_flip_23_ok(mesh, inner));
        mesh.insert(mesh.add_set("crack", EntityKind::face), inner);
        CHECK_FALSE(is_flip_23_ok(mesh, inner));
    }
    {
        // The corners of a cube stay, whatever the sets; its boundary vertices don't go inside.
        TetMesh mesh = kuhn_cube(2);
        const VertexHandle corner(0), centre(13), side(12);
        CHECK(stratum(mesh, centre) == 3);
        CHECK(stratum(mesh, side) == 2);
        CHECK_FALSE(is_collapse_ok(mesh, corner, centre));
        CHECK_FALSE(is_collapse_ok(mesh, side, centre));
        for (CellHandle c : mesh.vc_range(corner))
            for (VertexHandle v : mesh.cell_vertices(c))
                if (v != corner) CHECK_FALSE(is_collapse_ok(mesh, corner, v, 1e-9));
        CHECK(is_collapse_ok(mesh, centre, corner));
        mesh.insert(mesh.add_set("load", EntityKind::vertex), centre);
        CHECK_FALSE(is_collapse_ok(mesh, centre, corner));
    }
}

TEST_CASE("edits next to where a boundary is pinched keep its fans") {
    // Two cubes that touch along an edge.
    const TetMesh cube = kuhn_cube(2);
    std::vector<Point> points(cube.points().begin(), cube.points().end());
    const auto cube_cells = cube.cell_vertex_indices();
    std::vector<std::array<TetMesh::Index, 4>> cells(cube_cells.begin(), cube_cells.end());
    const auto n = static_cast<std::uint32_t>(cells.size());
    std::vector<std::uint32_t> image;
    for (const Point& p : cube.points()) {
        const Point moved = p + Point(1, 1, 0);
        const auto same = std::ranges::find(points, moved);
        image.push_back(static_cast<std::uint32_t>(same - points.begin()));
        if (same == points.end()) points.push_back(moved);
    }
    for (std::uint32_t c = 0; c < n; ++c) {
        auto cell = cells[c];
        for (auto& v : cell) v = image[v];
        cells.push_back(cell);
    }
    TetMesh mesh = TetMesh::from_cells(points, cells);
    REQUIRE(is_valid(mesh));
    constexpr unsigned seed = 5;
    CAPTURE(seed);
    std::mt19937 random(seed);
    int n_done = 0;
    for (int step = 0; step < 2000; ++step) {
        n_done += edit_at_random(mesh, random).has_value();
        if (step % 20 == 0) REQUIRE(is_valid(mesh));
        CHECK(volume(mesh) == doctest::Approx(2).epsilon(1e-12));
    }
    CHECK(n_done > 200);
}
