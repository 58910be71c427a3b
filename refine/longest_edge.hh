#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "volmesh/tet_mesh.hh"

namespace maille::refine {

using volmesh::CellHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

/// Which of several edges of one length counts as the longest (the paper, section 3.3, "Edge of
/// subdivision").
enum class Ties : std::uint8_t {
    order,    ///< the older one
    fewest,   ///< the one with the fewest cells round it that are not to be refined, counted when a pass
              ///< begins; then the older one
    boundary  ///< one on the boundary; then the older one
};

/// Tells the longest edge of a cell by a total order on edges: the squared length; of equals, what `Ties`
/// says, then the older edge (by its younger end, then by the other: fewer splits led to it), then the place
/// of the midpoint, then the vertex indices. Within a pass the order depends on the edge alone, not on the
/// cell that asks or on other elements, so the closure of a refinement is conforming and unique. Numbering
/// decides only where two edges share their midpoint.
class LongestEdge {
  public:
    /// The mesh must outlive this.
    LongestEdge(const TetMesh& mesh, Ties ties) : mesh_(mesh), ties_(ties), generations_(mesh.n_vertices()) {}

    /// A pass begins that is to refine these cells. Returns whether other edges may be the longest from now
    /// on.
    bool begin_pass(std::span<const CellHandle> marked);

    /// Local number of a cell's longest edge.
    int of(CellHandle c) const;
    /// The same of both children of a cell that has been split at a vertex m: of `c`, which keeps the end a
    /// and has m at the local vertex `at_m`, and of its other child, which has m at `at_a` instead. Cheaper
    /// than to ask for each.
    std::array<int, 2> of_children(CellHandle c, CellHandle other, int at_a, int at_m) const;

    /// Vertices from `first` on have been born, each between two older ones.
    void add(std::uint32_t first, std::span<const std::array<std::uint32_t, 2>> parents);

  private:
    int precedence(CellHandle c, int edge) const;
    bool wins_tie(CellHandle c, int edge, int against) const;
    int longest(CellHandle c, const std::array<double, 6>& squares) const;

    const TetMesh& mesh_;
    Ties ties_;
    /// By edge (its ends packed, the lower one high): cells round it that the pass isn't to refine. Edges
    /// that are born in the pass are not in it.
    std::unordered_map<std::uint64_t, int> n_unrefined_;
    std::vector<std::uint16_t>
        generations_;  ///< by vertex: 0 in the first mesh, else one more than its parents'
};

/// Of the edge between two points; summed in one order everywhere, so that equal edges stay equal.
inline double squared_length(const volmesh::Point& a, const volmesh::Point& b) {
    const double x = a.x() - b.x(), y = a.y() - b.y(), z = a.z() - b.z();
    return x * x + y * y + z * z;
}

}  // namespace maille::refine
