#pragma once

#include <cstddef>
#include <vector>

#include "quality/objective.hh"
#include "quality/size_limit.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::quality {

/// Moves each vertex that may go anywhere (free_vertices) up the slope of the sum of beta over its cells,
/// where that raises the sum and leaves none of them with an objective at or below the least they had.
/// `shapes` are those of all cells, and stay so. Vertices that share no cell are moved at the same time; the
/// result does not depend on the number of threads. Returns the number of moves.
std::size_t move_for_mean(volmesh::TetMesh& mesh, std::vector<Shape>& shapes, const SizeLimit& limit,
                          const std::vector<std::uint8_t>& is_free);

}  // namespace maille::quality
