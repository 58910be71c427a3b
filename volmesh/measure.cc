#include "volmesh/measure.hh"

#include <Eigen/Geometry>

namespace maille::volmesh {

double tet_volume(const Point& a, const Point& b, const Point& c, const Point& d) {
    return (b - a).cross(c - a).dot(d - a) / 6;
}

double triangle_area(const Point& a, const Point& b, const Point& c) {
    return (b - a).cross(c - a).norm() / 2;
}

double volume(const TetMesh& mesh, CellHandle c) {
    const auto p = mesh.cell_points(c);
    return tet_volume(p[0], p[1], p[2], p[3]);
}

double area(const TetMesh& mesh, HalffaceHandle hf) {
    const auto v = mesh.halfface_vertices(hf);
    return triangle_area(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]));
}

double volume(const TetMesh& mesh) {
    double sum = 0;
    for (CellHandle c : mesh.cells()) sum += volume(mesh, c);
    return sum;
}

double boundary_area(const TetMesh& mesh) {
    double sum = 0;
    for (HalffaceHandle hf : mesh.boundary_halffaces()) sum += area(mesh, hf);
    return sum;
}

double measure(const TetMesh& mesh, SetHandle set) {
    double sum = 0;
    switch (mesh.set_info(set).kind) {
        case EntityKind::vertex:
            return static_cast<double>(mesh.set_size(set));
        case EntityKind::edge:
            for (const auto& [c, e] : mesh.edge_members(set)) {
                const auto [i, j] = tet::edge_vertices[e];
                sum += (mesh.point(mesh.cell_vertex(c, i)) - mesh.point(mesh.cell_vertex(c, j))).norm();
            }
            break;
        case EntityKind::face:
            for (HalffaceHandle hf : mesh.face_members(set)) sum += area(mesh, hf);
            break;
        case EntityKind::cell:
            for (CellHandle c : mesh.cell_members(set)) sum += volume(mesh, c);
            break;
    }
    return sum;
}

}  // namespace maille::volmesh
