#pragma once

#include <algorithm>
#include <span>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// Local numbers in a cell round a split edge of its ends a and b, and of the two others.
struct TetMesh::SplitLocals {
    std::uint8_t a, b, k, l;
    int edge() const { return tet::edge_between[a][b]; }
};

/// An edge split a-b -> a-m-b under way. The old cells keep a, the new ones, at `first_new` onwards in the
/// ring's order, keep b; m stands where b or a stood, so a child's local numbers are its parent's.
struct TetMesh::Split {
    VertexHandle a, b, m;
    Index first_new = 0;
    double ratio = 0.5;
    std::span<const CellHandle> ring;
    std::span<const SplitLocals> locals;  ///< by cell of the ring

    Index new_cell(std::size_t in_ring) const { return first_new + static_cast<Index>(in_ring); }
    /// The new child of a cell; the cell itself where it isn't in the ring.
    Index child_with_b(Index cell) const {
        const auto at = std::ranges::find(ring, CellHandle(cell));
        return at == ring.end() ? cell : new_cell(static_cast<std::size_t>(at - ring.begin()));
    }
};

}  // namespace maille::volmesh
