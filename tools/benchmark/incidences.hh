#pragma once

#include "tools/benchmark/start_mesh.hh"

namespace maille::benchmark {

/// Builds the mesh and goes through every incidence; prints a column of the table of mesh data structures.
void measure_incidences(const CellSoup& soup, int repeats);

}  // namespace maille::benchmark
