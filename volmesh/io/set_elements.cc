#include "volmesh/io/set_elements.hh"

#include <algorithm>

namespace maille::volmesh::io {

namespace {

bool has_sets_of(const TetMesh& mesh, EntityKind kind) {
    for (TetMesh::Index s = 0; s < mesh.n_sets(); ++s)
        if (mesh.set_info(SetHandle(s)).kind == kind) return true;
    return false;
}

std::vector<SetElement<1>> vertex_elements(const TetMesh& mesh) {
    std::vector<CellHandle> lowest_cell(mesh.n_vertices());
    for (TetMesh::Index c = mesh.n_cells(); c-- > 0;)
        for (VertexHandle v : mesh.cell_vertices(CellHandle(c))) lowest_cell[v.idx()] = CellHandle(c);
    std::vector<SetElement<1>> elements;
    for (TetMesh::Index v = 0; v < mesh.n_vertices(); ++v)
        if (const CombinationId combination = mesh.combination(VertexHandle(v)); combination != 0)
            elements.push_back({{v}, combination, lowest_cell[v]});
    return elements;
}

std::vector<SetElement<2>> edge_elements(const TetMesh& mesh) {
    std::vector<SetElement<2>> elements;
    for (TetMesh::Index i = 0; i < mesh.n_cells(); ++i) {
        const CellHandle c(i);
        for (int e = 0; e < 6; ++e) {
            const CombinationId combination = mesh.combination(c, e);
            if (combination == 0 || std::ranges::min(mesh.cells_around(c, e)) != c) continue;
            const auto [a, b] = tet::edge_vertices[e];
            elements.push_back(
                {{mesh.cell_vertex(c, a).idx(), mesh.cell_vertex(c, b).idx()}, combination, c});
        }
    }
    return elements;
}

std::vector<SetElement<3>> face_elements(const TetMesh& mesh) {
    std::vector<SetElement<3>> elements;
    for (TetMesh::Index i = 0; i < mesh.n_halffaces(); ++i) {
        const HalffaceHandle hf(i);
        const CombinationId combination = mesh.combination(hf);
        // The opposite of a boundary face is invalid, which is more than any other.
        if (combination == 0 || mesh.opposite_halfface_handle(hf) < hf) continue;
        const auto [a, b, c] = mesh.halfface_vertices(hf);
        elements.push_back({{a.idx(), b.idx(), c.idx()}, combination, TetMesh::incident_cell(hf)});
    }
    return elements;
}

}  // namespace

SetElements set_elements(const TetMesh& mesh) {
    SetElements elements;
    if (has_sets_of(mesh, EntityKind::vertex)) elements.vertices = vertex_elements(mesh);
    if (has_sets_of(mesh, EntityKind::edge)) elements.edges = edge_elements(mesh);
    if (has_sets_of(mesh, EntityKind::face)) elements.faces = face_elements(mesh);
    return elements;
}

}  // namespace maille::volmesh::io
