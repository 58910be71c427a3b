#pragma once

#include <array>
#include <utility>
#include <vector>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// Whether the insides of two tetrahedra, neither of them flat, have a point in common. Exact.
bool overlap(const std::array<Point, 4>& a, const std::array<Point, 4>& b);

/// The pairs of cells that overlap, the lower index first, in ascending order, wherever in the mesh they are;
/// at most so many. No cell may be flat. Cost: n log n and a test for each two cells whose
/// boxes meet, some microseconds each.
std::vector<std::pair<CellHandle, CellHandle>> find_overlaps(const TetMesh& mesh, std::size_t most = 20);

}  // namespace maille::volmesh
