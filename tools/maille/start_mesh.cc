#include "tools/maille/start_mesh.hh"

#include <algorithm>
#include <thread>

#include "modeler/build.hh"
#include "tools/maille/improvement.hh"
#include "tools/maille/refine_options.hh"
#include "tools/maille/short_of_target.hh"

namespace maille::tools {
namespace {

struct Range {
    double least;
    double greatest;
};

/// Of the size over the model's box, on a lattice.
Range range_of(const refine::SizeField& size, const modeler::Model& model) {
    constexpr int steps = 24;
    const Eigen::AlignedBox3d box = modeler::bounding_box(model);
    if (box.isEmpty()) return {0, 0};
    const double first = size(box.min());
    Range range{.least = first, .greatest = first};
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; j <= steps; ++j)
            for (int k = 0; k <= steps; ++k) {
                const modeler::Point part = modeler::Point(i, j, k) / steps;
                const double value = size(box.min() + part.cwiseProduct(box.sizes()));
                range.least = std::min(range.least, value);
                range.greatest = std::max(range.greatest, value);
            }
    return range;
}

volmesh::TetMesh build(const modeler::Model& model, double size, int threads, Progress& progress,
                       Summary& summary) {
    progress.step("meshing the primitives and merging them");
    modeler::BuildOptions options;
    options.size = size;
    options.threads =
        threads > 0 ? static_cast<unsigned>(threads) : std::max(1U, std::thread::hardware_concurrency());
    modeler::BuildReport report;
    volmesh::TetMesh mesh = modeler::build(model, options, &report);
    for (const std::string& warning : report.warnings) progress.warn(warning);
    warn_of_short(report.projection, progress);
    summary.add(report.projection);
    summary.clock.add(Phase::primitives, {report.primitives.cpu_seconds, report.primitives.wall_seconds});
    summary.clock.add(Phase::merge, {report.merge.cpu_seconds, report.merge.wall_seconds});
    summary.clock.skip();
    return mesh;
}

}  // namespace

volmesh::TetMesh start_mesh(const modeler::Model& model, const volmesh::Projector& projector,
                            const StartMeshOptions& options, Progress& progress, Summary& summary) {
    const auto& size = options.size;
    const Range range = size ? range_of(*size, model) : Range{0, 0};
    summary.clock.end(Phase::read);
    volmesh::TetMesh mesh = build(model, range.greatest, options.threads, progress, summary);
    const refine::RefineOptions to_size{.threads = options.threads};
    const auto improve = [&](const refine::SizeField* wanted) {
        if (options.improve)
            improve_with_progress(mesh, wanted, to_size.ratio, &projector, progress, summary);
    };
    const bool is_graded = range.least < range.greatest;
    improve(size && !is_graded ? &*size : nullptr);
    if (is_graded) {
        summary.add(refine_with_progress(mesh, *size, to_size, &projector, progress));
        summary.clock.end(Phase::refine);
        improve(&*size);
    }
    return mesh;
}

}  // namespace maille::tools
