#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "volmesh/tet_mesh.hh"

namespace maille::refine {

using volmesh::CellHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

/// Tells the longest edge of a cell by a total order on edges: the squared length; of equals, the older edge
/// (by its younger end, then by the other: fewer splits led to it), then the place of the midpoint, then the
/// vertex indices. The order depends on the edge alone, not on the cell that asks or on other elements, so
/// the closure of a refinement is conforming and unique. Numbering decides only where two edges share their
/// midpoint.
class LongestEdge {
  public:
    explicit LongestEdge(const TetMesh& mesh) : mesh_(mesh), generations_(mesh.n_vertices()) {}

    /// Local number of a cell's longest edge.
    int of(CellHandle c) const;
    /// The same of both children of a cell that has been split at a vertex m: of `c`, which keeps the end a
    /// and has m at the local vertex `at_m`, and of its other child, which has m at `at_a` instead. Cheaper
    /// than to ask for each.
    std::array<int, 2> of_children(CellHandle c, CellHandle other, int at_a, int at_m) const;

    /// Vertices from `first` on have been born, each between two older ones.
    void add(std::uint32_t first, std::span<const std::array<std::uint32_t, 2>> parents);

  private:
    bool wins_tie(CellHandle c, int edge, int against) const;
    int longest(CellHandle c, const std::array<double, 6>& squared_lengths) const;

    const TetMesh& mesh_;
    std::vector<std::uint16_t>
        generations_;  ///< by vertex: 0 in the first mesh, else one more than its parents'
};

inline double squared_length(const volmesh::Point& a, const volmesh::Point& b) {
    const double x = a.x() - b.x(), y = a.y() - b.y(), z = a.z() - b.z();
    return x * x + y * y + z * z;
}

}  // namespace maille::refine
