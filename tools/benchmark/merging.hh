#pragma once

namespace maille::benchmark {

/// Meshes a box and a cylinder through it and merges them, box minus cylinder, at four sizes from some 10^5
/// to some 3 10^6 tetrahedra; prints a row for each: the seconds of both parts of the work, and the power of
/// the number of tetrahedra with which merging grew from the row before. The best of so many runs.
void measure_merging(int repeats);

}  // namespace maille::benchmark
