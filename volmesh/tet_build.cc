#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "volmesh/error.hh"
#include "volmesh/fans.hh"
#include "volmesh/link_faces.hh"
#include "volmesh/orientation.hh"
#include "volmesh/overlap.hh"
#include "volmesh/tet_mesh.hh"
#include "volmesh/union_find.hh"

namespace maille::volmesh {
namespace {

/// All that are in any of the lists, ascending.
CellList united(std::span<const CellList> lists) {
    CellList all;
    for (const CellList& list : lists) all.insert(all.end(), list.begin(), list.end());
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

/// The cell's vertices must be four of so many.
void require_four_of(std::size_t n_points, const std::array<TetMesh::Index, 4>& cell, std::size_t c) {
    const auto [v0, v1, v2, v3] = cell;
    const bool is_in_range = std::max(std::max(v0, v1), std::max(v2, v3)) < n_points;
    const bool has_repeats =
        ((v0 == v1) | (v0 == v2) | (v0 == v3) | (v1 == v2) | (v1 == v3) | (v2 == v3)) != 0;
    if (is_in_range && !has_repeats) return;
    for (int i = 0; i < 4; ++i) {
        if (cell[i] >= n_points)
            throw InputError(
                fmt::format("cell {} has vertex {}, but there are only {} vertices", c, cell[i], n_points));
        for (int j = 0; j < i; ++j)
            if (cell[i] == cell[j]) throw InputError(fmt::format("cell {} has vertex {} twice", c, cell[i]));
    }
}

}  // namespace

TetMesh TetMesh::from_cells(std::vector<Point> points, std::vector<std::array<Index, 4>> cells) {
    Column<Cell> column;
    column.grow(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c) column[c] = {cells[c], {none, none, none, none}};
    cells = {};
    return from_linked_cells(std::move(points), std::move(column));
}

TetMesh TetMesh::from_linked_cells(std::vector<Point> points, Column<Cell> cells) {
    if (cells.size() >= none / 8 || points.size() >= none)
        throw InputError(
            fmt::format("a mesh of {} cells is too large: at most {} fit", cells.size(), none / 8 - 1));
    for (std::size_t c = 0; c < cells.size(); ++c) require_four_of(points.size(), cells[c].vertices, c);
    TetMesh mesh;
    mesh.points_.assign(std::exchange(points, {}));
    mesh.cells_ = std::move(cells);
    // Where most are not known, nobody needs a list of them.
    std::vector<Index> unlinked;
    for (Index hf = 0; hf < mesh.n_halffaces() && unlinked.size() <= mesh.n_cells() / 4; ++hf)
        if (mesh.cells_[hf / 4].neighbors[hf % 4] == none) unlinked.push_back(hf);
    const std::vector<Index> boundary = mesh.link(std::move(unlinked));
    mesh.find_vertex_cells();
    mesh.find_pinches(boundary);
    return mesh;
}

// Brings together the faces whose neighbours are not known, of which all are given or more than a quarter of
// the cells' number. Returns those on the boundary, ascending as they are given.
std::vector<TetMesh::Index> TetMesh::link(std::vector<Index> unlinked) {
    const auto vertices_of = [&](Index c) -> const auto& {
        return cells_[c].vertices;
    };
    const auto link_two = [&](Index halfface, Index other) {
        cells_[halfface / 4].neighbors[halfface % 4] = other;
        cells_[other / 4].neighbors[other % 4] = halfface;
    };
    if (unlinked.size() > n_cells() / 4) {
        // Then all anew, by many threads and in parts that fit into the cache.
        n_boundary_ = linking::link_faces(n_vertices(), n_cells(), vertices_of, link_two);
        return boundary_sides();
    }
    linking::Pairing pairing;
    pairing.gather(unlinked, vertices_of);
    if (!pairing.link(link_two)) pairing.fail();
    n_boundary_ = pairing.n_single();
    std::erase_if(unlinked, [&](Index hf) { return cells_[hf / 4].neighbors[hf % 4] != none; });
    return unlinked;
}

std::vector<TetMesh::Index> TetMesh::boundary_sides() const {
    std::vector<Index> sides;
    sides.reserve(n_boundary_);
    for (Index hf = 0; hf < n_halffaces(); ++hf)
        if (cells_[hf / 4].neighbors[hf % 4] == none && !is_deleted(CellHandle(hf / 4))) sides.push_back(hf);
    return sides;
}

void TetMesh::find_vertex_cells() {
    vertex_cells_.assign(points_.size(), none);
    for (Index c = n_cells(); c-- > 0;)
        for (Index v : cells_[c].vertices) vertex_cells_[v] = c;
}

// Fans can only part at the boundary: an edge where more than two boundary faces meet; a vertex where those
// at it don't all hang together by such edges as have two.
void TetMesh::find_pinches(std::span<const Index> boundary) {
    vertex_fans_.clear();
    edge_fans_.clear();
    const auto corner_vertex = [&](Index corner) {
        return halfface_vertices(HalffaceHandle(boundary[corner / 3]))[corner % 3].idx();
    };
    const auto next_corner = [](Index corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
    std::vector<std::pair<std::uint64_t, Index>> edges;  // with the corner that each leaves
    edges.reserve(3 * boundary.size());
    for (Index corner = 0; corner < 3 * boundary.size(); ++corner)
        edges.emplace_back(edge_key(corner_vertex(corner), corner_vertex(next_corner(corner))), corner);
    std::ranges::sort(edges);
    std::map<Index, CellList> pinched_vertices;
    std::map<std::uint64_t, CellList> pinched_edges;
    UnionFind corners(edges.size());
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t same = i + 1;
        while (same < edges.size() && edges[same].first == edges[i].first) ++same;
        if (same - i > 2) pinched_edges[edges[i].first];
        if (same - i == 2) {
            const Index a = edges[i].second, b = edges[i + 1].second;
            const bool run_alike = corner_vertex(a) == corner_vertex(b);
            corners.unite(a, run_alike ? b : next_corner(b));
            corners.unite(next_corner(a), run_alike ? next_corner(b) : b);
        }
        i = same;
    }
    std::vector<Index> group_at(points_.size(), none);
    for (Index corner = 0; corner < edges.size(); ++corner) {
        const Index v = corner_vertex(corner), group = corners.find(corner);
        if (group_at[v] == none)
            group_at[v] = group;
        else if (group_at[v] != group)
            pinched_vertices[v];
    }
    if (pinched_vertices.empty() && pinched_edges.empty()) return;

    for (Index c = 0; c < n_cells(); ++c) {
        for (Index v : cells_[c].vertices)
            if (const auto at = pinched_vertices.find(v); at != pinched_vertices.end())
                at->second.push_back(CellHandle(c));
        for (const auto& [i, j] : tet::edge_vertices)
            if (const auto at = pinched_edges.find(edge_key(cells_[c].vertices[i], cells_[c].vertices[j]));
                at != pinched_edges.end())
                at->second.push_back(CellHandle(c));
    }
    for (const auto& [v, cells] : pinched_vertices) {
        const VertexHandle hinge(v);
        auto fans = first_cells_of_fans(*this, cells, {&hinge, 1});
        vertex_cells_[v] = fans.front();
        if (fans.size() > 1) vertex_fans_[v].assign(fans.begin() + 1, fans.end());
    }
    for (const auto& [key, cells] : pinched_edges) {
        const std::array hinge{VertexHandle(static_cast<Index>(key >> 32U)),
                               VertexHandle(static_cast<Index>(key))};
        edge_fans_[key] = first_cells_of_fans(*this, cells, hinge);
    }
}

// Finds the fans of these vertices, and of the edges between them, anew from the cells at each.
void TetMesh::repair_fans(std::span<const VertexHandle> vertices, std::span<const CellList> cells_at) {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const VertexHandle v = vertices[i];
        const auto fans = first_cells_of_fans(*this, cells_at[i], {&v, 1});
        vertex_cells_[v.idx()] = fans.empty() ? none : fans.front();
        vertex_fans_.erase(v.idx());
        if (fans.size() > 1) vertex_fans_[v.idx()].assign(fans.begin() + 1, fans.end());
        for (std::size_t j = 0; j < i; ++j) {
            CellList common;
            for (CellHandle c : cells_at[i])
                if (local_vertex(c, vertices[j]) >= 0) common.push_back(c);
            const std::array hinge{v, vertices[j]};
            const std::uint64_t key = edge_key(v.idx(), vertices[j].idx());
            edge_fans_.erase(key);
            if (auto edge_fans = first_cells_of_fans(*this, common, hinge); edge_fans.size() > 1)
                edge_fans_[key] = std::move(edge_fans);
        }
    }
}

VertexHandle TetMesh::add_vertex(const Point& p) {
    points_.push_back(p);
    vertex_cells_.push_back(none);
    if (!deleted_vertices_.empty()) deleted_vertices_.push_back(0);
    if (!vertex_combinations_.empty()) vertex_combinations_.push_back(0);
    properties_of(EntityKind::vertex).for_each([&](BaseProperty& property) {
        property.resize(points_.size());
    });
    return VertexHandle(n_vertices() - 1);
}

CellHandle TetMesh::add_cell(VertexHandle v0, VertexHandle v1, VertexHandle v2, VertexHandle v3) {
    const std::array vertices{v0, v1, v2, v3};
    const auto name =
        fmt::format("cell of vertices {}, {}, {} and {}", v0.idx(), v1.idx(), v2.idx(), v3.idx());
    for (VertexHandle v : vertices)
        if (!v.is_valid() || v.idx() >= n_vertices() || is_deleted(v))
            throw std::invalid_argument(name + ": one of them is not a vertex of the mesh");
    if (orientation(point(v0), point(v1), point(v2), point(v3)) <= 0)
        throw std::invalid_argument(name + ": it is flat or inverted; exchange two of its vertices");

    std::array<Index, 4> opposite{};
    for (int f = 0; f < 4; ++f) {
        const auto [i, j, k] = tet::face_vertices[f];
        const HalffaceHandle same = find_halfface(vertices[i], vertices[j], vertices[k]);
        opposite[f] = none;
        if (!same.is_valid()) continue;
        const auto turning = halfface_vertices(same);
        const auto at = std::ranges::find(turning, vertices[i]) - turning.begin();
        if (turning[(at + 1) % 3] == vertices[j])
            throw std::invalid_argument(fmt::format(
                "{}: it overlaps cell {}, which has a face on the same side", name, same.idx() / 4));
        if (!is_boundary(same))
            throw std::invalid_argument(fmt::format("{}: its face opposite vertex {} has two cells already",
                                                    name, vertices[f].idx()));
        opposite[f] = same.idx();
    }

    std::array<CellList, 4> cells_at;
    for (int i = 0; i < 4; ++i) cells_at[i] = vc_range(vertices[i]);
    const std::array corners{point(v0), point(v1), point(v2), point(v3)};
    for (CellHandle other : united(cells_at))
        if (overlap(corners, cell_points(other)))
            throw std::invalid_argument(fmt::format("{}: it overlaps cell {}", name, other.idx()));

    members_.forget();
    const CellHandle c(n_cells());
    for (CellList& cells : cells_at) cells.push_back(c);
    cells_.push_back({{v0.idx(), v1.idx(), v2.idx(), v3.idx()}, opposite});
    for (int f = 0; f < 4; ++f) {
        if (opposite[f] != none) cells_[opposite[f] / 4].neighbors[opposite[f] % 4] = halfface(c, f).idx();
        n_boundary_ += opposite[f] == none ? 1 : -1;
    }
    if (!deleted_cells_.empty()) deleted_cells_.push_back(0);
    if (!cell_rows_.empty()) cell_rows_.push_back(0);
    properties_of(EntityKind::cell).for_each([&](BaseProperty& property) { property.resize(cells_.size()); });
    repair_fans(vertices, cells_at);
    number_new_cell(c);
    inherit_sets_from_neighbors(c);
    return c;
}

}  // namespace maille::volmesh
