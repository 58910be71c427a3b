#include <algorithm>
#include <functional>
#include <random>

#include <doctest/doctest.h>

#include "tests/support/kuhn.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

using namespace maille;
using namespace maille::volmesh;

namespace {

void split_at_random(TetMesh& mesh, int n, std::mt19937& random) {
    for (int i = 0; i < n; ++i) {
        const CellHandle c(static_cast<std::uint32_t>(random() % mesh.n_cells()));
        mesh.split_edge(c, static_cast<int>(random() % 6));
    }
}

bool is_valid(const TetMesh& mesh) {
    const Validation found = validate(mesh);
    for (const std::string& error : found.errors) MESSAGE(error);
    return found.ok();
}

Point centroid(const TetMesh& mesh, std::span<const VertexHandle> vertices) {
    Point sum = Point::Zero();
    for (VertexHandle v : vertices) sum += mesh.point(v);
    return sum / static_cast<double>(vertices.size());
}

constexpr double eps = 1e-9;
bool near(double a, double b) {
    return std::abs(a - b) < eps;
}

/// Sets of a Kuhn cube of even n that geometry alone can tell: every part of a member lies where members lie.
struct GeometricSets {
    SetHandle left_cells, top_faces, middle_faces, axis_edges;
    explicit GeometricSets(TetMesh& mesh)
        : left_cells(mesh.add_set("left", EntityKind::cell)),
          top_faces(mesh.add_set("top", EntityKind::face)),
          middle_faces(mesh.add_set("middle", EntityKind::face)),
          axis_edges(mesh.add_set("axis", EntityKind::edge)) {
        for (CellHandle c : mesh.cells())
            if (is_left(mesh, c)) mesh.insert(left_cells, c);
        for (HalffaceHandle hf : mesh.halffaces()) {
            if (is_top(mesh, hf)) mesh.insert(top_faces, hf);
            if (is_middle(mesh, hf)) mesh.insert(middle_faces, hf);
        }
        for (CellHandle c : mesh.cells())
            for (int e = 0; e < 6; ++e)
                if (is_axis(mesh, c, e)) mesh.insert(axis_edges, c, e);
    }
    static bool is_left(const TetMesh& mesh, CellHandle c) {
        return centroid(mesh, mesh.cell_vertices(c)).x() < .5;
    }
    static bool all(const TetMesh& mesh, std::span<const VertexHandle> vertices,
                    const std::function<bool(const Point&)>& is_there) {
        return std::ranges::all_of(vertices, [&](VertexHandle v) { return is_there(mesh.point(v)); });
    }
    static bool is_top(const TetMesh& mesh, HalffaceHandle hf) {
        return all(mesh, mesh.halfface_vertices(hf), [](const Point& p) { return near(p.z(), 1); });
    }
    static bool is_middle(const TetMesh& mesh, HalffaceHandle hf) {
        return all(mesh, mesh.halfface_vertices(hf), [](const Point& p) { return near(p.x(), .5); });
    }
    static bool is_axis(const TetMesh& mesh, CellHandle c, int e) {
        const auto [i, j] = tet::edge_vertices[e];
        const std::array ends{mesh.cell_vertex(c, i), mesh.cell_vertex(c, j)};
        return all(mesh, ends, [](const Point& p) { return near(p.x(), .5) && near(p.y(), .5); });
    }
    void check(const TetMesh& mesh) const {
        for (CellHandle c : mesh.cells()) {
            CHECK(mesh.contains(left_cells, c) == is_left(mesh, c));
            for (int e = 0; e < 6; ++e) CHECK(mesh.contains(axis_edges, c, e) == is_axis(mesh, c, e));
        }
        for (HalffaceHandle hf : mesh.halffaces()) {
            CHECK(mesh.contains(top_faces, hf) == is_top(mesh, hf));
            CHECK(mesh.contains(middle_faces, hf) == is_middle(mesh, hf));
        }
        CHECK(measure(mesh, left_cells) == doctest::Approx(.5).epsilon(1e-12));
        CHECK(measure(mesh, top_faces) == doctest::Approx(1).epsilon(1e-12));
        CHECK(measure(mesh, middle_faces) == doctest::Approx(1).epsilon(1e-12));
        CHECK(measure(mesh, axis_edges) == doctest::Approx(1).epsilon(1e-12));
    }
};

}  // namespace

TEST_CASE("Cell, face and edge sets pass to children, as geometry says") {
    for (unsigned seed : {21U, 22U}) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        TetMesh mesh = test::kuhn_cube(2);
        const GeometricSets sets(mesh);
        sets.check(mesh);
        split_at_random(mesh, 150, random);
        sets.check(mesh);
        CHECK(is_valid(mesh));
        // They also live through deletion and garbage collection.
        for (CellHandle c : mesh.cell_members(sets.left_cells))
            if (c.idx() % 3 == 0) mesh.delete_cell(c);
        mesh.garbage_collection();
        CHECK(is_valid(mesh));
        for (CellHandle c : mesh.cells())
            CHECK(mesh.contains(sets.left_cells, c) == GeometricSets::is_left(mesh, c));
        for (HalffaceHandle hf : mesh.halffaces())
            CHECK(mesh.contains(sets.top_faces, hf) == GeometricSets::is_top(mesh, hf));
    }
}

TEST_CASE("Each rule of a vertex set does what it says") {
    std::mt19937 random(31);
    TetMesh mesh = test::kuhn_cube(2);
    const GeometricSets sets(mesh);
    const auto on_top = mesh.add_set("on top", EntityKind::vertex, SetRule::from_faces(sets.top_faces));
    const auto on_axis = mesh.add_set("on axis", EntityKind::vertex, SetRule::from_edges(sets.axis_edges));
    const auto both = mesh.add_set("both", EntityKind::vertex, SetRule::both_ends(sets.middle_faces));
    const auto ends = mesh.add_set("ends", EntityKind::vertex, SetRule::both_ends());
    const auto load = mesh.add_set("load", EntityKind::vertex);
    const auto low =
        mesh.add_set("low", EntityKind::vertex,
                     SetRule::custom([](const TetMesh& m, std::span<const VertexHandle> entity, VertexHandle,
                                        VertexHandle, VertexHandle) { return m.point(entity[0]).z() < .5; }));
    const auto is_top = [&](VertexHandle v) { return near(mesh.point(v).z(), 1); };
    const auto is_axis = [&](VertexHandle v) {
        return near(mesh.point(v).x(), .5) && near(mesh.point(v).y(), .5);
    };
    const auto is_middle = [&](VertexHandle v) { return near(mesh.point(v).x(), .5); };
    for (VertexHandle v : mesh.vertices()) {
        if (is_top(v)) mesh.insert(on_top, v), mesh.insert(ends, v);
        if (is_axis(v)) mesh.insert(on_axis, v);
        if (is_middle(v)) mesh.insert(both, v);
        if (is_top(v)) mesh.insert(load, v);
        if (mesh.point(v).z() < .5) mesh.insert(low, v);
    }
    const std::size_t n_loads = mesh.set_size(load);
    split_at_random(mesh, 200, random);
    for (VertexHandle v : mesh.vertices()) {
        CHECK(mesh.contains(on_top, v) == is_top(v));
        CHECK(mesh.contains(ends, v) == is_top(v));  // a convex set: the middle of two members lies in it
        CHECK(mesh.contains(on_axis, v) == is_axis(v));
        CHECK(mesh.contains(both, v) == is_middle(v));
        CHECK(mesh.contains(low, v) == (mesh.point(v).z() < .5));
    }
    CHECK(mesh.set_size(load) == n_loads);
    CHECK(is_valid(mesh));
}

TEST_CASE("none and custom rules of cell, face and edge sets") {
    std::mt19937 random(41);
    TetMesh mesh = test::kuhn_cube(2);
    const auto whole = mesh.add_set("never split", EntityKind::cell, SetRule::none());
    const auto whole_faces = mesh.add_set("never split", EntityKind::face, SetRule::none());
    const SetRule lower =
        SetRule::custom([](const TetMesh& m, std::span<const VertexHandle> entity, VertexHandle, VertexHandle,
                           VertexHandle) { return centroid(m, entity).z() < .4; });
    const auto low_cells = mesh.add_set("low", EntityKind::cell, lower);
    const auto low_faces = mesh.add_set("low", EntityKind::face, lower);
    const auto low_edges = mesh.add_set("low", EntityKind::edge, lower);
    for (CellHandle c : mesh.cells()) {
        mesh.insert(whole, c);
        mesh.insert(low_cells, c);
        for (int e = 0; e < 6; ++e) mesh.insert(low_edges, c, e);
        for (int f = 0; f < 4; ++f) {
            mesh.insert(whole_faces, TetMesh::halfface(c, f));
            mesh.insert(low_faces, TetMesh::halfface(c, f));
        }
    }
    const TetMesh start = mesh;
    split_at_random(mesh, 60, random);
    CHECK(is_valid(mesh));
    const auto is_old_cell = [&](CellHandle c) {
        const auto v = mesh.cell_vertices(c);
        return std::ranges::all_of(v, [&](VertexHandle w) { return w.idx() < start.n_vertices(); });
    };
    for (CellHandle c : mesh.cells()) {
        CHECK(mesh.contains(whole, c) == is_old_cell(c));
        if (!is_old_cell(c) && mesh.contains(low_cells, c))
            CHECK(centroid(mesh, mesh.cell_vertices(c)).z() < .4);
        for (int f = 0; f < 4; ++f) {
            const auto v = mesh.halfface_vertices(TetMesh::halfface(c, f));
            const bool is_old =
                std::ranges::all_of(v, [&](VertexHandle w) { return w.idx() < start.n_vertices(); });
            CHECK(mesh.contains(whole_faces, TetMesh::halfface(c, f)) == is_old);
            if (!is_old && mesh.contains(low_faces, TetMesh::halfface(c, f)))
                CHECK(centroid(mesh, v).z() < .4);
        }
    }
    CHECK(mesh.set_size(low_edges) > 0);
}

TEST_CASE("Sets refuse what does not fit, and forget on erase") {
    TetMesh mesh = test::kuhn_cube(1);
    const auto cells = mesh.add_set("a", EntityKind::cell);
    const auto faces = mesh.add_set("a", EntityKind::face);
    CHECK(mesh.find_set("a", EntityKind::cell) == cells);
    CHECK(mesh.find_set("a", EntityKind::face) == faces);
    CHECK_FALSE(mesh.find_set("a", EntityKind::edge).is_valid());
    CHECK_THROWS_AS(mesh.add_set("a", EntityKind::cell), std::invalid_argument);
    CHECK_THROWS_AS(mesh.add_set("b", EntityKind::vertex, SetRule::copy()), std::invalid_argument);
    CHECK_THROWS_AS(mesh.add_set("b", EntityKind::cell, SetRule::both_ends()), std::invalid_argument);
    CHECK_THROWS_AS(mesh.add_set("b", EntityKind::vertex, SetRule::from_edges(faces)), std::invalid_argument);
    CHECK_THROWS_AS(mesh.add_set("b", EntityKind::vertex, SetRule::from_faces({})), std::invalid_argument);
    CHECK_THROWS_AS(mesh.insert(faces, CellHandle(0)), std::invalid_argument);

    mesh.insert(faces, HalffaceHandle(3));
    mesh.insert(faces, HalffaceHandle(3));
    CHECK(mesh.set_size(faces) == 1);
    mesh.erase(faces, HalffaceHandle(3));
    CHECK(mesh.set_size(faces) == 0);
    CHECK(mesh.combination(HalffaceHandle(3)) == 0);
    CHECK(is_valid(mesh));
}

TEST_CASE("Property rules: values pass on, and shared sums stay") {
    for (unsigned seed : {51U, 52U}) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        TetMesh mesh = test::kuhn_cube(2);
        VPropHandleT<double> linear;
        VPropHandleT<Point> place;
        VPropHandleT<int> born;
        CPropHandleT<double> mass;
        CPropHandleT<std::uint32_t> ancestor;
        CPropHandleT<bool> fresh;
        FPropHandleT<double> pressure;
        EPropHandleT<double> charge;
        CPropHandleT<double> first_part;
        mesh.add_property(linear, "linear", PropertyHeritage<double>(PropertyRule::interpolate));
        mesh.add_property(place, "place", PropertyHeritage<Point>(PropertyRule::interpolate), Point(0, 0, 0));
        mesh.add_property(born, "born", PropertyHeritage<int>(PropertyRule::none), 1);
        mesh.add_property(mass, "mass", PropertyHeritage<double>(PropertyRule::share));
        mesh.add_property(ancestor, "ancestor");
        mesh.add_property(fresh, "fresh", PropertyHeritage<bool>(PropertyRule::none), true);
        mesh.add_property(pressure, "load", PropertyHeritage<double>(PropertyRule::share));
        mesh.add_property(charge, "charge", PropertyHeritage<double>(PropertyRule::share));
        PropertyHeritage<double> custom;
        custom.at_children = [](const double& parent, double ratio) {
            return std::pair(parent * ratio, parent * (1 - ratio));
        };
        mesh.add_property(first_part, "custom", custom, 0.0);

        const auto field = [](const Point& p) { return 3 + p.x() - 2 * p.y() + .5 * p.z(); };
        for (VertexHandle v : mesh.vertices()) {
            mesh.property(linear, v) = field(mesh.point(v));
            mesh.property(place, v) = mesh.point(v);
            mesh.property(born, v) = 0;
        }
        for (CellHandle c : mesh.cells()) {
            mesh.property(mass, c) = 7 * volume(mesh, c);
            mesh.property(first_part, c) = 7 * volume(mesh, c);
            mesh.property(ancestor, c) = c.idx();
            mesh.property(fresh, c) = 0;
        }
        // On every face its area, on every edge its length; new ones inside others get 0.
        for (FaceHandle f : mesh.faces()) mesh.property(pressure, f) = area(mesh, mesh.halfface_handle(f, 0));
        const auto length = [&](EdgeHandle e) {
            const auto [a, b] = mesh.edge_vertices(e);
            return (mesh.point(a) - mesh.point(b)).norm();
        };
        for (EdgeHandle e : mesh.edges()) mesh.property(charge, e) = length(e);
        const TetMesh start = mesh;
        double total_pressure = 0;
        for (FaceHandle f : mesh.faces()) total_pressure += mesh.property(pressure, f);
        double total_charge = 0;
        for (EdgeHandle e : mesh.edges()) total_charge += mesh.property(charge, e);

        for (int i = 0; i < 150; ++i) {
            const CellHandle c(static_cast<std::uint32_t>(random() % mesh.n_cells()));
            mesh.split_edge(c, static_cast<int>(random() % 6), i % 2 == 0 ? .5 : .3);
        }
        CHECK(is_valid(mesh));
        for (VertexHandle v : mesh.vertices()) {
            CHECK(mesh.property(linear, v) == doctest::Approx(field(mesh.point(v))).epsilon(1e-13));
            CHECK((mesh.property(place, v) - mesh.point(v)).norm() < 1e-13);
            CHECK(mesh.property(born, v) == (v.idx() < start.n_vertices() ? 0 : 1));
        }
        std::vector<double> by_ancestor(start.n_cells(), 0);
        for (CellHandle c : mesh.cells()) {
            CHECK(mesh.property(mass, c) == doctest::Approx(7 * volume(mesh, c)).epsilon(1e-9));
            CHECK(mesh.property(first_part, c) == doctest::Approx(7 * volume(mesh, c)).epsilon(1e-9));
            by_ancestor[mesh.property(ancestor, c)] += volume(mesh, c);
        }
        for (CellHandle c : start.cells())
            CHECK(by_ancestor[c.idx()] == doctest::Approx(volume(start, c)).epsilon(1e-12));
        double new_pressure = 0;
        for (FaceHandle f : mesh.faces()) {
            new_pressure += mesh.property(pressure, f);
            if (mesh.property(pressure, f) != 0)
                CHECK(mesh.property(pressure, f) ==
                      doctest::Approx(area(mesh, mesh.halfface_handle(f, 0))).epsilon(1e-9));
        }
        CHECK(new_pressure == doctest::Approx(total_pressure).epsilon(1e-12));
        double new_charge = 0;
        for (EdgeHandle e : mesh.edges()) {
            new_charge += mesh.property(charge, e);
            if (mesh.property(charge, e) != 0)
                CHECK(mesh.property(charge, e) == doctest::Approx(length(e)).epsilon(1e-9));
        }
        CHECK(new_charge == doctest::Approx(total_charge).epsilon(1e-12));
    }
}

TEST_CASE("Properties refuse what does not fit") {
    TetMesh mesh = test::kuhn_cube(1);
    CPropHandleT<double> a;
    CPropHandleT<int> b;
    VPropHandleT<double> v;
    mesh.add_property(a, "a");
    CHECK_THROWS_AS(mesh.add_property(b, "a"), std::invalid_argument);
    CHECK_THROWS_AS(mesh.add_property(b, "b", PropertyHeritage<int>(PropertyRule::share)),
                    std::invalid_argument);
    CHECK_THROWS_AS(mesh.add_property(v, "v", PropertyHeritage<double>(PropertyRule::share)),
                    std::invalid_argument);
    CPropHandleT<double> found;
    CHECK(mesh.get_property_handle(found, "a"));
    CHECK(found == a);
    CHECK_FALSE(mesh.get_property_handle(b, "a"));  // another type
    mesh.remove_property(found);
    CHECK_FALSE(mesh.get_property_handle(a, "a"));
    const CProp<double> view = [&] {
        mesh.add_property(a, "again", PropertyHeritage<double>{}, 2.5);
        return mesh.property(a);
    }();
    CHECK(view[CellHandle(3)] == 2.5);
}
