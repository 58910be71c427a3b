#include "volmesh/face_removal.hh"

#include <algorithm>

#include "volmesh/orientation.hh"
#include "volmesh/retriangulation.hh"
#include "volmesh/strata.hh"

namespace maille::volmesh {
namespace {

/// A side of the polygon that the faces make up; its triangle, seen from b, lies to the left of it.
struct Side {
    VertexHandle from, to;
    CellHandle cell;
};
using Sides = boost::container::small_vector<Side, 24>;

VertexHandle apex(const TetMesh& mesh, HalffaceHandle hf) {
    return mesh.cell_vertex(TetMesh::incident_cell(hf), TetMesh::local_face(hf));
}

Sides outline(const TetMesh& mesh, std::span<const HalffaceHandle> faces) {
    Sides sides;
    for (HalffaceHandle hf : faces) {
        const auto v = mesh.halfface_vertices(hf);
        for (int i = 0; i < 3; ++i) {
            const Side side{v[i], v[(i + 1) % 3], TetMesh::incident_cell(hf)};
            const auto back = std::ranges::find_if(
                sides, [&](const Side& s) { return s.from == side.to && s.to == side.from; });
            if (back == sides.end())
                sides.push_back(side);
            else
                sides.erase(back);
        }
    }
    return sides;
}

}  // namespace

bool is_face_removal_ok(const TetMesh& mesh, std::span<const HalffaceHandle> faces) {
    if (faces.empty()) return false;
    const VertexHandle a = apex(mesh, faces.front());
    const HalffaceHandle beyond = mesh.opposite_halfface_handle(faces.front());
    if (!beyond.is_valid()) return false;
    const VertexHandle b = apex(mesh, beyond);
    for (HalffaceHandle hf : faces) {
        const HalffaceHandle other = mesh.opposite_halfface_handle(hf);
        if (!other.is_valid() || apex(mesh, hf) != a || apex(mesh, other) != b || is_interface(mesh, hf))
            return false;
        // Edges between two of the faces vanish.
        const CellHandle c = TetMesh::incident_cell(hf);
        const int at = TetMesh::local_face(hf);
        for (int i = 0; i < 4; ++i) {
            if (i == at) continue;
            const HalffaceHandle wall = mesh.opposite_halfface_handle(TetMesh::halfface(c, i));
            const bool is_inner = wall.is_valid() && std::ranges::any_of(faces, [&](HalffaceHandle face) {
                                      return TetMesh::incident_cell(face) == TetMesh::incident_cell(wall);
                                  });
            if (!is_inner) continue;
            const int edge = tet::opposite_edge(tet::edge_between[at][i]);
            if (mesh.combination(c, edge) != 0 || is_interface(mesh, TetMesh::halfface(c, i))) return false;
            const HalffaceHandle above = mesh.opposite_halfface_handle(hf);
            const CellHandle d = TetMesh::incident_cell(above);
            if (is_interface(mesh, TetMesh::halfface(d, mesh.local_vertex(d, mesh.cell_vertex(c, i)))))
                return false;
        }
    }
    const Sides sides = outline(mesh, faces);
    if (sides.size() != faces.size() + 2) return false;
    return std::ranges::all_of(sides, [&](const Side& side) {
        return orientation(mesh.point(a), mesh.point(b), mesh.point(side.from), mesh.point(side.to)) > 0;
    });
}

void remove_faces(TetMesh& mesh, std::span<const HalffaceHandle> faces) {
    const VertexHandle a = apex(mesh, faces.front());
    const VertexHandle b = apex(mesh, mesh.opposite_halfface_handle(faces.front()));
    Retriangulation change{.old_cells = {}, .new_cells = {}};
    for (HalffaceHandle hf : faces) {
        change.old_cells.push_back(TetMesh::incident_cell(hf));
        change.old_cells.push_back(TetMesh::incident_cell(mesh.opposite_halfface_handle(hf)));
    }
    for (const Side& side : outline(mesh, faces))
        change.new_cells.push_back({{a, b, side.from, side.to}, side.cell});
    mesh.replace_cells(change);
}

bool is_flip_23_ok(const TetMesh& mesh, HalffaceHandle hf) {
    return is_face_removal_ok(mesh, {&hf, 1});
}

void flip_23(TetMesh& mesh, HalffaceHandle hf) {
    remove_faces(mesh, {&hf, 1});
}

}  // namespace maille::volmesh
