#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace maille::refine {

/// Where the entities of a refined mesh come from, so that a solver can move its data from the mesh before.
struct Lineage {
    /// For each cell the cell of the mesh before that it lies in (up to the moves of its nodes).
    std::vector<std::uint32_t> cell_ancestors;
    /// For each new vertex, by its index less `n_vertices_before`, the ends of the edge that it was born on:
    /// an older vertex each.
    std::vector<std::array<std::uint32_t, 2>> vertex_parents;
    std::uint32_t n_vertices_before = 0;  ///< which keep their numbers
};

}  // namespace maille::refine
