#include "quality/mean_flips.hh"

#include <algorithm>
#include <limits>
#include <optional>

#include "quality/candidates.hh"
#include "volmesh/edge_removal.hh"
#include "volmesh/strata.hh"

namespace maille::quality {
namespace {

using volmesh::CellHandle;
using volmesh::EdgeRing;
using volmesh::RingTriangle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

constexpr std::size_t max_ring = 7;
/// A removal must raise the sum by this much.
constexpr double least_gain = 1e-3;

std::pair<double, std::uint32_t> order(const std::vector<Shape>& shapes, CellHandle c) {
    return {shapes[c.idx()].beta, c.idx()};
}

/// The faces beyond which a worse cell or nothing is, as bits.
unsigned worse_neighbors(const TetMesh& mesh, const std::vector<Shape>& shapes, CellHandle c) {
    unsigned bits = 0;
    for (int f = 0; f < 4; ++f) {
        const auto beyond = mesh.opposite_halfface_handle(TetMesh::halfface(c, f));
        if (!beyond.is_valid() || order(shapes, TetMesh::incident_cell(beyond)) < order(shapes, c))
            bits |= 1U << f;
    }
    return bits;
}

/// The cells round an edge inside a region, if it may be removed, they aren't too many and none is worse than
/// the one given: so that each edge is looked at from one cell only.
std::optional<EdgeRing> ring_of_worst(const TetMesh& mesh, const std::vector<Shape>& shapes, CellHandle worst,
                                      int edge) {
    if (mesh.combination(worst, edge) != 0) return std::nullopt;
    const auto [i, j] = volmesh::tet::edge_vertices[edge];
    auto [k, l] = volmesh::tet::edge_vertices[volmesh::tet::opposite_edge(edge)];
    // Of the edges 01 02 03 12 13 23, those that with their opposites are odd permutations.
    if (edge == 1 || edge == 4) std::swap(k, l);
    EdgeRing ring{mesh.cell_vertex(worst, i), mesh.cell_vertex(worst, j), {}, {}};
    CellHandle cell = worst;
    int behind = k;
    int ahead = l;
    do {
        ring.cells.push_back(cell);
        ring.vertices.push_back(mesh.cell_vertex(cell, behind));
        const VertexHandle next = mesh.cell_vertex(cell, ahead);
        const auto wall = mesh.opposite_halfface_handle(TetMesh::halfface(cell, behind));
        if (!wall.is_valid() || ring.cells.size() > max_ring) return std::nullopt;
        cell = TetMesh::incident_cell(wall);
        if (order(shapes, cell) < order(shapes, worst)) return std::nullopt;
        ahead = TetMesh::local_face(wall);
        behind = mesh.local_vertex(cell, next);
    } while (cell != worst);
    if (ring.size() < 3) return std::nullopt;
    return ring;
}

bool is_in_one_region(const TetMesh& mesh, const EdgeRing& ring) {
    return interface_places(mesh, ring).empty();
}

/// The filling of a ring that has the greatest sum of beta - mean (G. T. Klincsek, "Minimal triangulations of
/// polygonal domains", 1980).
class BestFilling {
  public:
    BestFilling(const TetMesh& mesh, const EdgeRing& ring, const std::vector<Shape>& shapes, double mean)
        : a_(mesh.point(ring.a)), b_(mesh.point(ring.b)), mean_(mean) {
        for (const CellHandle c : ring.cells) {
            before_ += shapes[c.idx()].beta - mean;
            floor_ = std::min(floor_, shapes[c.idx()].objective);
        }
        const std::size_t n = ring.size();
        for (std::size_t i = 0; i < n; ++i) points_[i] = mesh.point(ring.vertices[i]);
        for (std::size_t i = 0; i + 1 < n; ++i) parts_[i][i + 1] = {0, 0};
        for (std::size_t width = 2; width < n; ++width)
            for (std::size_t i = 0; i + width < n; ++i) fill(i, i + width);
        gain_ = parts_[0][n - 1].sum - before_;
    }

    /// -infinity where every filling has a cell that is too bad.
    double gain() const { return gain_; }
    void append_triangles(std::size_t i, std::size_t j, std::vector<RingTriangle>& triangles) const {
        if (i + 1 == j) return;
        const std::size_t k = parts_[i][j].middle;
        triangles.push_back(
            {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(j)});
        append_triangles(i, k, triangles);
        append_triangles(k, j, triangles);
    }

  private:
    struct Part {
        double sum = -std::numeric_limits<double>::infinity();
        std::size_t middle = 0;
    };

    void fill(std::size_t i, std::size_t j) {
        Part& part = parts_[i][j];
        for (std::size_t k = i + 1; k < j; ++k) {
            const double rest = parts_[i][k].sum + parts_[k][j].sum;
            const double most = 2 * (1 - mean_);
            if (!(rest + most > part.sum)) continue;
            const Shape one = shape(a_, points_[i], points_[k], points_[j]);
            if (!(one.objective > floor_)) continue;
            const Shape other = shape(points_[i], points_[k], points_[j], b_);
            if (!(other.objective > floor_)) continue;
            const double sum = rest + one.beta + other.beta - 2 * mean_;
            if (sum > part.sum) part = {sum, k};
        }
    }

    Point a_, b_;
    double mean_;
    double floor_ = std::numeric_limits<double>::infinity();
    double before_ = 0;
    double gain_;
    std::array<Point, max_ring> points_;
    std::array<std::array<Part, max_ring>, max_ring> parts_;
};

/// An edge whose removal seems worth while.
struct Candidate {
    double gain;
    CellHandle cell;
    int edge;

    auto order() const { return std::tuple(-gain, cell.idx(), edge); }
};

std::vector<Candidate> candidates(const TetMesh& mesh, const std::vector<Shape>& shapes, double mean) {
    return sorted_candidates<Candidate>(mesh.n_cells(), [&](std::uint32_t i, std::vector<Candidate>& found) {
        const CellHandle c(i);
        if (!(shapes[i].beta < mean) || mesh.is_deleted(c)) return;
        const unsigned worse = worse_neighbors(mesh, shapes, c);
        for (int e = 0; e < 6; ++e) {
            const auto [k, l] = volmesh::tet::edge_vertices[volmesh::tet::opposite_edge(e)];
            if ((worse >> k & 1) != 0 || (worse >> l & 1) != 0) continue;
            const auto ring = ring_of_worst(mesh, shapes, c, e);
            if (!ring || !is_in_one_region(mesh, *ring)) continue;
            const double gain = BestFilling(mesh, *ring, shapes, mean).gain();
            if (gain > least_gain) found.push_back({gain, c, e});
        }
    });
}

bool keeps_size(const TetMesh& mesh, const EdgeRing& ring, const std::vector<RingTriangle>& triangles,
                const SizeLimit& limit) {
    if (!limit.exists()) return true;
    double before = 1;
    double after = 1;
    for (const CellHandle c : ring.cells) before = std::max(before, limit.excess(mesh.cell_points(c)));
    for (const RingTriangle& t : triangles)
        for (const VertexHandle end : {ring.a, ring.b})
            after = std::max(
                after, limit.excess({mesh.point(end), mesh.point(ring.vertices[t[0]]),
                                     mesh.point(ring.vertices[t[1]]), mesh.point(ring.vertices[t[2]])}));
    return after <= before;
}

}  // namespace

std::size_t flip_for_mean(TetMesh& mesh, std::vector<Shape>& shapes, double mean, const SizeLimit& limit) {
    const auto measure = [&](CellHandle c) {
        const auto p = mesh.cell_points(c);
        shapes[c.idx()] = mesh.is_deleted(c) ? perfect_shape : shape(p[0], p[1], p[2], p[3]);
    };
    std::size_t n_removed = 0;
    std::vector<RingTriangle> triangles;
    for (const Candidate& candidate : candidates(mesh, shapes, mean)) {
        // What was there may have changed since, and is looked at anew.
        if (mesh.is_deleted(candidate.cell)) continue;
        const auto ring = ring_of_worst(mesh, shapes, candidate.cell, candidate.edge);
        if (!ring || !is_in_one_region(mesh, *ring)) continue;
        const BestFilling filling(mesh, *ring, shapes, mean);
        if (!(filling.gain() > least_gain)) continue;
        triangles.clear();
        filling.append_triangles(0, ring->size() - 1, triangles);
        if (!keeps_size(mesh, *ring, triangles, limit) ||
            !volmesh::is_edge_removal_ok(mesh, *ring, triangles))
            continue;
        const std::uint32_t first_new = mesh.n_cells();
        volmesh::remove_edge(mesh, *ring, triangles);
        ++n_removed;
        shapes.resize(mesh.n_cells());
        std::ranges::for_each(ring->cells, measure);
        for (std::uint32_t i = first_new; i < mesh.n_cells(); ++i) measure(CellHandle(i));
    }
    return n_removed;
}

}  // namespace maille::quality
