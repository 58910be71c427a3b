#include "quality/mean_collapses.hh"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <tuple>

#include "quality/candidates.hh"
#include "quality/collapse_trial.hh"
#include "volmesh/cell_table.hh"
#include "volmesh/collapse.hh"

namespace maille::quality {
namespace {

using volmesh::CellHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;
using Cells = std::span<const CellHandle>;

/// A collapse must raise the sum by this much.
constexpr double least_gain = 1e-3;

struct Candidate {
    double gain;
    VertexHandle gone, heir;

    auto order() const { return std::tuple(-gain, gone, heir); }
};

boost::container::small_vector<VertexHandle, 32> neighbors(const TetMesh& mesh, VertexHandle v, Cells cells) {
    boost::container::small_vector<VertexHandle, 32> found;
    for (const CellHandle c : cells)
        for (const VertexHandle w : mesh.cell_vertices(c))
            if (w != v && std::ranges::find(found, w) == found.end()) found.push_back(w);
    return found;
}

/// The neighbour with which a vertex is best made one, `cells` being those at the vertex.
std::optional<Candidate> best_collapse(const TetMesh& mesh, const std::vector<Shape>& shapes, double mean,
                                       const SizeLimit& limit, VertexHandle v, Cells cells) {
    double before = 0;
    double floor = std::numeric_limits<double>::infinity();
    for (const CellHandle c : cells) {
        before += shapes[c.idx()].beta - mean;
        floor = std::min(floor, shapes[c.idx()].objective);
    }
    if (!(before < 0)) return std::nullopt;
    const CollapseTrial trial(mesh, v, cells, limit);
    Candidate best{least_gain, v, {}};
    for (const VertexHandle heir : neighbors(mesh, v, cells)) {
        const auto after = trial.outcome(heir, floor);
        if (!after) continue;
        const double gain = after->beta_sum - static_cast<double>(after->n_cells) * mean - before;
        if (gain > best.gain && volmesh::is_collapse_ok(mesh, v, heir)) best = {gain, v, heir};
    }
    if (!best.heir.is_valid()) return std::nullopt;
    return best;
}

std::vector<Candidate> candidates(const TetMesh& mesh, const std::vector<Shape>& shapes, double mean,
                                  const SizeLimit& limit, const std::vector<std::uint8_t>& is_free) {
    const auto cells_of = volmesh::vertex_cells(mesh);
    return sorted_candidates<Candidate>(
        mesh.n_vertices(), [&](std::uint32_t i, std::vector<Candidate>& found) {
            const VertexHandle v(i);
            if (is_free[i] == 0 || mesh.is_deleted(v)) return;
            if (const auto best = best_collapse(mesh, shapes, mean, limit, v, cells_of[v]))
                found.push_back(*best);
        });
}

}  // namespace

std::size_t collapse_for_mean(TetMesh& mesh, std::vector<Shape>& shapes, double mean, const SizeLimit& limit,
                              const std::vector<std::uint8_t>& is_free) {
    std::size_t n_collapses = 0;
    for (const Candidate& candidate : candidates(mesh, shapes, mean, limit, is_free)) {
        // What was there may have changed since, and is looked at anew.
        if (mesh.is_deleted(candidate.gone)) continue;
        const volmesh::CellList cells = mesh.vc_range(candidate.gone);
        const auto best =
            best_collapse(mesh, shapes, mean, limit, candidate.gone, {cells.data(), cells.size()});
        if (!best) continue;
        volmesh::collapse_edge(mesh, best->gone, best->heir);
        ++n_collapses;
        for (const CellHandle c : cells) {
            const auto p = mesh.cell_points(c);
            shapes[c.idx()] = mesh.is_deleted(c) ? perfect_shape : shape(p[0], p[1], p[2], p[3]);
        }
    }
    return n_collapses;
}

}  // namespace maille::quality
