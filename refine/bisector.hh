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

/// Bisects cells of a mesh at their longest edges and keeps, for each cell, which edge that is, the cell of the first
/// mesh that it lies in, and whether it was born in the present pass.
///
/// "Longest" is by a total order on edges: the squared length; of equals, the older edge (fewer splits led to its
/// younger end), then the place of the midpoint, then the vertex indices. The order depends on the edge alone, not on
/// the cell that asks or on other elements, so the closure of a refinement is conforming and unique. Numbering decides
/// only where two edges share their midpoint.
class Bisector {
  public:
    /// The mesh must not be edited by others from then on, except that points may be moved (see `refresh`).
    explicit Bisector(TetMesh& mesh);

    /// Begins a pass: no cell counts as born in it yet.
    void begin_pass();

    /// Plain bisection: splits the cell's longest edge and with it every cell round that edge, at whichever edge that
    /// is to them. Nothing where the cell was born in this pass.
    void bisect(CellHandle c);

    /// Rivara's: splits the cell at its longest edge, and first, as often as need be, every cell in the way at its own
    /// longest edge, so that the mesh conforms after every single split and each cell is only ever bisected at its own
    /// longest edge. Nothing where the cell was born in this pass.
    ///
    /// The cells in the way lie on the longest edge propagation path (M.-C. Rivara, "New longest-edge algorithms for
    /// the refinement and/or improvement of unstructured triangulations", 1997), whose edges grow strictly.
    void bisect_conforming(CellHandle c);

    /// Cells that were born in this pass, ascending.
    std::vector<CellHandle> born() const;
    bool is_born(CellHandle c) const { return (state_[c.idx()] & born_bit) != 0; }

    int longest(CellHandle c) const { return state_[c.idx()] & edge_mask; }
    double longest_squared(CellHandle c) const;
    /// To be called when points of these cells have been moved.
    void refresh(std::span<const CellHandle> cells);

    const TetMesh& mesh() const { return mesh_; }
    Lineage take_lineage() { return std::move(lineage_); }

  private:
    static constexpr std::uint8_t edge_mask = 7, born_bit = 8;

    int find_longest(CellHandle c) const;
    auto tie_breaker(CellHandle c, int edge) const;
    void split(CellHandle c, const CellList& ring);
    CellHandle in_the_way(const CellList& ring, VertexHandle a, VertexHandle b) const;

    TetMesh& mesh_;
    std::vector<std::uint8_t> state_;        ///< by cell: its longest edge and whether it was born in this pass
    std::vector<std::uint16_t> generation_;  ///< by vertex: 0 in the first mesh, else one more than its parents'
    std::vector<CellHandle> reborn_;  ///< cells of before the pass whose index a child has taken
    std::uint32_t first_new_ = 0;     ///< number of cells when the pass began
    std::vector<CellHandle> path_;    ///< kept to spare allocations
    Lineage lineage_;
};

}  // namespace maille::refine
