#include "volmesh/tet_mesh.hh"

#include <algorithm>
#include <unordered_set>

#include "volmesh/fans.hh"

namespace maille::volmesh {
namespace {

// Turns round an edge from a cell, out through the face opposite the local vertex `pivot` first, until it
// comes back or to the boundary. Whether it came back. Each face that it goes through has the vertex `shared`
// besides the edge's ends.
template <class Cell>
bool turn(const Column<Cell>& cells, std::uint32_t start, int pivot, int shared_local, CellList& ring) {
    std::uint32_t cell = start;
    std::uint32_t shared = cells[start].vertices[shared_local];
    while (true) {
        const std::uint32_t next = cells[cell].neighbors[pivot];
        if (next == TetMesh::none) return false;
        cell = next / 4;
        if (cell == start) return true;
        ring.push_back(CellHandle(cell));
        // In through the face opposite local vertex next % 4, out through that opposite the shared one.
        const auto& v = cells[cell].vertices;
        pivot = v[0] == shared ? 0 : v[1] == shared ? 1 : v[2] == shared ? 2 : 3;
        shared = v[next % 4];
    }
}

}  // namespace

EntityRange<VertexHandle> TetMesh::vertices() const {
    using Range = EntityRange<VertexHandle>;
    return {*this, n_vertices(), deleted_vertices_.empty() ? Range::Filter::nothing : Range::Filter::deleted};
}

EntityRange<EdgeHandle> TetMesh::edges() const {
    using Range = EntityRange<EdgeHandle>;
    return {*this, n_edges(), deleted_cells_.empty() ? Range::Filter::nothing : Range::Filter::deleted};
}

EntityRange<HalfedgeHandle> TetMesh::halfedges() const {
    using Range = EntityRange<HalfedgeHandle>;
    return {*this, n_halfedges(), deleted_cells_.empty() ? Range::Filter::nothing : Range::Filter::deleted};
}

EntityRange<FaceHandle> TetMesh::faces() const {
    using Range = EntityRange<FaceHandle>;
    request_faces();
    return {*this, n_faces(), deleted_cells_.empty() ? Range::Filter::nothing : Range::Filter::deleted};
}

EntityRange<CellHandle> TetMesh::cells() const {
    using Range = EntityRange<CellHandle>;
    return {*this, n_cells(), deleted_cells_.empty() ? Range::Filter::nothing : Range::Filter::deleted};
}

EntityRange<HalffaceHandle> TetMesh::halffaces() const {
    using Range = EntityRange<HalffaceHandle>;
    return {*this, n_halffaces(), deleted_cells_.empty() ? Range::Filter::nothing : Range::Filter::deleted};
}

EntityRange<HalffaceHandle> TetMesh::boundary_halffaces() const {
    return {*this, n_halffaces(), EntityRange<HalffaceHandle>::Filter::interior};
}

EntityRange<FaceHandle> TetMesh::boundary_faces() const {
    request_faces();
    return {*this, n_faces(), EntityRange<FaceHandle>::Filter::interior};
}

std::array<VertexHandle, 3> TetMesh::halfface_vertices(HalffaceHandle hf) const {
    const auto& v = cells_[hf.idx() / 4].vertices;
    const auto& local = tet::face_vertices[hf.idx() % 4];
    return {VertexHandle(v[local[0]]), VertexHandle(v[local[1]]), VertexHandle(v[local[2]])};
}

bool TetMesh::is_boundary(CellHandle c) const {
    const auto& neighbors = cells_[c.idx()].neighbors;
    return std::ranges::find(neighbors, none) != neighbors.end();
}

bool TetMesh::is_boundary(VertexHandle v) const {
    for (CellHandle c : vc_range(v))
        for (int f = 0; f < 4; ++f)
            if (cells_[c.idx()].vertices[f] != v.idx() && is_boundary(halfface(c, f))) return true;
    return false;
}

bool TetMesh::is_boundary(EdgeHandle e) const {
    const auto [c, local] = edge_place(e);
    const CellList ring = cells_around(c, local);
    const auto [k, l] = tet::edge_vertices[tet::opposite_edge(local)];
    // An inner edge has a closed ring: the first cell, which is c, then has both neighbours.
    return ring.front() != c || is_boundary(halfface(c, k)) || is_boundary(halfface(c, l));
}

// ---- incidence
// ------------------------------------------------------------------------------------------------------

template <class Visit>
void TetMesh::visit_fan(Index start, Index vertex, const Visit& visit) const {
    constexpr std::size_t long_list = 128;  // beyond it, look cells up by hashing
    boost::container::small_vector<Index, 48> found{start};
    std::unordered_set<Index> hashed;
    const auto is_new = [&](Index cell) {
        if (found.size() < long_list) return std::ranges::find(found, cell) == found.end();
        if (hashed.empty()) hashed.insert(found.begin(), found.end());
        return hashed.insert(cell).second;
    };
    for (std::size_t i = 0; i < found.size(); ++i) {
        const Index cell = found[i];
        visit(CellHandle(cell));
        for (int f = 0; f < 4; ++f) {
            const Index other = cells_[cell].neighbors[f];
            if (cells_[cell].vertices[f] == vertex || other == none || !is_new(other / 4)) continue;
            __builtin_prefetch(&cells_[other / 4]);  // its turn comes soon
            found.push_back(other / 4);
        }
    }
}

CellList TetMesh::vc_range(VertexHandle v) const {
    CellList cells;
    const Index start = vertex_cells_[v.idx()];
    if (start == none) return cells;
    const auto collect = [&](CellHandle c) { cells.push_back(c); };
    visit_fan(start, v.idx(), collect);
    if (!vertex_fans_.empty())
        if (const auto fans = vertex_fans_.find(v.idx()); fans != vertex_fans_.end())
            for (Index first : fans->second) visit_fan(first, v.idx(), collect);
    return cells;
}

VertexList TetMesh::vv_range(VertexHandle v) const {
    VertexList vertices;
    for (CellHandle c : vc_range(v))
        for (VertexHandle other : cell_vertices(c))
            if (other != v) vertices.push_back(other);
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

EdgeList TetMesh::ve_range(VertexHandle v) const {
    EdgeList edges;
    for (CellHandle c : vc_range(v)) {
        const int i = local_vertex(c, v);
        for (int j = 0; j < 4; ++j)
            if (i != j) edges.push_back(edge_handle(c, tet::edge_between[i][j]));
    }
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

void TetMesh::append_ring(CellHandle c, int local_edge, CellList& ring) const {
    const auto [k, l] = tet::edge_vertices[tet::opposite_edge(local_edge)];
    const auto begin = static_cast<std::ptrdiff_t>(ring.size());
    ring.push_back(c);
    if (turn(cells_, c.idx(), k, l, ring)) return;
    std::reverse(ring.begin() + begin, ring.end());
    turn(cells_, c.idx(), l, k, ring);
}

CellList TetMesh::cells_around(CellHandle c, int local_edge) const {
    CellList ring;
    append_ring(c, local_edge, ring);
    if (!edge_fans_.empty()) {
        const auto [i, j] = tet::edge_vertices[local_edge];
        const VertexHandle a = cell_vertex(c, i);
        const VertexHandle b = cell_vertex(c, j);
        if (const auto fans = edge_fans_.find(edge_key(a.idx(), b.idx())); fans != edge_fans_.end())
            for (Index first : fans->second)
                if (std::ranges::find(ring, CellHandle(first)) == ring.end())
                    append_ring(CellHandle(first), this->local_edge(CellHandle(first), a, b), ring);
    }
    return ring;
}

CellList TetMesh::cells_around(VertexHandle a, VertexHandle b) const {
    for (CellHandle c : vc_range(a))
        if (const int e = local_edge(c, a, b); e >= 0) return cells_around(c, e);
    return {};
}

CellList TetMesh::ec_range(EdgeHandle e) const {
    const auto [c, local] = edge_place(e);
    return cells_around(c, local);
}

boost::container::small_vector<HalffaceHandle, 48> TetMesh::halffaces_around(CellHandle c,
                                                                             int local_edge) const {
    const auto [i, j] = tet::edge_vertices[local_edge];
    const VertexHandle a = cell_vertex(c, i);
    const VertexHandle b = cell_vertex(c, j);
    boost::container::small_vector<HalffaceHandle, 48> faces;
    for (CellHandle cell : cells_around(c, local_edge))
        for (int f = 0; f < 4; ++f) {
            const VertexHandle apex = cell_vertex(cell, f);
            const HalffaceHandle hf = halfface(cell, f);
            if (apex != a && apex != b && hf < opposite_halfface_handle(hf)) faces.push_back(hf);
        }
    return faces;
}

FaceList TetMesh::ef_range(EdgeHandle e) const {
    const auto [c, local] = edge_place(e);
    FaceList faces;
    for (HalffaceHandle hf : halffaces_around(c, local)) faces.push_back(face_handle(hf));
    return faces;
}

HalffaceHandle TetMesh::find_halfface(VertexHandle a, VertexHandle b, VertexHandle c) const {
    HalffaceHandle reversed;
    if (a == b || b == c || c == a) return reversed;
    for (CellHandle cell : vc_range(a)) {
        const int i = local_vertex(cell, a);
        const int j = local_vertex(cell, b);
        const int k = local_vertex(cell, c);
        if (j < 0 || k < 0) continue;
        const int face = 6 - i - j - k;
        const auto& turning = tet::face_vertices[face];
        const auto at = static_cast<int>(std::ranges::find(turning, i) - turning.begin());
        if (turning[(at + 1) % 3] == j) return halfface(cell, face);
        reversed = halfface(cell, face);
    }
    return reversed;
}

CellHandle TetMesh::find_cell(VertexHandle a, VertexHandle b, VertexHandle c, VertexHandle d) const {
    if (a == b || a == c || a == d || b == c || b == d || c == d) return {};
    for (CellHandle cell : vc_range(a))
        if (local_vertex(cell, b) >= 0 && local_vertex(cell, c) >= 0 && local_vertex(cell, d) >= 0)
            return cell;
    return {};
}

}  // namespace maille::volmesh
