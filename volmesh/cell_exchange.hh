#pragma once

#include <vector>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// Cells to be taken out of a mesh, and others to be put in, many at once, and their vertices with them.
///
/// What stays has the lowest numbers afterwards, the last cells and vertices moving into the gaps; then come
/// the new ones, in their order. What stays keeps its sets and values; what is new is in no set but those of
/// the faces and edges that it shares, and has the properties' defaults.
struct CellExchange {
    std::vector<CellHandle> gone;  ///< each once; vertices that have no other cells go, too
    std::vector<Point> points;     ///< of new vertices
    /// Vertices: such as stay, by their numbers before, or new ones, numbered on from n_vertices().
    /// Neighbours: half-faces of these cells, by their place in this list, or `none` for those that are to be
    /// looked for, among these cells and at the faces of staying cells that have one cell then.
    Column<TetMesh::Cell> cells;
};

/// Which numbers an exchange left: all but those of the vertices and cells that moved.
struct ExchangedNumbers {
    ///@{
    /// How many stay.
    TetMesh::Index n_vertices, n_cells;
    ///@}
    ///@{
    /// Where those went that had this number or a higher one; `none` for what is gone.
    std::vector<TetMesh::Index> vertices, cells;
    ///@}

    ///@{
    /// The number afterwards of what stays, by that before.
    TetMesh::Index vertex(TetMesh::Index before) const {
        return before < n_vertices ? before : vertices[before - n_vertices];
    }
    TetMesh::Index cell(TetMesh::Index before) const {
        return before < n_cells ? before : cells[before - n_cells];
    }
    ///@}
};

}  // namespace maille::volmesh
