#include "tools/benchmark/named_parts.hh"

#include <functional>
#include <string>

namespace maille::benchmark {
namespace {

using namespace volmesh;

using Where = std::function<bool(const Point&)>;

bool is_all(const Where& where, std::initializer_list<Point> points) {
    return std::ranges::all_of(points, where);
}

void name_faces(TetMesh& mesh, const std::string& name, const Where& where) {
    const SetHandle set = mesh.add_set(name, EntityKind::face);
    for (const HalffaceHandle hf : mesh.boundary_halffaces()) {
        const auto v = mesh.halfface_vertices(hf);
        if (is_all(where, {mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2])})) mesh.insert(set, hf);
    }
}

void name_edges(TetMesh& mesh, const std::string& name, const Where& where) {
    const SetHandle set = mesh.add_set(name, EntityKind::edge);
    for (const CellHandle c : mesh.cells()) {
        const auto p = mesh.cell_points(c);
        for (int e = 0; e < 6; ++e) {
            const auto [i, j] = tet::edge_vertices[e];
            if (is_all(where, {p[i], p[j]}) && !mesh.contains(set, c, e)) mesh.insert(set, c, e);
        }
    }
}

void name_cells(TetMesh& mesh, const std::string& name, const Where& where) {
    const SetHandle set = mesh.add_set(name, EntityKind::cell);
    for (const CellHandle c : mesh.cells()) {
        const auto p = mesh.cell_points(c);
        if (where(0.25 * (p[0] + p[1] + p[2] + p[3]))) mesh.insert(set, c);
    }
}

void name_vertices(TetMesh& mesh, const std::string& name, const SetRule& rule, const Where& where) {
    const SetHandle set = mesh.add_set(name, EntityKind::vertex, rule);
    for (const VertexHandle v : mesh.vertices())
        if (where(mesh.point(v))) mesh.insert(set, v);
}

}  // namespace

void name_parts(TetMesh& mesh) {
    const auto at = [](int axis, double place) {
        return [axis, place](const Point& p) { return p[axis] == place; };
    };
    const auto both = [](const Where& a, const Where& b) {
        return [a, b](const Point& p) { return a(p) && b(p); };
    };
    name_faces(mesh, "x-", at(0, 0));
    name_faces(mesh, "x+", at(0, 1));
    name_faces(mesh, "y-", at(1, 0));
    name_faces(mesh, "y+", at(1, 1));
    name_faces(mesh, "z-", at(2, 0));
    name_faces(mesh, "z+", at(2, 1));
    name_edges(mesh, "x axis", both(at(1, 0), at(2, 0)));
    name_edges(mesh, "y axis", both(at(0, 0), at(2, 0)));
    name_edges(mesh, "z axis", both(at(0, 0), at(1, 0)));
    name_edges(mesh, "top", both(at(1, 1), at(2, 1)));
    name_cells(mesh, "all", [](const Point&) { return true; });
    name_cells(mesh, "low", [](const Point& p) { return p.z() < 0.5; });
    name_cells(mesh, "left", [](const Point& p) { return p.x() < 0.25; });
    name_cells(mesh, "core", [](const Point& p) { return p.norm() < 0.4; });

    const auto set = [&](const std::string& name, EntityKind kind) { return mesh.find_set(name, kind); };
    const auto face = set("x-", EntityKind::face), edge = set("z axis", EntityKind::edge),
               low = set("low", EntityKind::cell);
    name_vertices(mesh, "load", SetRule::none(), [](const Point& p) { return p.norm() == 0; });
    name_vertices(mesh, "support", SetRule::from_faces(face), at(0, 0));
    name_vertices(mesh, "hinge", SetRule::from_edges(edge), both(at(0, 0), at(1, 0)));
    name_vertices(mesh, "wall", SetRule::both_ends(set("y-", EntityKind::face)), at(1, 0));
    name_vertices(mesh, "base", SetRule::both_ends(low), [](const Point& p) { return p.z() <= 0.5; });
    name_vertices(mesh, "warm", SetRule::both_ends(), [](const Point& p) { return p.x() > 0.5; });

    VPropHandleT<double> temperature;
    mesh.add_property(temperature, "temperature", {PropertyRule::interpolate});
    for (const VertexHandle v : mesh.vertices()) mesh.property(temperature, v) = mesh.point(v).x();
}

}  // namespace maille::benchmark
