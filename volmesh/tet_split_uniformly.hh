#pragma once

#include <algorithm>

#include "volmesh/octasection.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// A split of all cells under way. The children of cell c are 8 c .. 8 c + 7 in the order of the Octasection,
/// the middle of edge e is the vertex n + e.
class TetMesh::UniformSplit {
  public:
    explicit UniformSplit(TetMesh& mesh);
    std::vector<std::array<VertexHandle, 2>> run();

  private:
    void pass_on_vertex_sets();
    void pass_on_rows();
    void pass_on_cell_values();
    void apply_custom_rules();
    void add_middles();
    void divide(Index c, const Column<Cell>& parents);
    Index beyond(const Cell& parent, int child, int face, const Column<Cell>& parents) const;
    void divide_edges(const Column<Cell>& parents);
    void divide_faces(const Column<Cell>& parents);
    NamedSets::RowId child_row(const NamedSets::Row& parent, int diagonal, int child);

    const tet::Octasection& section(Index c) const { return tet::octasections[diagonals_[c]]; }
    static Index local(const Cell& cell, Index vertex) {
        return static_cast<Index>(std::ranges::find(cell.vertices, vertex) - cell.vertices.begin());
    }

    TetMesh& mesh_;
    Index n_vertices_, n_cells_, n_edges_ = 0;       ///< before
    bool has_edges_;                                 ///< or else they are numbered for the split alone
    std::vector<std::array<VertexHandle, 2>> ends_;  ///< of the old edges
    Column<std::uint8_t> diagonals_;                 ///< of the Octasection, by old cell
};

}  // namespace maille::volmesh
