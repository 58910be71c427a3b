#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// One number for the edge between two vertices, the lower one high.
inline std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
    return (std::uint64_t{std::min(a, b)} << 32U) | std::max(a, b);
}

/// The lowest cell of each group of cells that hang together through faces that have all the hinge's
/// vertices: the fans round a vertex (a hinge of one) or an edge (of two). Ascending.
std::vector<std::uint32_t> first_cells_of_fans(const TetMesh& mesh, const CellList& cells,
                                               std::span<const VertexHandle> hinge);

}  // namespace maille::volmesh
