#pragma once

#include <string>

#include "refine/refine.hh"
#include "tools/maille/common_options.hh"
#include "tools/maille/phase_clock.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::tools {

/// What `mesh`, `refine` and `merge` say of their work.
struct Summary {
    int iterations = 0;
    std::size_t moved = 0;            ///< vertices that were projected
    std::size_t short_of_target = 0;  ///< vertices that are not on their surfaces
    std::size_t edits = 0;            ///< of improvement: moves and changes of connectivity
    PhaseClock clock;

    /// What is short of its surfaces then is told, if new vertices were projected.
    void add(const refine::RefineResult& result, bool has_projected = true);
    void add(const quality::ProjectionResult& projection);
    /// On stdout: as JSON or, unless it is to be quiet, as text.
    void print(const volmesh::TetMesh& mesh, const std::string& path, const CommonOptions& options) const;
};

}  // namespace maille::tools
