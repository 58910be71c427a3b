#include "volmesh/submesh.hh"

#include <algorithm>
#include <stdexcept>

namespace maille::volmesh {

SubMesh submesh(const TetMesh& mesh, std::span<const CellHandle> cells) {
    SubMesh part;
    part.cells.assign(cells.begin(), cells.end());
    std::ranges::sort(part.cells);
    std::vector<std::uint8_t> is_in(mesh.n_vertices(), 0);
    for (CellHandle c : part.cells)
        if (c.idx() < mesh.n_cells())
            for (VertexHandle v : mesh.cell_vertices(c)) is_in[v.idx()] = 1;
    for (TetMesh::Index v = 0; v < mesh.n_vertices(); ++v)
        if (is_in[v] != 0) part.vertices.emplace_back(v);
    part.mesh = mesh.taken(part.vertices, part.cells);
    return part;
}

SubMesh submesh(const TetMesh& mesh, SetHandle cell_set) {
    if (mesh.set_info(cell_set).kind != EntityKind::cell)
        throw std::invalid_argument("a part of a mesh is told by a set of cells");
    return submesh(mesh, mesh.cell_members(cell_set));
}

}  // namespace maille::volmesh
