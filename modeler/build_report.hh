#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "quality/projection_result.hh"

namespace maille::modeler {

/// What a phase took.
struct PhaseTime {
    double cpu_seconds = 0;   ///< of all threads and of the processes that they ran
    double wall_seconds = 0;  ///< by the clock
};

/// What building or merging tells besides the mesh.
struct BuildReport {
    PhaseTime primitives;              ///< meshing each primitive by itself
    PhaseTime merge;                   ///< from there to the mesh of the model
    std::size_t kept_cells = 0;        ///< as the primitives had them
    std::size_t new_cells = 0;         ///< made between them
    std::size_t moved_primitives = 0;  ///< of which the mesh is another primitive's, moved
    /// Vertices that still had to be brought onto the true surfaces when all was meshed; those that could not
    /// be are named. Of models only.
    quality::ProjectionResult projection;
    std::vector<std::string> warnings;  ///< what failed and was done in another way
};

}  // namespace maille::modeler
