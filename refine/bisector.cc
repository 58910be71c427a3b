#include "refine/bisector.hh"

#include <algorithm>
#include <tuple>

namespace maille::refine {
namespace {

using volmesh::Point;
namespace tet = volmesh::tet;

double squared_length(const Point& a, const Point& b) {
    const double x = a.x() - b.x(), y = a.y() - b.y(), z = a.z() - b.z();
    return x * x + y * y + z * z;
}

}  // namespace

/// What decides between edges of the same length.
auto Bisector::tie_breaker(CellHandle c, int edge) const {
    const VertexHandle a = mesh_.cell_vertex(c, tet::edge_vertices[edge][0]);
    const VertexHandle b = mesh_.cell_vertex(c, tet::edge_vertices[edge][1]);
    const Point& p = mesh_.point(a);
    const Point& q = mesh_.point(b);
    const int age = -std::max(generation_[a.idx()], generation_[b.idx()]);
    return std::tuple(age, p.x() + q.x(), p.y() + q.y(), p.z() + q.z(), std::min(a, b), std::max(a, b));
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
        state_[i] = static_cast<std::uint8_t>(find_longest(CellHandle(i)));
    }
    first_new_ = mesh.n_cells();
}

double Bisector::longest_squared(CellHandle c) const {
    const auto [i, j] = tet::edge_vertices[longest(c)];
    return squared_length(mesh_.point(mesh_.cell_vertex(c, i)), mesh_.point(mesh_.cell_vertex(c, j)));
}

void Bisector::refresh(std::span<const CellHandle> cells) {
    for (const CellHandle c : cells)
        state_[c.idx()] = static_cast<std::uint8_t>((state_[c.idx()] & born_bit) | find_longest(c));
}

void Bisector::begin_pass() {
    for (const CellHandle c : reborn_) state_[c.idx()] &= edge_mask;
    for (std::uint32_t i = first_new_; i < mesh_.n_cells(); ++i) state_[i] &= edge_mask;
    reborn_.clear();
    first_new_ = mesh_.n_cells();
}

std::vector<CellHandle> Bisector::born() const {
    std::vector<CellHandle> cells = reborn_;
    std::ranges::sort(cells);
    for (std::uint32_t i = first_new_; i < mesh_.n_cells(); ++i) cells.emplace_back(i);
    return cells;
}

void Bisector::bisect(CellHandle c) {
    if (!is_born(c)) split(c, mesh_.cells_around(c, longest(c)));
}

void Bisector::bisect_conforming(CellHandle c) {
    if (is_born(c)) return;
    // Each cell of the path has a strictly longer edge than the one before it, so none is split before its turn.
    path_.assign(1, c);
    while (!path_.empty()) {
        const CellHandle last = path_.back();
        const auto [i, j] = tet::edge_vertices[longest(last)];
        const CellList ring = mesh_.cells_around(last, longest(last));
        const CellHandle obstacle = in_the_way(ring, mesh_.cell_vertex(last, i), mesh_.cell_vertex(last, j));
        if (obstacle.is_valid()) {
            path_.push_back(obstacle);
        } else {
            split(last, ring);
            path_.pop_back();
        }
    }
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

void Bisector::split(CellHandle c, const CellList& ring) {
    const auto [i, j] = tet::edge_vertices[longest(c)];
    const std::uint32_t a = mesh_.cell_vertex(c, i).idx(), b = mesh_.cell_vertex(c, j).idx();
    lineage_.vertex_parents.push_back({a, b});
    generation_.push_back(static_cast<std::uint16_t>(std::max(generation_[a], generation_[b]) + 1));
    const std::uint32_t first_child = mesh_.n_cells();
    mesh_.split_edge(c, longest(c), 0.5, ring);
    for (const CellHandle kept : ring) {
        if (kept.idx() < first_new_ && !is_born(kept)) reborn_.push_back(kept);
        state_[kept.idx()] = static_cast<std::uint8_t>(born_bit | find_longest(kept));
    }
    for (std::uint32_t k = 0; k < ring.size(); ++k) {
        state_.push_back(static_cast<std::uint8_t>(born_bit | find_longest(CellHandle(first_child + k))));
        lineage_.cell_ancestors.push_back(lineage_.cell_ancestors[ring[k].idx()]);
    }
}

}  // namespace maille::refine
