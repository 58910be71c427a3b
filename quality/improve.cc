#include "quality/improve.hh"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "quality/improver.hh"
#include "volmesh/renumber.hh"

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

/// Whether the mesh is large and below its aim: many walks are to come, and gain more from cells that are
/// near in memory than it costs to bring them there.
bool is_worth_renumbering(const std::vector<Shape>& shapes, const ImproveOptions& options) {
    constexpr std::size_t many_cells = 50'000;
    if (!options.may_change_cells || options.mean_sweeps == 0 || shapes.size() < many_cells) return false;
    double sum = 0;
    for (const Shape& shape : shapes) sum += shape.beta;
    return sum / static_cast<double>(shapes.size()) < options.good_mean;
}

}  // namespace

ImproveResult improve(TetMesh& mesh, const ImproveOptions& options, const volmesh::Projector* projector) {
    std::vector<Shape> shapes = shapes_of(mesh);
    if (is_worth_renumbering(shapes, options)) {
        volmesh::renumber(mesh);
        shapes = shapes_of(mesh);
    }
    ImproveResult result;
    Improver improver(mesh, std::move(shapes), options, projector, result);
    result.worst_before = improver.worst();
    improver.raise_mean();
    std::size_t tries_left =
        options.base_tries + static_cast<std::size_t>(std::ceil(options.tries_per_cell * mesh.n_cells()));
    const std::size_t most_tries = (tries_left + 3) / 4;
    bool all_moves = false;
    for (int pass = 0; pass < options.max_passes && !result.is_cut_short; ++pass) {
        const auto [tries, edits] = improver.pass(all_moves, std::min(most_tries, tries_left));
        tries_left -= tries;
        result.is_cut_short = tries_left == 0;
        // Vertices come and go only where nothing else helps; then the rest is tried again.
        if (edits == 0 && all_moves && tries < most_tries) break;
        all_moves = !all_moves && pass > 0;
    }
    // They may cost some of the mean.
    if (improver.mean_beta() < options.good_mean) improver.raise_mean();
    result.worst_after = improver.worst();
    if (mesh.has_deleted()) mesh.garbage_collection();
    return result;
}

}  // namespace maille::quality
