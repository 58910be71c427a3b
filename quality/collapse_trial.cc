#include "quality/collapse_trial.hh"

#include <algorithm>

namespace maille::quality {
namespace {

using volmesh::CellHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

double longest_edge_squared(const std::array<Point, 4>& p) {
    double longest = 0;
    for (const auto& [i, j] : volmesh::tet::edge_vertices)
        longest = std::max(longest, (p[i] - p[j]).squaredNorm());
    return longest;
}

}  // namespace

CollapseTrial::CollapseTrial(const TetMesh& mesh, VertexHandle gone, std::span<const CellHandle> cells,
                             const SizeLimit& limit)
    : mesh_(mesh), gone_(gone), cells_(cells), limit_(limit) {
    for (const CellHandle c : cells) {
        const auto p = mesh.cell_points(c);
        longest_squared_ = std::max(longest_squared_, longest_edge_squared(p));
        if (limit.exists()) excess_ = std::max(excess_, limit.excess(p));
    }
}

std::optional<CollapseTrial::Outcome> CollapseTrial::outcome(VertexHandle heir, double floor) const {
    Outcome outcome;
    for (const CellHandle c : cells_) {
        if (mesh_.local_vertex(c, heir) >= 0) continue;
        auto p = mesh_.cell_points(c);
        p[mesh_.local_vertex(c, gone_)] = mesh_.point(heir);
        const Shape after = shape(p[0], p[1], p[2], p[3]);
        if (!(after.objective > floor) || longest_edge_squared(p) > longest_squared_) return std::nullopt;
        if (limit_.exists() && limit_.excess(p) > excess_) return std::nullopt;
        outcome.least_objective = std::min(outcome.least_objective, after.objective);
        outcome.beta_sum += after.beta;
        ++outcome.n_cells;
    }
    return outcome;
}

}  // namespace maille::quality
