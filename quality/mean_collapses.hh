#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "quality/objective.hh"
#include "quality/size_limit.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::quality {

/// Lets vertices that may go anywhere (free_vertices) become one with a neighbour where that raises the sum
/// of beta - `mean` over the cells there, and leaves none of these with an objective at or below the least
/// they had, nor with longer edges. Only vertices whose cells have less than the mean are looked at. `shapes`
/// are those of all cells (perfect where these are deleted), and stay so. Edges are looked for by many
/// threads and collapsed by one, the most gain first; the result does not depend on the number of threads.
/// Returns the number of collapses.
///
/// Bisection to a size leaves vertices that its closure alone asked for: many good cells become of them.
std::size_t collapse_for_mean(volmesh::TetMesh& mesh, std::vector<Shape>& shapes, double mean,
                              const SizeLimit& limit, const std::vector<std::uint8_t>& is_free);

}  // namespace maille::quality
