#pragma once

#include "quality/improve.hh"
#include "refine/refine.hh"
#include "tools/maille/progress.hh"
#include "tools/maille/summary.hh"
#include "volmesh/projector.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::tools {

/// Betters a mesh as `quality::improve` does, and notes what was done and the time it took. No element comes
/// to be longer than `ratio` times the size, if one is given.
void improve_with_progress(volmesh::TetMesh& mesh, const refine::SizeField* size, double ratio,
                           const volmesh::Projector* projector, Progress& progress, Summary& summary);

/// Betters a mesh that has been refined to this size with these options.
void improve_refined(volmesh::TetMesh& mesh, const refine::SizeField& size,
                     const refine::RefineOptions& options, const volmesh::Projector* projector,
                     Progress& progress, Summary& summary);

}  // namespace maille::tools
