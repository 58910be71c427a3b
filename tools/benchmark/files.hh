#pragma once

#include "tools/benchmark/start_mesh.hh"

namespace maille::benchmark {

/// Writes the mesh, with some sets, in the fast formats and reads it again; prints how long both take beside
/// a copy of the same bytes. The files are in the folder for temporary ones.
void measure_files(const CellSoup& soup, int repeats);

}  // namespace maille::benchmark
