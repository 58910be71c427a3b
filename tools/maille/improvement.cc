#include "tools/maille/improvement.hh"

#include <fmt/format.h>

namespace maille::tools {

void improve_with_progress(volmesh::TetMesh& mesh, const refine::SizeField* size, double ratio,
                           const volmesh::Projector* projector, Progress& progress, Summary& summary) {
    quality::ImproveOptions options;
    options.ratio = ratio;
    quality::WantedSize wanted;
    if (size) {
        wanted = *size;
        options.size = &wanted;
    }
    const quality::ImproveResult result = quality::improve(mesh, options, projector);
    progress.note(fmt::format("improved by {} edits, the worst element from {:.3f} to {:.3f}{}",
                              result.edits(), result.worst_before, result.worst_after,
                              result.is_cut_short ? "; ended early: too many elements are bad" : ""));
    summary.edits += result.edits();
    summary.clock.end(Phase::improve);
}

void improve_refined(volmesh::TetMesh& mesh, const refine::SizeField& size,
                     const refine::RefineOptions& options, const volmesh::Projector* projector,
                     Progress& progress, Summary& summary) {
    const refine::SizeField wanted =
        options.gradation > 0 ? refine::limit_growth(size, mesh, options.gradation) : size;
    improve_with_progress(mesh, &wanted, options.ratio, options.project ? projector : nullptr, progress,
                          summary);
}

}  // namespace maille::tools
