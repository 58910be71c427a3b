#pragma once

#include <cstddef>
#include <vector>

#include "quality/objective.hh"
#include "quality/size_limit.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::quality {

/// Removes edges inside regions where what takes the place of the cells round them raises the sum of
/// beta - `mean`, and leaves none of these with an objective at or below the least they had. Only edges at
/// cells with less than the mean are looked at. `shapes` are those of all cells (perfect where these are
/// deleted), and stay so. Edges are looked for by many threads and removed by one, the most gain first; the
/// result does not depend on the number of threads. Returns the number of edges removed.
std::size_t flip_for_mean(volmesh::TetMesh& mesh, std::vector<Shape>& shapes, double mean,
                          const SizeLimit& limit);

}  // namespace maille::quality
