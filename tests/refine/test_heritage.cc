#include <cmath>

#include <doctest/doctest.h>

#include "meshes.hh"
#include "refine/refine.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

// Sets and properties through ten passes of refinement, against what geometry says of the refined mesh.

using namespace maille::refine;
using maille::volmesh::EdgeHandle;
using maille::volmesh::EntityKind;
using maille::volmesh::FaceHandle;
using maille::volmesh::PropertyHeritage;
using maille::volmesh::PropertyRule;
using maille::volmesh::SetHandle;
using maille::volmesh::SetRule;

namespace {

const SizeField graded([](const Point& p) { return 0.03 + 0.3 * (p - Point(0.4, 0.3, 0.2)).norm(); });

bool is_on_rim(const Point& p) {
    return p.x() == 0 && p.y() == 0;
}
bool is_on_diagonal(const Point& p) {
    return p.x() == p.y() && p.y() == p.z() && p.z() <= 0.5;
}
bool is_on_half_bottom(const Point& p) {
    return p.z() == 0 && p.x() <= 0.5;
}
bool is_on_wall(const Point& p) {
    return p.x() == 0.5;
}

template <class Points>
bool all(const Points& points, bool (*holds)(const Point&)) {
    return std::ranges::all_of(points, holds);
}

std::array<Point, 3> corners(const TetMesh& mesh, FaceHandle f) {
    const auto v = mesh.face_vertices(f);
    return {mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2])};
}
std::array<Point, 2> ends(const TetMesh& mesh, EdgeHandle e) {
    const auto v = mesh.edge_vertices(e);
    return {mesh.point(v[0]), mesh.point(v[1])};
}

SetHandle edge_set(TetMesh& mesh, const char* name, bool (*holds)(const Point&), SetRule rule) {
    const SetHandle set = mesh.add_set(name, EntityKind::edge, std::move(rule));
    for (const auto e : mesh.edges())
        if (all(ends(mesh, e), holds)) mesh.insert(set, EdgeHandle(e));
    return set;
}
SetHandle face_set(TetMesh& mesh, const char* name, bool (*holds)(const Point&), SetRule rule) {
    const SetHandle set = mesh.add_set(name, EntityKind::face, std::move(rule));
    for (const auto f : mesh.faces())
        if (all(corners(mesh, f), holds)) mesh.insert(set, FaceHandle(f));
    return set;
}
SetHandle vertex_set(TetMesh& mesh, const char* name, bool (*holds)(const Point&), SetRule rule) {
    const SetHandle set = mesh.add_set(name, EntityKind::vertex, std::move(rule));
    for (const auto v : mesh.vertices())
        if (holds(v.point())) mesh.insert(set, VertexHandle(v));
    return set;
}

void check_vertices(const TetMesh& mesh, SetHandle set, bool (*holds)(const Point&)) {
    CAPTURE(mesh.set_info(set).name);
    std::size_t n = 0;
    for (const auto v : mesh.vertices()) {
        CHECK(mesh.contains(set, VertexHandle(v)) == holds(v.point()));
        n += holds(v.point());
    }
    CHECK(mesh.set_size(set) == n);
    CHECK(n > 3);
}
void check_edges(const TetMesh& mesh, SetHandle set, bool (*holds)(const Point&)) {
    CAPTURE(mesh.set_info(set).name);
    std::size_t n = 0;
    for (const auto e : mesh.edges()) {
        CHECK(mesh.contains(set, EdgeHandle(e)) == all(ends(mesh, e), holds));
        n += all(ends(mesh, e), holds);
    }
    CHECK(mesh.set_size(set) == n);
    CHECK(n > 3);
}
void check_faces(const TetMesh& mesh, SetHandle set, bool (*holds)(const Point&)) {
    CAPTURE(mesh.set_info(set).name);
    std::size_t n = 0;
    for (const auto f : mesh.faces()) {
        CHECK(mesh.contains(set, FaceHandle(f)) == all(corners(mesh, f), holds));
        n += all(corners(mesh, f), holds);
    }
    CHECK(mesh.set_size(set) == n);
    CHECK(n > 3);
}

RefineResult ten_passes(TetMesh& mesh, Method method) {
    const RefineResult result =
        refine(mesh, graded, {.method = method, .order = Order::longest, .max_iterations = 10});
    CHECK(result.iterations == 10);
    CHECK(maille::volmesh::validate(mesh).ok());
    return result;
}

}  // namespace

TEST_CASE("edge, face and vertex sets are where geometry says after ten passes") {
    for (const Method method : {Method::rivara, Method::bisection}) {
        TetMesh mesh = test::kuhn_cube(2).mesh();
        const auto rim = edge_set(mesh, "rim", is_on_rim, SetRule::copy());
        const auto diagonal = edge_set(mesh, "diagonal", is_on_diagonal, SetRule::copy());
        const auto bottom = face_set(mesh, "bottom", is_on_half_bottom, SetRule::copy());
        const auto wall = face_set(mesh, "wall", is_on_wall, SetRule::copy());
        const auto rim_ends = vertex_set(mesh, "rim ends", is_on_rim, SetRule::both_ends(rim));
        const auto wall_nodes = vertex_set(mesh, "wall nodes", is_on_wall, SetRule::both_ends());
        const auto diagonal_nodes =
            vertex_set(mesh, "diagonal nodes", is_on_diagonal, SetRule::from_edges(diagonal));
        const auto bottom_nodes =
            vertex_set(mesh, "bottom nodes", is_on_half_bottom, SetRule::from_faces(bottom));
        ten_passes(mesh, method);
        check_edges(mesh, rim, is_on_rim);
        check_edges(mesh, diagonal, is_on_diagonal);
        check_faces(mesh, bottom, is_on_half_bottom);
        check_faces(mesh, wall, is_on_wall);
        check_vertices(mesh, rim_ends, is_on_rim);
        check_vertices(mesh, wall_nodes, is_on_wall);
        check_vertices(mesh, diagonal_nodes, is_on_diagonal);
        check_vertices(mesh, bottom_nodes, is_on_half_bottom);
        CHECK(maille::volmesh::measure(mesh, bottom) == doctest::Approx(0.5));
        CHECK(maille::volmesh::measure(mesh, diagonal) == doctest::Approx(std::sqrt(0.75)));
    }
}

TEST_CASE("what is not inherited stays with the entities that are left as they were") {
    TetMesh mesh = test::kuhn_cube(2).mesh();
    const TetMesh before = mesh;
    const auto load = vertex_set(mesh, "load", is_on_rim, SetRule::none());
    const auto rim = edge_set(mesh, "rim", is_on_rim, SetRule::none());
    const auto wall = face_set(mesh, "wall", is_on_wall, SetRule::none());
    const auto cells = mesh.add_set("cells", EntityKind::cell, SetRule::none());
    for (const auto c : mesh.cells()) mesh.insert(cells, CellHandle(c));
    refine(mesh, SizeField([](const Point& p) { return 0.03 + 0.5 * p.norm(); }), {.max_iterations = 10});
    const auto first_new = before.n_vertices();
    for (const auto v : mesh.vertices())
        CHECK(mesh.contains(load, VertexHandle(v)) == (v.idx() < first_new && is_on_rim(v.point())));
    const auto is_old = [&](const auto& vertices) {
        return std::ranges::all_of(vertices, [&](const auto v) { return v.idx() < first_new; });
    };
    for (const auto e : mesh.edges())
        CHECK(mesh.contains(rim, EdgeHandle(e)) ==
              (is_old(mesh.edge_vertices(e)) && all(ends(mesh, e), is_on_rim)));
    for (const auto f : mesh.faces())
        CHECK(mesh.contains(wall, FaceHandle(f)) ==
              (is_old(mesh.face_vertices(f)) && all(corners(mesh, f), is_on_wall)));
    for (const auto c : mesh.cells()) CHECK(mesh.contains(cells, CellHandle(c)) == is_old(c.vertices()));
    CHECK(mesh.set_size(wall) > 0);
    CHECK(mesh.set_size(cells) > 0);
    CHECK(mesh.set_size(rim) < 2);
}

TEST_CASE("cell sets, custom rules and overlapping sets hold after ten passes") {
    TetMesh mesh = test::random_cube(2, 12, 0.2).mesh();
    const TetMesh before = mesh;
    const auto odd = mesh.add_set("odd", EntityKind::cell);
    const auto third = mesh.add_set("third", EntityKind::cell);
    for (const auto c : mesh.cells()) {
        if (c.idx() % 2 == 1) mesh.insert(odd, CellHandle(c));
        if (c.idx() % 3 == 0) mesh.insert(third, CellHandle(c));
    }
    // The cells at one corner stay the cells at that corner; new vertices right of the middle are probes.
    VertexHandle corner;
    for (const auto v : mesh.vertices())
        if (v.point() == Point::Zero()) corner = VertexHandle(v);
    const auto tip =
        mesh.add_set("tip", EntityKind::cell, SetRule::custom([corner](const TetMesh&, auto cell, auto...) {
                         return std::ranges::find(cell, corner) != cell.end();
                     }));
    for (const CellHandle c : mesh.vc_range(corner)) mesh.insert(tip, c);
    const auto probes =
        mesh.add_set("probes", EntityKind::vertex,
                     SetRule::custom([](const TetMesh& m, auto, auto, auto, VertexHandle born) {
                         return m.point(born).x() > 0.5;
                     }));
    const RefineResult result = ten_passes(mesh, Method::rivara);
    for (const auto c : mesh.cells()) {
        const std::uint32_t ancestor = result.lineage.cell_ancestors[c.idx()];
        CHECK(mesh.contains(odd, CellHandle(c)) == (ancestor % 2 == 1));
        CHECK(mesh.contains(third, CellHandle(c)) == (ancestor % 3 == 0));
        CHECK(mesh.contains(tip, CellHandle(c)) == (mesh.local_vertex(c, corner) >= 0));
    }
    for (const auto v : mesh.vertices())
        CHECK(mesh.contains(probes, VertexHandle(v)) ==
              (v.idx() >= before.n_vertices() && v.point().x() > 0.5));
    double volume = 0;
    for (std::uint32_t i = 1; i < before.n_cells(); i += 2)
        volume += maille::volmesh::volume(before, CellHandle(i));
    CHECK(maille::volmesh::measure(mesh, odd) == doctest::Approx(volume));
}

TEST_CASE("vertex properties follow their rules through ten passes") {
    TetMesh mesh = test::random_cube(2, 13, 0.2).mesh();
    const auto linear = [](const Point& p) { return 1 + p.x() + 2 * p.y() - 0.5 * p.z(); };
    maille::volmesh::VPropHandleT<double> temperature, growth, blank;
    maille::volmesh::VPropHandleT<Point> place;
    maille::volmesh::VPropHandleT<int> label;
    mesh.add_property(temperature, "temperature", {PropertyRule::interpolate});
    mesh.add_property(place, "place", PropertyHeritage<Point>{PropertyRule::interpolate},
                      Point(Point::Zero()));
    mesh.add_property(label, "label", {PropertyRule::copy});
    mesh.add_property(blank, "blank", {PropertyRule::none}, -7.0);
    PropertyHeritage<double> geometric;
    geometric.at_vertex = [](double a, double b, double ratio) {
        return std::pow(a, 1 - ratio) * std::pow(b, ratio);
    };
    mesh.add_property(growth, "growth", geometric);
    const auto n_before = mesh.n_vertices();
    for (const auto v : mesh.vertices()) {
        mesh.property(temperature, VertexHandle(v)) = linear(v.point());
        mesh.property(place, VertexHandle(v)) = v.point();
        mesh.property(label, VertexHandle(v)) = static_cast<int>(v.idx());
        mesh.property(blank, VertexHandle(v)) = v.idx();
        mesh.property(growth, VertexHandle(v)) = std::exp(linear(v.point()));
    }
    const RefineResult result = ten_passes(mesh, Method::rivara);
    for (const auto v : mesh.vertices()) {
        CHECK(mesh.property(temperature, VertexHandle(v)) ==
              doctest::Approx(linear(v.point())).epsilon(1e-13));
        CHECK((mesh.property(place, VertexHandle(v)) - v.point()).norm() < 1e-14);
        CHECK(mesh.property(growth, VertexHandle(v)) ==
              doctest::Approx(std::exp(linear(v.point()))).epsilon(1e-12));
        std::uint32_t oldest = v.idx();
        while (oldest >= n_before)
            oldest = std::ranges::min(result.lineage.vertex_parents[oldest - n_before]);
        CHECK(mesh.property(label, VertexHandle(v)) == static_cast<int>(oldest));
        CHECK(mesh.property(blank, VertexHandle(v)) == (v.idx() < n_before ? v.idx() : -7.0));
    }
}

TEST_CASE("cell properties follow their rules, and shared ones keep their sums") {
    TetMesh mesh = test::random_cube(2, 14, 0.2).mesh();
    const TetMesh before = mesh;
    const auto density = [](std::uint32_t cell) { return 1.0 + cell; };
    maille::volmesh::CPropHandleT<double> mass, blank;
    maille::volmesh::CPropHandleT<int> material, generation;
    mesh.add_property(mass, "mass", {PropertyRule::share});
    mesh.add_property(material, "material", {PropertyRule::copy});
    mesh.add_property(blank, "blank", {PropertyRule::none}, -7.0);
    PropertyHeritage<int> older;
    older.at_children = [](int parent, double) { return std::pair(parent + 1, parent + 1); };
    mesh.add_property(generation, "generation", older);
    double total = 0;
    for (const auto c : mesh.cells()) {
        const double volume = maille::volmesh::volume(mesh, c);
        mesh.property(mass, CellHandle(c)) = density(c.idx()) * volume;
        mesh.property(material, CellHandle(c)) = static_cast<int>(c.idx());
        mesh.property(blank, CellHandle(c)) = c.idx();
        total += density(c.idx()) * volume;
    }
    const RefineResult result = ten_passes(mesh, Method::rivara);
    double sum = 0;
    for (const auto c : mesh.cells()) {
        const std::uint32_t ancestor = result.lineage.cell_ancestors[c.idx()];
        const double volume = maille::volmesh::volume(mesh, c);
        const double halvings = std::log2(maille::volmesh::volume(before, CellHandle(ancestor)) / volume);
        CHECK(mesh.property(mass, CellHandle(c)) ==
              doctest::Approx(density(ancestor) * volume).epsilon(1e-9));
        CHECK(mesh.property(material, CellHandle(c)) == static_cast<int>(ancestor));
        CHECK(mesh.property(generation, CellHandle(c)) == std::lround(halvings));
        CHECK(mesh.property(blank, CellHandle(c)) == (std::lround(halvings) == 0 ? ancestor : -7.0));
        sum += mesh.property(mass, CellHandle(c));
    }
    CHECK(sum == doctest::Approx(total).epsilon(1e-13));
}

TEST_CASE("loads on edges and faces are shared by length and area") {
    TetMesh mesh = test::kuhn_cube(2).mesh();
    maille::volmesh::EPropHandleT<double> line_load;
    maille::volmesh::FPropHandleT<double> pressure_force;
    mesh.add_property(line_load, "line load", {PropertyRule::share});
    mesh.add_property(pressure_force, "force", {PropertyRule::share});
    const auto length = [&](const TetMesh& m, EdgeHandle e) {
        return (ends(m, e)[0] - ends(m, e)[1]).norm();
    };
    const auto area = [&](const TetMesh& m, FaceHandle f) {
        const auto p = corners(m, f);
        return 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
    };
    for (const auto e : mesh.edges())
        if (all(ends(mesh, e), is_on_diagonal)) mesh.property(line_load, EdgeHandle(e)) = 3 * length(mesh, e);
    for (const auto f : mesh.faces())
        if (all(corners(mesh, f), is_on_wall))
            mesh.property(pressure_force, FaceHandle(f)) = 2 * area(mesh, f);
    ten_passes(mesh, Method::rivara);
    double line_sum = 0, force_sum = 0;
    for (const auto e : mesh.edges()) {
        const double expected = all(ends(mesh, e), is_on_diagonal) ? 3 * length(mesh, e) : 0;
        CHECK(mesh.property(line_load, EdgeHandle(e)) == doctest::Approx(expected).epsilon(1e-12));
        line_sum += mesh.property(line_load, EdgeHandle(e));
    }
    for (const auto f : mesh.faces()) {
        const double expected = all(corners(mesh, f), is_on_wall) ? 2 * area(mesh, f) : 0;
        CHECK(mesh.property(pressure_force, FaceHandle(f)) == doctest::Approx(expected).epsilon(1e-12));
        force_sum += mesh.property(pressure_force, FaceHandle(f));
    }
    CHECK(line_sum == doctest::Approx(3 * std::sqrt(0.75)).epsilon(1e-13));
    CHECK(force_sum == doctest::Approx(2.0).epsilon(1e-13));
}
