#include <algorithm>

#include "quality/collapse_trial.hh"
#include "quality/improver.hh"
#include "quality/smooth.hh"
#include "volmesh/collapse.hh"
#include "volmesh/strata.hh"

namespace maille::quality {
namespace {

using volmesh::TetMesh;

constexpr double least_gain = 1e-3;

}  // namespace

std::optional<Improver::Collapse> Improver::collapse_of(VertexHandle gone, VertexHandle heir, double floor) {
    const CellList cells = mesh_.vc_range(gone);
    const Freedom& bound = freedom(gone, cells);
    if (bound.is_fixed) return std::nullopt;
    floor = std::max(floor, quality(cells) + least_gain);
    const Point& to = mesh_.point(heir);
    const auto outcome =
        CollapseTrial(mesh_, gone, {cells.data(), cells.size()}, limit_).outcome(heir, floor);
    if (!outcome) return std::nullopt;
    double tolerance = 1e-10 * (to - mesh_.point(gone)).norm();
    if (!bound.surfaces.empty()) {
        const SurfacePieces pieces(mesh_, gone, cells, surfaces_of_);
        const double before = pieces.error(mesh_.point(gone), *projector_);
        const double after = pieces.error(to, *projector_, heir);
        if (after > before + 1e-12 * projector_->model_size) return std::nullopt;
        tolerance = std::numeric_limits<double>::infinity();
    }
    if (!volmesh::is_collapse_ok(mesh_, gone, heir, tolerance)) return std::nullopt;
    return Collapse{gone, heir, outcome->least_objective};
}

bool Improver::collapse(CellHandle c) {
    std::optional<Collapse> best;
    const auto v = mesh_.cell_vertices(c);
    double floor = shapes_[c.idx()].objective + least_gain;
    for (const auto& [i, j] : volmesh::tet::edge_vertices)
        for (const auto& [gone, heir] : {std::pair(v[i], v[j]), std::pair(v[j], v[i])})
            if (auto found = collapse_of(gone, heir, floor)) {
                floor = found->quality;
                best = found;
            }
    if (!best) return false;
    const CellList cells = mesh_.vc_range(best->gone);
    const std::uint32_t n_before = mesh_.n_cells();
    volmesh::collapse_edge(mesh_, best->gone, best->heir);
    ++result_.collapses;
    settle(cells, n_before);
    return true;
}

bool Improver::split(CellHandle c) {
    // Its longest edge first.
    std::array<std::pair<double, int>, 6> edges;
    const auto p = mesh_.cell_points(c);
    for (int e = 0; e < 6; ++e) {
        const auto [i, j] = volmesh::tet::edge_vertices[e];
        edges[e] = {-(p[i] - p[j]).squaredNorm(), e};
    }
    std::ranges::sort(edges);
    for (int k = 0; k < 3; ++k)
        if (split(c, edges[k].second)) return true;
    return false;
}

bool Improver::split(CellHandle c, int edge) {
    if (volmesh::stratum(mesh_, c, edge) != 3) return false;
    const auto [i, j] = volmesh::tet::edge_vertices[edge];
    const VertexHandle a = mesh_.cell_vertex(c, i);
    const VertexHandle b = mesh_.cell_vertex(c, j);
    const CellList ring = mesh_.cells_around(c, edge);
    Bases bases;
    double shortest = std::numeric_limits<double>::infinity();
    for (CellHandle cell : ring) {
        for (VertexHandle end : {a, b}) {
            const auto face = mesh_.halfface_vertices(TetMesh::halfface(cell, mesh_.local_vertex(cell, end)));
            bases.push_back({mesh_.point(face[0]), mesh_.point(face[1]), mesh_.point(face[2])});
        }
        for (VertexHandle v : mesh_.cell_vertices(cell))
            for (VertexHandle w : mesh_.cell_vertices(cell))
                if (v < w) shortest = std::min(shortest, (mesh_.point(v) - mesh_.point(w)).norm());
    }
    // Not much shorter edges than there are.
    const auto is_allowed = [&](const Point& p) {
        for (const Base& base : bases)
            for (const Point& q : base)
                if ((p - q).norm() < 0.6 * shortest) return false;
        return true;
    };
    const double floor = quality(ring) + least_gain;
    const Point middle = (mesh_.point(a) + mesh_.point(b)) / 2;
    const Freedom free;
    const auto better = better_place(bases, middle, Constraint(free, middle, nullptr), is_allowed);
    const Point place = better.value_or(middle);
    if (!(least_objective(place, bases, floor) > floor) || !is_allowed(place)) return false;
    const std::uint32_t n_before = mesh_.n_cells();
    const VertexHandle m = mesh_.split_edge(c, edge, 0.5, ring);
    mesh_.set_point(m, place);
    ++result_.splits;
    settle(ring, n_before);
    return true;
}

}  // namespace maille::quality
