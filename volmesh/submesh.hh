#pragma once

#include <span>
#include <vector>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// A part of a mesh as a mesh of its own, and where its entities come from.
struct SubMesh {
    TetMesh mesh;  ///< the part
    ///@{
    /// By index in the part: the entity of the whole.
    std::vector<VertexHandle> vertices;
    std::vector<CellHandle> cells;
    ///@}
};

/// The cells given and their vertices, each in ascending order, with all sets and properties. A set that has
/// no member there is kept, empty. Cost: one pass over the mesh. Throws std::invalid_argument where a cell
/// isn't in the mesh or is given twice.
SubMesh submesh(const TetMesh& mesh, std::span<const CellHandle> cells);

/// The members of a cell set.
SubMesh submesh(const TetMesh& mesh, SetHandle cell_set);

}  // namespace maille::volmesh
