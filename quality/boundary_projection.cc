#include "quality/boundary_projection.hh"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "quality/relocate.hh"
#include "volmesh/error.hh"

namespace maille::quality {
namespace {

bool is_inside(const TetMesh& mesh, CellHandle c, int edge) {
    return std::ranges::none_of(mesh.halffaces_around(c, edge),
                                [&](const auto hf) { return mesh.is_boundary(hf); });
}

int edge_to_split(const TetMesh& mesh, CellHandle c) {
    const auto p = mesh.cell_points(c);
    int best = 0;
    std::pair<bool, double> best_rank{false, -1};
    for (int edge = 0; edge < 6; ++edge) {
        const auto [i, j] = volmesh::tet::edge_vertices[edge];
        const bool binds = is_inside(mesh, c, edge) && mesh.is_boundary(mesh.cell_vertex(c, i)) &&
                           mesh.is_boundary(mesh.cell_vertex(c, j));
        const std::pair<bool, double> rank{binds, (p[i] - p[j]).squaredNorm()};
        if (rank > best_rank) std::tie(best, best_rank) = std::pair(edge, rank);
    }
    return best;
}

}  // namespace

void require_min_shape(double min_shape) {
    if (!(min_shape > 0 && min_shape <= 1))
        throw InputError(fmt::format("the least shape must be above 0 and at most 1, not {}", min_shape));
}

ShortOfTarget short_of_target(const TetMesh& mesh, const volmesh::Projector& projector,
                              const VertexSupport& support) {
    ShortOfTarget left{support.vertex, mesh.point(support.vertex), {}, {}};
    const auto distance = [&](std::span<const std::uint32_t> surfaces) -> std::optional<double> {
        const auto target = projector.project(surfaces, left.place);
        return target && target->allFinite() ? std::optional((*target - left.place).norm()) : std::nullopt;
    };
    for (const std::uint32_t& surface : support.surfaces) {
        left.surfaces.push_back(projector.surfaces[surface]);
        left.off = std::max(left.off, distance({&surface, 1}).value_or(0));
    }
    left.distance = distance({support.surfaces.data(), support.surfaces.size()});
    return left;
}

BoundaryProjection::BoundaryProjection(TetMesh& mesh, const volmesh::Projector& projector, double min_shape)
    : mesh_(mesh),
      projector_(projector),
      surfaces_of_(mesh, &projector),
      min_shape_(min_shape),
      good_shape_(std::max(min_shape, 0.05)),
      tolerance_(1e-12 * projector.model_size) {}

void BoundaryProjection::take_up(std::uint32_t first, std::span<const CellHandle> cells) {
    take_up(supports_from(mesh_, surfaces_of_, first, cells));
}

void BoundaryProjection::take_up(std::span<const VertexSupport> supports) {
    for (const VertexSupport& support : supports) waiting_.push_back({support, Point::Zero()});
}

std::vector<CellHandle> BoundaryProjection::run() {
    find_targets();
    constexpr int max_sweeps = 3;  // a vertex may wait for a neighbour that is moved after it
    for (int i = 0; i < max_sweeps && sweep(good_shape_); ++i) {
    }
    return take_changed();
}

std::vector<CellHandle> BoundaryProjection::insist() {
    constexpr int patience = 5;  // sweeps in which no vertex arrives
    for (const double least_shape : {good_shape_, std::sqrt(good_shape_ * min_shape_), min_shape_}) {
        std::size_t fewest = waiting_.size();
        for (int failed = 0; failed < patience && sweep(least_shape); ++failed) {
            if (waiting_.size() >= fewest) continue;
            fewest = waiting_.size();
            failed = 0;
        }
    }
    return take_changed();
}

/// The point nearest to each waiting vertex on all its surfaces; those that are there already wait no more.
void BoundaryProjection::find_targets() {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, waiting_.size(), 64), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            Waiting& waiting = waiting_[i];
            const auto target = projector_.project({waiting.surfaces.data(), waiting.surfaces.size()},
                                                   mesh_.point(waiting.vertex));
            waiting.has_target = target && target->allFinite();
            if (waiting.has_target) waiting.target = *target;
        }
    });
    std::erase_if(waiting_, [&](const Waiting& waiting) {
        return waiting.has_target && (mesh_.point(waiting.vertex) - waiting.target).norm() <= tolerance_;
    });
}

/// Lets each waiting vertex go as far as it can; returns whether any moved and some still wait.
bool BoundaryProjection::sweep(double least_shape) {
    bool has_moved = false;
    std::erase_if(waiting_, [&](Waiting& waiting) {
        if (!waiting.has_target) return false;
        const Point before = mesh_.point(waiting.vertex);
        const bool has_arrived = approach(waiting, least_shape);
        if (!has_arrived && make_room(waiting)) has_moved = true;
        has_moved |= mesh_.point(waiting.vertex) != before;
        return has_arrived;
    });
    return has_moved && !waiting_.empty();
}

/// Moves the vertex to its target or, while cells would break, half as far again and again; returns whether
/// it is there.
bool BoundaryProjection::approach(Waiting& waiting, double least_shape) {
    const CellList cells = mesh_.vc_range(waiting.vertex);
    const Point from = mesh_.point(waiting.vertex);
    const double allowed = std::min(least_shape, worst_shape(mesh_, cells, waiting.vertex, from));
    constexpr double least_step = 1.0 / 64;
    for (double part = 1; part >= least_step; part /= 2) {
        const Point at = part == 1 ? waiting.target : Point(from + part * (waiting.target - from));
        const double worst = worst_shape(mesh_, cells, waiting.vertex, at);
        if (worst <= 0 || worst < allowed) continue;
        move(waiting.vertex, at);
        if (!waiting.has_moved) ++n_moved_;
        waiting.has_moved = true;
        return part == 1;
    }
    return false;
}

/// Moves the free vertices round a waiting one out of its way, or to the middle of their cells, where the
/// worst of their cells is better; returns whether any moved.
bool BoundaryProjection::make_room(const Waiting& waiting) {
    const Point way = waiting.target - mesh_.point(waiting.vertex);
    bool has_moved = false;
    for (const VertexHandle v : mesh_.vv_range(waiting.vertex)) {
        if (v.idx() < n_held_) continue;
        const CellList cells = mesh_.vc_range(v);
        if (!is_free(mesh_, v, cells)) continue;
        const Point targets[] = {polyhedron_centroid(mesh_, cells), mesh_.point(v) + way};
        if (!relocate(mesh_, v, cells, targets)) continue;
        has_moved = true;
        changed_.insert(changed_.end(), cells.begin(), cells.end());
    }
    return has_moved;
}

void BoundaryProjection::move(VertexHandle v, const Point& to) {
    mesh_.set_point(v, to);
    const CellList cells = mesh_.vc_range(v);
    changed_.insert(changed_.end(), cells.begin(), cells.end());
}

std::vector<CellHandle> BoundaryProjection::take_changed() {
    std::ranges::sort(changed_);
    const auto [repeats, end] = std::ranges::unique(changed_);
    changed_.erase(repeats, end);
    return std::exchange(changed_, {});
}

std::vector<ShortOfTarget> BoundaryProjection::short_of_target() const {
    std::vector<ShortOfTarget> all;
    for (const Waiting& waiting : waiting_)
        all.push_back(quality::short_of_target(mesh_, projector_, waiting));
    std::ranges::sort(all, {}, &ShortOfTarget::vertex);
    return all;
}

std::vector<CellEdge> BoundaryProjection::blocking_edges() const {
    std::map<CellHandle, int> edges;
    for (const Waiting& waiting : waiting_) {
        if (!waiting.has_target) continue;
        for (const CellHandle c : mesh_.vc_range(waiting.vertex))
            if (worst_shape(mesh_, CellList{c}, waiting.vertex, waiting.target) < good_shape_)
                edges.emplace(c, edge_to_split(mesh_, c));
    }
    std::vector<CellEdge> found;
    for (const auto& [cell, edge] : edges) found.push_back({cell, edge});
    return found;
}

}  // namespace maille::quality
