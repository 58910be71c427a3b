#include "refine/longest_edge.hh"

#include <algorithm>
#include <tuple>

#include "volmesh/fans.hh"

namespace maille::refine {
namespace {

using volmesh::Point;
namespace tet = volmesh::tet;

std::uint64_t edge_key(const TetMesh& mesh, CellHandle c, int edge) {
    const auto [i, j] = tet::edge_vertices[edge];
    return volmesh::edge_key(mesh.cell_vertex(c, i).idx(), mesh.cell_vertex(c, j).idx());
}

std::array<double, 6> squared_lengths(const TetMesh& mesh, CellHandle c) {
    const std::array<Point, 4> p = mesh.cell_points(c);
    std::array<double, 6> squares;
    for (int edge = 0; edge < 6; ++edge)
        squares[edge] = squared_length(p[tet::edge_vertices[edge][0]], p[tet::edge_vertices[edge][1]]);
    return squares;
}

/// Whether the cells round an edge leave a gap: then the ring of the first doesn't close.
bool is_on_boundary(const TetMesh& mesh, CellHandle c, int edge) {
    const volmesh::CellList ring = mesh.cells_around(c, edge);
    const auto sides = tet::edge_vertices[tet::opposite_edge(edge)];
    return ring.front() != c ||
           std::ranges::any_of(sides, [&](int side) { return mesh.is_boundary(TetMesh::halfface(c, side)); });
}

}  // namespace

bool LongestEdge::begin_pass(std::span<const CellHandle> marked) {
    if (ties_ != Ties::fewest) return false;
    std::vector<bool> is_marked(mesh_.n_cells());
    for (const CellHandle c : marked) is_marked[c.idx()] = true;
    n_unrefined_.clear();
    for (const CellHandle c : mesh_.cells()) {
        const std::array<double, 6> squares = squared_lengths(mesh_, c);
        const double longest = std::ranges::max(squares);
        if (std::ranges::count(squares, longest) == 1) continue;
        for (int edge = 0; edge < 6; ++edge) {
            if (squares[edge] != longest) continue;
            const auto [entry, is_new] = n_unrefined_.try_emplace(edge_key(mesh_, c, edge), 0);
            if (!is_new) continue;
            for (const CellHandle other : mesh_.cells_around(c, edge))
                if (!is_marked[other.idx()]) ++entry->second;
        }
    }
    return true;
}

/// The higher of two edges of one length counts as the longer.
int LongestEdge::precedence(CellHandle c, int edge) const {
    switch (ties_) {
        case Ties::order:
            break;
        case Ties::fewest:
            if (const auto known = n_unrefined_.find(edge_key(mesh_, c, edge)); known != n_unrefined_.end())
                return -known->second;
            break;
        case Ties::boundary:
            return is_on_boundary(mesh_, c, edge) ? 1 : 0;
    }
    return 0;
}

/// Whether an edge comes after another one of the same length.
bool LongestEdge::wins_tie(CellHandle c, int edge, int against) const {
    if (const auto by_rule = precedence(c, edge) <=> precedence(c, against); by_rule != 0) return by_rule > 0;
    const auto ends = [&](int e) {
        const VertexHandle a = mesh_.cell_vertex(c, tet::edge_vertices[e][0]);
        const VertexHandle b = mesh_.cell_vertex(c, tet::edge_vertices[e][1]);
        return std::pair(std::min(a, b), std::max(a, b));
    };
    const auto e = ends(edge), f = ends(against);
    const auto ages = [&](const auto& ab) {
        const int a = generations_[ab.first.idx()], b = generations_[ab.second.idx()];
        return std::pair(-std::max(a, b), -std::min(a, b));
    };
    if (const auto by_age = ages(e) <=> ages(f); by_age != 0) return by_age > 0;
    const auto place = [&](const auto& ab) {
        const Point& p = mesh_.point(ab.first);
        const Point& q = mesh_.point(ab.second);
        return std::tuple(p.x() + q.x(), p.y() + q.y(), p.z() + q.z(), ab.first, ab.second);
    };
    return place(e) > place(f);
}

int LongestEdge::longest(CellHandle c, const std::array<double, 6>& squares) const {
    int best = 0;
    for (int edge = 1; edge < 6; ++edge) {
        if (squares[edge] < squares[best]) continue;
        if (squares[edge] > squares[best] || wins_tie(c, edge, best)) best = edge;
    }
    return best;
}

int LongestEdge::of(CellHandle c) const {
    return longest(c, squared_lengths(mesh_, c));
}

std::array<int, 2> LongestEdge::of_children(CellHandle c, CellHandle other, int at_a, int at_m) const {
    const auto [k, l] = tet::edge_vertices[tet::opposite_edge(tet::edge_between[at_a][at_m])];
    const Point& a = mesh_.point(mesh_.cell_vertex(c, at_a));
    const Point& m = mesh_.point(mesh_.cell_vertex(c, at_m));
    const Point& b = mesh_.point(mesh_.cell_vertex(other, at_m));
    const Point& p = mesh_.point(mesh_.cell_vertex(c, k));
    const Point& q = mesh_.point(mesh_.cell_vertex(c, l));
    // Both have the edge p-q, and the edges m-p and m-q, though these at other places.
    std::array<double, 6> of_c, of_other;
    const int halves = tet::edge_between[at_a][at_m];
    const int a_k = tet::edge_between[at_a][k], a_l = tet::edge_between[at_a][l];
    const int m_k = tet::edge_between[at_m][k], m_l = tet::edge_between[at_m][l];
    of_c[halves] = squared_length(a, m);
    of_other[halves] = squared_length(m, b);
    of_c[tet::opposite_edge(halves)] = of_other[tet::opposite_edge(halves)] = squared_length(p, q);
    of_c[m_k] = of_other[a_k] = squared_length(m, p);
    of_c[m_l] = of_other[a_l] = squared_length(m, q);
    of_c[a_k] = squared_length(a, p);
    of_c[a_l] = squared_length(a, q);
    of_other[m_k] = squared_length(b, p);
    of_other[m_l] = squared_length(b, q);
    return {longest(c, of_c), longest(other, of_other)};
}

void LongestEdge::add(std::uint32_t first, std::span<const std::array<std::uint32_t, 2>> parents) {
    generations_.resize(first + parents.size());
    for (std::size_t i = 0; i < parents.size(); ++i)
        generations_[first + i] = static_cast<std::uint16_t>(
            1 + std::max(generations_[parents[i][0]], generations_[parents[i][1]]));
}

}  // namespace maille::refine
