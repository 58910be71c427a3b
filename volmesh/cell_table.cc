#include "volmesh/cell_table.hh"

#include <array>
#include <numeric>

namespace maille::volmesh {

/// The table of n entities, of which each cell has those that `entities_of` gives.
template <class Entity, class Entities>
CellTable<Entity> make_table(const TetMesh& mesh, std::size_t n, const Entities& entities_of) {
    CellTable<Entity> table;
    auto& [begins, cells] = table;
    begins.assign(n + 2, 0);
    for (const CellHandle c : mesh.cells())
        for (const Entity h : entities_of(c)) ++begins[h.idx() + 2];
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    cells.resize(begins.back());
    // Each begin is one place early, and is at its own when its list is full.
    for (const CellHandle c : mesh.cells())
        for (const Entity h : entities_of(c)) cells[begins[h.idx() + 1]++] = c;
    begins.pop_back();
    return table;
}

CellTable<VertexHandle> vertex_cells(const TetMesh& mesh) {
    return make_table<VertexHandle>(mesh, mesh.n_vertices(),
                                    [&](CellHandle c) { return mesh.cell_vertices(c); });
}

CellTable<EdgeHandle> edge_cells(const TetMesh& mesh) {
    return make_table<EdgeHandle>(mesh, mesh.n_edges(), [&](CellHandle c) {
        std::array<EdgeHandle, 6> edges;
        for (int e = 0; e < 6; ++e) edges[e] = mesh.edge_handle(c, e);
        return edges;
    });
}

}  // namespace maille::volmesh
