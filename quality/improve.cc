#include "quality/improve.hh"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "quality/improver.hh"
#include "quality/mean_flips.hh"
#include "quality/mean_moves.hh"

namespace maille::quality {
namespace {

using volmesh::CellHandle;
using volmesh::TetMesh;

std::vector<Shape> shapes_of(const TetMesh& mesh) {
    std::vector<Shape> shapes(mesh.n_cells(), perfect_shape);
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, mesh.n_cells(), 4096), [&](const auto& range) {
        for (std::uint32_t i = range.begin(); i < range.end(); ++i) {
            if (mesh.is_deleted(CellHandle(i))) continue;
            const auto p = mesh.cell_points(CellHandle(i));
            shapes[i] = shape(p[0], p[1], p[2], p[3]);
        }
    });
    return shapes;
}

double worst(const std::vector<Shape>& shapes) {
    double least = 1;
    for (const Shape& shape : shapes) least = std::min(least, shape.objective);
    return least;
}

double mean_beta(const TetMesh& mesh, const std::vector<Shape>& shapes) {
    double sum = 0;
    std::size_t n = 0;
    for (std::uint32_t i = 0; i < mesh.n_cells(); ++i) {
        if (mesh.is_deleted(CellHandle(i))) continue;
        sum += shapes[i].beta;
        ++n;
    }
    return n > 0 ? sum / static_cast<double>(n) : 1;
}

void raise_mean(TetMesh& mesh, std::vector<Shape>& shapes, const ImproveOptions& options,
                ImproveResult& result) {
    constexpr double little = 0.004;
    const SizeLimit limit(options.size, options.ratio);
    double mean = mean_beta(mesh, shapes);
    for (int sweep = 0; sweep < options.mean_sweeps; ++sweep) {
        if (mean < options.good_mean && options.may_change_cells)
            result.edge_removals += flip_for_mean(mesh, shapes, mean, options.good_enough, limit);
        result.moves += move_for_mean(mesh, shapes, options.good_enough, limit);
        const double before = std::exchange(mean, mean_beta(mesh, shapes));
        if (mean >= options.good_mean || mean < before + little) break;
    }
}

}  // namespace

ImproveResult improve(TetMesh& mesh, const ImproveOptions& options, const volmesh::Projector* projector) {
    ImproveResult result;
    std::vector<Shape> shapes = shapes_of(mesh);
    result.worst_before = worst(shapes);
    raise_mean(mesh, shapes, options, result);
    Improver improver(mesh, std::move(shapes), options, projector, result);
    bool all_moves = false;
    for (int pass = 0; pass < options.max_passes; ++pass) {
        const std::size_t n_moves = improver.pass(all_moves);
        // Vertices come and go only where nothing else helps; then the rest is tried again.
        if (n_moves == 0 && all_moves) break;
        all_moves = !all_moves && pass > 0;
    }
    result.worst_after = worst(improver.shapes());
    if (mesh.has_deleted()) mesh.garbage_collection();
    return result;
}

}  // namespace maille::quality
