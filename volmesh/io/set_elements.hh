#pragma once

#include <array>
#include <vector>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh::io {

/// An entity that is in at least one set, as files list it: a point, a line or a triangle.
template <std::size_t N>
struct SetElement {
    std::array<TetMesh::Index, N> vertices;
    CombinationId combination;
    CellHandle cell;  ///< one that it is part of; invalid for a vertex without cells
};

/// The vertices, edges and faces that are in sets, in an order that depends on the mesh alone.
struct SetElements {
    std::vector<SetElement<1>> vertices;
    std::vector<SetElement<2>> edges;
    std::vector<SetElement<3>> faces;
};

SetElements set_elements(const TetMesh& mesh);

}  // namespace maille::volmesh::io
