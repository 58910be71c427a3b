#include "refine/bisector.hh"

#include <algorithm>
#include <tuple>
#include <utility>

#include "volmesh/orientation.hh"

namespace maille::refine {
namespace {

using volmesh::Point;
namespace tet = volmesh::tet;

double squared_length(const Point& a, const Point& b) {
    const double x = a.x() - b.x(), y = a.y() - b.y(), z = a.z() - b.z();
    return x * x + y * y + z * z;
}

/// Whether both children of a cell are positively oriented when its edge a-b is split at `middle`. They are
/// but for rounding, if the cell is.
bool keeps_orientation(const TetMesh& mesh, CellHandle c, VertexHandle a, VertexHandle b,
                       const Point& middle) {
    const std::array<Point, 4> p = mesh.cell_points(c);
    for (const VertexHandle end : {a, b}) {
        std::array<Point, 4> child = p;
        child[mesh.local_vertex(c, end)] = middle;
        if (volmesh::orientation(child[0], child[1], child[2], child[3]) <= 0) return false;
    }
    return true;
}

}  // namespace

/// What decides between edges of the same length.
auto Bisector::tie_breaker(CellHandle c, int edge) const {
    const VertexHandle a = mesh_.cell_vertex(c, tet::edge_vertices[edge][0]);
    const VertexHandle b = mesh_.cell_vertex(c, tet::edge_vertices[edge][1]);
    const Point& p = mesh_.point(a);
    const Point& q = mesh_.point(b);
    const auto [older, younger] = std::minmax({generation_[a.idx()], generation_[b.idx()]});
    return std::tuple(-younger, -older, p.x() + q.x(), p.y() + q.y(), p.z() + q.z(), std::min(a, b),
                      std::max(a, b));
}

int Bisector::find_longest(CellHandle c) const {
    const std::array<Point, 4> p = mesh_.cell_points(c);
    int longest = 0;
    double length = -1;
    for (int edge = 0; edge < 6; ++edge) {
        const double other = squared_length(p[tet::edge_vertices[edge][0]], p[tet::edge_vertices[edge][1]]);
        if (other > length || (other == length && tie_breaker(c, edge) > tie_breaker(c, longest))) {
            longest = edge;
            length = other;
        }
    }
    return longest;
}

Bisector::Bisector(TetMesh& mesh) : mesh_(mesh), state_(mesh.n_cells()), generation_(mesh.n_vertices()) {
    lineage_.n_vertices_before = mesh.n_vertices();
    lineage_.cell_ancestors.resize(mesh.n_cells());
    for (std::uint32_t i = 0; i < mesh.n_cells(); ++i) {
        lineage_.cell_ancestors[i] = i;
        update(CellHandle(i), changed_bit);
    }
}

double Bisector::longest_squared(CellHandle c) const {
    const auto [i, j] = tet::edge_vertices[longest(c)];
    return squared_length(mesh_.point(mesh_.cell_vertex(c, i)), mesh_.point(mesh_.cell_vertex(c, j)));
}

/// Looks at a cell anew, and adds it to those that have changed.
void Bisector::update(CellHandle c, std::uint8_t more_bits) {
    std::uint8_t& state = state_[c.idx()];
    if ((state & changed_bit) == 0) changed_.push_back(c);
    state = static_cast<std::uint8_t>((state & ~edge_mask) | changed_bit | more_bits | find_longest(c));
}

void Bisector::refresh(std::span<const CellHandle> cells) {
    for (const CellHandle c : cells) update(c, changed_bit);
}

std::vector<CellHandle> Bisector::take_changed() {
    for (const CellHandle c : changed_) state_[c.idx()] &= edge_mask;
    return std::exchange(changed_, {});
}

bool Bisector::bisect(CellHandle c) {
    return is_born(c) || split(c, longest(c));
}

bool Bisector::split(CellHandle c, int local_edge) {
    return split(c, local_edge, mesh_.cells_around(c, local_edge));
}

bool Bisector::bisect_conforming(CellHandle c) {
    if (is_born(c)) return true;
    // Each cell of the path has a strictly longer edge than the one before it, so none is split before its
    // turn.
    path_.assign(1, c);
    while (!path_.empty()) {
        const CellHandle last = path_.back();
        const auto [i, j] = tet::edge_vertices[longest(last)];
        const CellList ring = mesh_.cells_around(last, longest(last));
        const CellHandle obstacle = in_the_way(ring, mesh_.cell_vertex(last, i), mesh_.cell_vertex(last, j));
        if (obstacle.is_valid()) {
            path_.push_back(obstacle);
        } else {
            if (!split(last, longest(last), ring)) return false;
            path_.pop_back();
        }
    }
    return true;
}

/// The first cell round the edge a-b that has a longer edge; invalid where there is none.
CellHandle Bisector::in_the_way(const CellList& ring, VertexHandle a, VertexHandle b) const {
    for (const CellHandle c : ring) {
        const auto [i, j] = tet::edge_vertices[longest(c)];
        const VertexHandle p = mesh_.cell_vertex(c, i), q = mesh_.cell_vertex(c, j);
        if (!((p == a && q == b) || (p == b && q == a))) return c;
    }
    return {};
}

bool Bisector::split(CellHandle c, int local_edge, const CellList& ring) {
    const auto [i, j] = tet::edge_vertices[local_edge];
    const VertexHandle a = mesh_.cell_vertex(c, i), b = mesh_.cell_vertex(c, j);
    const Point middle = 0.5 * mesh_.point(a) + 0.5 * mesh_.point(b);
    for (const CellHandle parent : ring)
        if (!keeps_orientation(mesh_, parent, a, b, middle)) return false;

    lineage_.vertex_parents.push_back({a.idx(), b.idx()});
    generation_.push_back(
        static_cast<std::uint16_t>(std::max(generation_[a.idx()], generation_[b.idx()]) + 1));
    const std::uint32_t first_child = mesh_.n_cells();
    mesh_.split_edge(c, local_edge, 0.5, ring);
    state_.resize(mesh_.n_cells());
    for (std::uint32_t k = 0; k < ring.size(); ++k) {
        lineage_.cell_ancestors.push_back(lineage_.cell_ancestors[ring[k].idx()]);
        update(ring[k], born_bit);
        update(CellHandle(first_child + k), born_bit);
    }
    return true;
}

}  // namespace maille::refine
