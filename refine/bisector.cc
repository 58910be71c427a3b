#include "refine/bisector.hh"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

#include "volmesh/orientation.hh"

namespace maille::refine {
namespace {

using volmesh::Point;
namespace tet = volmesh::tet;

template <class Action>
void for_each_index(std::size_t n, const Action& action) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 64), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) action(i);
    });
}

/// Whether both children of a cell are positively oriented when its edge a-b is split at `middle`.
bool keeps_orientation(const TetMesh& mesh, CellHandle c, EdgeStars::Edge edge, const Point& middle) {
    const std::array<Point, 4> p = mesh.cell_points(c);
    for (const VertexHandle end : {edge.a, edge.b}) {
        std::array<Point, 4> child = p;
        child[mesh.local_vertex(c, end)] = middle;
        if (volmesh::orientation(child[0], child[1], child[2], child[3]) <= 0) return false;
    }
    return true;
}

/// Whether a cell is so thick that rounding of a midpoint can't invert a child: its volume is more than
/// 1e-5 / 6 of the cube of a length that none of its edges at vertex 0 is longer than, and its coordinates
/// are less than 1e8 times as large, so the midpoint is rounded by about 1e-8 of it.
bool is_thick(const TetMesh& mesh, CellHandle c) {
    const Point& a = mesh.point(mesh.cell_vertex(c, 0));
    const Point u = mesh.point(mesh.cell_vertex(c, 1)) - a;
    const Point v = mesh.point(mesh.cell_vertex(c, 2)) - a;
    const Point w = mesh.point(mesh.cell_vertex(c, 3)) - a;
    const double square = std::max({u.squaredNorm(), v.squaredNorm(), w.squaredNorm()});
    const double det = u.cross(v).dot(w);
    return det > 0 && det * det > 1e-10 * (square * square * square) && a.squaredNorm() < 1e16 * square;
}

}  // namespace

Bisector::Bisector(TetMesh& mesh, Ties ties) : mesh_(mesh), longest_edge_(mesh, ties) {
    state_.grow(mesh.n_cells());
    lineage_.n_vertices_before = mesh.n_vertices();
    lineage_.cell_ancestors.resize(mesh.n_cells());
    std::iota(lineage_.cell_ancestors.begin(), lineage_.cell_ancestors.end(), 0U);
    for_each_index(mesh.n_cells(), [&](std::size_t i) {
        state_[i] = static_cast<std::uint8_t>(longest_edge_.of(CellHandle(static_cast<std::uint32_t>(i))) |
                                              changed_bit);
    });
}

void Bisector::begin_pass(std::span<const CellHandle> marked) {
    if (!longest_edge_.begin_pass(marked)) return;
    for_each_index(state_.size(), [&](std::size_t i) {
        const int longest = longest_edge_.of(CellHandle(static_cast<std::uint32_t>(i)));
        state_[i] = static_cast<std::uint8_t>((state_[i] & ~edge_mask) | longest);
    });
}

double Bisector::longest_squared(CellHandle c) const {
    const auto [a, b] = longest_edge(c);
    return squared_length(mesh_.point(a), mesh_.point(b));
}

void Bisector::refresh(std::span<const CellHandle> cells) {
    for (const CellHandle c : cells) {
        std::uint8_t& state = state_[c.idx()];
        if ((state & changed_bit) == 0) log_.push_back(c);
        state = static_cast<std::uint8_t>((state & born_bit) | changed_bit | longest_edge_.of(c));
    }
}

std::vector<CellHandle> Bisector::changed() const {
    std::vector<CellHandle> cells;
    cells.reserve(static_cast<std::size_t>(
        std::ranges::count_if(state_, [](std::uint8_t state) { return (state & changed_bit) != 0; })));
    const auto n = static_cast<std::uint32_t>(state_.size());
    const auto is_changed = [&](std::uint32_t c) { return (state_[c] & changed_bit) != 0; };
    constexpr std::uint64_t changed_bits = 0x0101010101010101U * changed_bit;
    std::uint32_t c = 0;
    for (std::uint64_t eight = 0; c + sizeof eight <= n; c += sizeof eight) {
        std::memcpy(&eight, &state_[c], sizeof eight);
        if ((eight & changed_bits) == 0) continue;
        for (std::uint32_t i = c; i < c + sizeof eight; ++i)
            if (is_changed(i)) cells.emplace_back(i);
    }
    for (; c < n; ++c)
        if (is_changed(c)) cells.emplace_back(c);
    return cells;
}

std::vector<CellHandle> Bisector::take_changed() {
    std::vector<CellHandle> cells = changed();
    for (const CellHandle c : cells) state_[c.idx()] &= edge_mask;
    const std::vector<CellHandle> log = std::exchange(log_, {});
    return log.size() == cells.size() ? log : cells;
}

bool Bisector::bisect(CellHandle c) {
    return is_born(c) || split(c, longest(c));
}

bool Bisector::split(CellHandle c, int local_edge) {
    const CellList ring = mesh_.cells_around(c, local_edge);
    const auto [i, j] = tet::edge_vertices[local_edge];
    const EdgeStars::Edge edge{mesh_.cell_vertex(c, i), mesh_.cell_vertex(c, j)};
    if (!can_split(edge, {ring.data(), ring.size()})) return false;
    std::uint32_t child = mesh_.n_cells();
    for (const CellHandle parent : ring) {
        if ((state_[parent.idx()] & changed_bit) == 0) log_.push_back(parent);
        log_.emplace_back(child++);
    }
    EdgeStars one;
    one.add(edge, {ring.data(), ring.size()});
    split(one);
    return true;
}

bool Bisector::can_split(EdgeStars::Edge edge, std::span<const CellHandle> ring) const {
    const Point middle = 0.5 * mesh_.point(edge.a) + 0.5 * mesh_.point(edge.b);
    return std::ranges::all_of(
        ring, [&](CellHandle c) { return is_thick(mesh_, c) || keeps_orientation(mesh_, c, edge, middle); });
}

bool Bisector::mark(CellHandle c, std::uint8_t bit) {
    std::uint8_t& state = state_[c.idx()];
    if ((state & bit) != 0) return false;
    state |= bit;
    return true;
}

void Bisector::split(const EdgeStars& stars) {
    auto& [ancestors, parents, n_vertices_before] = lineage_;
    const std::uint32_t first_vertex = mesh_.n_vertices();
    const std::uint32_t first_cell = mesh_.n_cells();
    mesh_.split_edges(stars);
    state_.grow(mesh_.n_cells());
    ancestors.resize(mesh_.n_cells());
    for (std::size_t i = 0; i < stars.size(); ++i)
        parents.push_back({stars.edge(i).a.idx(), stars.edge(i).b.idx()});
    longest_edge_.add(first_vertex, std::span(parents).last(stars.size()));
    for_each_index(stars.size(), [&](std::size_t i) {
        const VertexHandle a = stars.edge(i).a;
        const VertexHandle m(first_vertex + static_cast<std::uint32_t>(i));
        std::uint32_t child = first_cell + stars.begin_of(i);
        for (const CellHandle c : stars.ring(i)) {
            const auto longest = longest_edge_.of_children(c, CellHandle(child), mesh_.local_vertex(c, a),
                                                           mesh_.local_vertex(c, m));
            state_[c.idx()] = static_cast<std::uint8_t>(longest[0] | born_bit | changed_bit);
            state_[child] = static_cast<std::uint8_t>(longest[1] | born_bit | changed_bit);
            ancestors[child] = ancestors[c.idx()];
            ++child;
        }
    });
}

}  // namespace maille::refine
