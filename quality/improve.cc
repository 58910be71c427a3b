#include "quality/improve.hh"

#include "quality/improver.hh"

namespace maille::quality {

ImproveResult improve(volmesh::TetMesh& mesh, const ImproveOptions& options,
                      const volmesh::Projector* projector) {
    Improver improver(mesh, options, projector);
    for (int sweep = 0; sweep < options.mean_sweeps; ++sweep) improver.raise_mean();
    bool all_moves = false;
    for (int pass = 0; pass < options.max_passes; ++pass) {
        const std::size_t n_moves = improver.pass(all_moves);
        // Vertices come and go only where nothing else helps; then the rest is tried again.
        if (n_moves == 0 && all_moves) break;
        all_moves = !all_moves && pass > 0;
    }
    ImproveResult result = improver.result();
    result.worst_after = improver.worst();
    if (mesh.has_deleted()) mesh.garbage_collection();
    return result;
}

}  // namespace maille::quality
