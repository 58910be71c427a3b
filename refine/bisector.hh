#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "refine/lineage.hh"
#include "refine/longest_edge.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::refine {

using volmesh::CellList;
using volmesh::EdgeStars;

/// Bisects cells of a mesh and keeps, for each cell, which edge is its longest, the cell of the first mesh
/// that it lies in, and whether it has been born or changed of late.
class Bisector {
  public:
    /// The mesh must not be edited by others from then on, except that points may be moved (see `refresh`).
    explicit Bisector(TetMesh& mesh, Ties ties = Ties::order);

    /// A pass begins that is to refine these cells: from now on they decide between edges of one length,
    /// where the rule for ties asks for them. Cost: then it looks at all cells of the mesh.
    void begin_pass(std::span<const CellHandle> marked);

    /// The cells that are new or have changed since they were last taken, ascending (the paper's E_r, and
    /// more): all at first. Cost: a byte is read for each cell of the mesh.
    std::vector<CellHandle> changed() const;
    /// The same, but where no more than single splits and `refresh` have changed cells in the order in which
    /// they did, on which plain bisection depends. From then on no cell counts as born or changed.
    std::vector<CellHandle> take_changed();
    /// To be called when points of these cells have been moved.
    void refresh(std::span<const CellHandle> cells);

    /// Plain bisection: splits the cell's longest edge and with it every cell round that edge, at whichever
    /// edge that is to them. Nothing where the cell was born since `take_changed`. Returns false where the
    /// cell is still as it was, as rounding of the new point would invert a flat child.
    bool bisect(CellHandle c);
    /// Splits any edge of a cell, with all cells round it; false where rounding would invert a child.
    bool split(CellHandle c, int local_edge);
    /// Splits many edges at once, by as many threads as there are. The result is that of one after another.
    /// Precondition: none of them would invert a child.
    void split(const EdgeStars& stars);
    /// Whether no child would be inverted, the cells round the edge a-b being these.
    bool can_split(EdgeStars::Edge edge, std::span<const CellHandle> ring) const;

    bool is_born(CellHandle c) const { return (state_[c.idx()] & born_bit) != 0; }
    int longest(CellHandle c) const { return state_[c.idx()] & edge_mask; }
    double longest_squared(CellHandle c) const;
    EdgeStars::Edge longest_edge(CellHandle c) const {
        const auto [i, j] = volmesh::tet::edge_vertices[longest(c)];
        return {mesh_.cell_vertex(c, i), mesh_.cell_vertex(c, j)};
    }

    // Marks of the caller's on a cell, which are gone once it has been split. Set, they return false where
    // the cell has that mark already.
    bool list(CellHandle c) { return mark(c, listed_bit); }    ///< it is to be bisected
    bool claim(CellHandle c) { return mark(c, claimed_bit); }  ///< an edge of it is going to be split
    bool is_listed(CellHandle c) const { return (state_[c.idx()] & listed_bit) != 0; }
    void unlist(CellHandle c) { state_[c.idx()] &= static_cast<std::uint8_t>(~listed_bit); }

    const TetMesh& mesh() const { return mesh_; }
    Lineage take_lineage() { return std::move(lineage_); }

  private:
    static constexpr std::uint8_t edge_mask = 7, born_bit = 8, changed_bit = 16, listed_bit = 32,
                                  claimed_bit = 64;

    bool mark(CellHandle c, std::uint8_t bit);

    TetMesh& mesh_;
    LongestEdge longest_edge_;
    volmesh::Column<std::uint8_t> state_;  ///< by cell: its longest edge, and the marks above
    std::vector<CellHandle> log_;          ///< cells that `refresh` and single splits have changed, in order
    Lineage lineage_;
};

}  // namespace maille::refine
