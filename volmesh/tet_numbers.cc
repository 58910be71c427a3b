#include <algorithm>

#include "volmesh/tet_mesh.hh"

// Numbers of edges and faces: made when first asked for, kept by every edit.

namespace maille::volmesh {

void TetMesh::request_edges() const {
    if (edges_) return;
    edges_.emplace();
    edges_->of_cell.assign(cells_.size(), {none, none, none, none, none, none});
    number_remaining_edges();
    properties_of(EntityKind::edge).for_each([&](BaseProperty& property) {
        property.resize(edges_->place.size());
    });
}

void TetMesh::number_remaining_edges() const {
    auto& [of_cell, place] = *edges_;
    for (Index c = 0; c < n_cells(); ++c) {
        if (is_deleted(CellHandle(c))) continue;
        for (int e = 0; e < 6; ++e) {
            if (of_cell[c][e] != none) continue;
            const auto [i, j] = tet::edge_vertices[e];
            const VertexHandle a = cell_vertex(CellHandle(c), i);
            const VertexHandle b = cell_vertex(CellHandle(c), j);
            for (CellHandle around : cells_around(CellHandle(c), e))
                of_cell[around.idx()][local_edge(around, a, b)] = static_cast<Index>(place.size());
            place.push_back(8 * c + e);
        }
    }
}

void TetMesh::request_faces() const {
    if (faces_) return;
    faces_.emplace();
    faces_->of_cell.assign(cells_.size(), {none, none, none, none});
    number_remaining_faces();
    properties_of(EntityKind::face).for_each([&](BaseProperty& property) {
        property.resize(faces_->halfface.size());
    });
}

void TetMesh::number_remaining_faces() const {
    auto& [of_cell, halfface] = *faces_;
    for (Index hf = 0; hf < n_halffaces(); ++hf) {
        if (is_deleted(HalffaceHandle(hf)) || of_cell[hf / 4][hf % 4] != none) continue;
        const auto number = static_cast<Index>(halfface.size());
        of_cell[hf / 4][hf % 4] = number;
        if (const Index other = cells_[hf / 4].neighbors[hf % 4]; other != none)
            of_cell[other / 4][other % 4] = number;
        halfface.push_back(hf);
    }
}

/// Throws std::logic_error while there are edge properties, which would be lost.
void TetMesh::release_edges() {
    if (!properties_of(EntityKind::edge).empty())
        throw std::logic_error("edges cannot be released while there are edge properties");
    edges_.reset();
}

void TetMesh::release_faces() {
    if (!properties_of(EntityKind::face).empty())
        throw std::logic_error("faces cannot be released while there are face properties");
    faces_.reset();
}

TetMesh::Index TetMesh::n_edges() const {
    request_edges();
    return static_cast<Index>(edges_->place.size());
}

TetMesh::Index TetMesh::n_faces() const {
    if (!faces_ && deleted_cells_.empty()) return (4 * n_cells() + n_boundary_) / 2;
    request_faces();
    return static_cast<Index>(faces_->halfface.size());
}

EdgeHandle TetMesh::edge_handle(CellHandle c, int local_edge) const {
    request_edges();
    return EdgeHandle(edges_->of_cell[c.idx()][local_edge]);
}

FaceHandle TetMesh::face_handle(HalffaceHandle hf) const {
    request_faces();
    return FaceHandle(faces_->of_cell[hf.idx() / 4][hf.idx() % 4]);
}

std::pair<CellHandle, int> TetMesh::edge_place(EdgeHandle e) const {
    request_edges();
    const Index place = edges_->place[e.idx()];
    return {CellHandle(place / 8), static_cast<int>(place % 8)};
}

std::array<VertexHandle, 2> TetMesh::edge_vertices(EdgeHandle e) const {
    const auto [c, local] = edge_place(e);
    const auto [i, j] = tet::edge_vertices[local];
    const auto [low, high] = std::minmax(cells_[c.idx()].vertices[i], cells_[c.idx()].vertices[j]);
    return {VertexHandle(low), VertexHandle(high)};
}

HalffaceHandle TetMesh::halfface_handle(FaceHandle f, int side) const {
    request_faces();
    const HalffaceHandle hf(faces_->halfface[f.idx()]);
    return side == 0 ? hf : opposite_halfface_handle(hf);
}

EdgeHandle TetMesh::find_edge(VertexHandle a, VertexHandle b) const {
    for (CellHandle c : vc_range(a))
        if (const int e = local_edge(c, a, b); e >= 0) return edge_handle(c, e);
    return {};
}

FaceHandle TetMesh::find_face(VertexHandle a, VertexHandle b, VertexHandle c) const {
    const HalffaceHandle hf = find_halfface(a, b, c);
    return hf.is_valid() ? face_handle(hf) : FaceHandle();
}

EdgeList TetMesh::fe_range(FaceHandle f) const {
    const HalffaceHandle hf = halfface_handle(f, 0);
    EdgeList edges;
    for (int e : tet::face_edges[local_face(hf)]) edges.push_back(edge_handle(incident_cell(hf), e));
    return edges;
}

bool TetMesh::is_deleted(EdgeHandle e) const {
    return edges_ && edges_->place[e.idx()] == none;
}
bool TetMesh::is_deleted(FaceHandle f) const {
    return faces_ && faces_->halfface[f.idx()] == none;
}

std::size_t TetMesh::n_indices(EntityKind kind) const {
    switch (kind) {
        case EntityKind::vertex:
            return n_vertices();
        case EntityKind::edge:
            return n_edges();
        case EntityKind::face:
            return n_faces();
        case EntityKind::cell:
            return n_cells();
    }
    return 0;
}

// A cell that add_cell has just linked: it takes its neighbours' numbers and makes those that are missing.
void TetMesh::number_new_cell(CellHandle c) {
    if (edges_) {
        auto& numbers = edges_->of_cell.emplace_back();
        for (int e = 0; e < 6; ++e) {
            const auto [i, j] = tet::edge_vertices[e];
            numbers[e] = static_cast<Index>(edges_->place.size());
            for (CellHandle around : cells_around(c, e))
                if (around != c)
                    numbers[e] =
                        edges_
                            ->of_cell[around.idx()][local_edge(around, cell_vertex(c, i), cell_vertex(c, j))];
            if (numbers[e] == edges_->place.size()) edges_->place.push_back(8 * c.idx() + e);
        }
        properties_of(EntityKind::edge).for_each([&](BaseProperty& p) { p.resize(edges_->place.size()); });
    }
    if (faces_) {
        auto& numbers = faces_->of_cell.emplace_back();
        for (int f = 0; f < 4; ++f) {
            const HalffaceHandle other = opposite_halfface_handle(halfface(c, f));
            numbers[f] = other.is_valid() ? faces_->of_cell[other.idx() / 4][other.idx() % 4]
                                          : static_cast<Index>(faces_->halfface.size());
            if (!other.is_valid()) faces_->halfface.push_back(halfface(c, f).idx());
        }
        properties_of(EntityKind::face).for_each([&](BaseProperty& p) { p.resize(faces_->halfface.size()); });
    }
}

// A cell that is about to go: edges and faces that others have too must be found through those.
void TetMesh::forget_numbers(CellHandle c) {
    if (edges_)
        for (int e = 0; e < 6; ++e) {
            const auto [i, j] = tet::edge_vertices[e];
            Index& place = edges_->place[edges_->of_cell[c.idx()][e]];
            place = none;
            for (CellHandle around : cells_around(c, e))
                if (around != c)
                    place = 8 * around.idx() + local_edge(around, cell_vertex(c, i), cell_vertex(c, j));
        }
    if (faces_)
        for (int f = 0; f < 4; ++f)
            faces_->halfface[faces_->of_cell[c.idx()][f]] = cells_[c.idx()].neighbors[f];
}

}  // namespace maille::volmesh
