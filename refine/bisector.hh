#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "refine/lineage.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::refine {

using volmesh::CellHandle;
using volmesh::CellList;
using volmesh::TetMesh;
using volmesh::VertexHandle;

/// Bisects cells of a mesh at their longest edges and keeps, for each cell, which edge that is, the cell of
/// the first mesh that it lies in, and whether it has been born or changed of late.
///
/// "Longest" is by a total order on edges: the squared length; of equals, the older edge (by its younger end,
/// then by the other: fewer splits led to it), then the place of the midpoint, then the vertex indices. The
/// order depends on the edge alone, not on the cell that asks or on other elements, so the closure of a
/// refinement is conforming and unique. Numbering decides only where two edges share their midpoint.
class Bisector {
  public:
    /// The mesh must not be edited by others from then on, except that points may be moved (see `refresh`).
    explicit Bisector(TetMesh& mesh);

    /// The cells that are new or have changed since this was last asked, in the order in which they did (the
    /// paper's E_r, and more): all at first. From then on no cell counts as born.
    std::vector<CellHandle> take_changed();
    std::span<const CellHandle> changed() const { return changed_; }
    /// To be called when points of these cells have been moved.
    void refresh(std::span<const CellHandle> cells);

    /// Plain bisection: splits the cell's longest edge and with it every cell round that edge, at whichever
    /// edge that is to them. Nothing where the cell was born since `take_changed`. Returns false where the
    /// cell is still as it was, as rounding of the new point would invert a flat child.
    bool bisect(CellHandle c);

    /// Rivara's: splits the cell at its longest edge, and first, as often as need be, every cell in the way
    /// at its own longest edge, so that the mesh conforms after every single split and each cell is only ever
    /// bisected at its own longest edge. Otherwise as `bisect`.
    ///
    /// The cells in the way lie on the longest edge propagation path (M.-C. Rivara, "New longest-edge
    /// algorithms for the refinement and/or improvement of unstructured triangulations", 1997), whose edges
    /// grow strictly.
    bool bisect_conforming(CellHandle c);

    /// Splits any edge of a cell, with all cells round it; false where rounding would invert a child.
    bool split(CellHandle c, int local_edge);

    bool is_born(CellHandle c) const { return (state_[c.idx()] & born_bit) != 0; }
    int longest(CellHandle c) const { return state_[c.idx()] & edge_mask; }
    double longest_squared(CellHandle c) const;

    const TetMesh& mesh() const { return mesh_; }
    Lineage take_lineage() { return std::move(lineage_); }

  private:
    static constexpr std::uint8_t edge_mask = 7, born_bit = 8, changed_bit = 16;

    int find_longest(CellHandle c) const;
    auto tie_breaker(CellHandle c, int edge) const;
    CellHandle in_the_way(const CellList& ring, VertexHandle a, VertexHandle b) const;
    bool split(CellHandle c, int local_edge, const CellList& ring);
    void update(CellHandle c, std::uint8_t more_bits);

    TetMesh& mesh_;
    std::vector<std::uint8_t>
        state_;  ///< by cell: its longest edge, whether it is born, whether it has changed
    std::vector<std::uint16_t>
        generation_;  ///< by vertex: 0 in the first mesh, else one more than its parents'
    std::vector<CellHandle> changed_;
    std::vector<CellHandle> path_;  ///< kept to spare allocations
    Lineage lineage_;
};

}  // namespace maille::refine
