#include <algorithm>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {
namespace {

using Index = TetMesh::Index;

/// Old indices of what stays, and where each old index goes.
struct Kept {
    std::vector<Index> old_indices;
    std::vector<Index> new_indices;

    template <class IsKept>
    Kept(std::size_t n, const IsKept& is_kept) : new_indices(n, TetMesh::none) {
        for (Index i = 0; i < n; ++i)
            if (is_kept(i)) {
                new_indices[i] = static_cast<Index>(old_indices.size());
                old_indices.push_back(i);
            }
    }

    template <class Values>
    void gather(Values& values) const {
        if (values.empty()) return;
        Values kept;
        for (Index old : old_indices) kept.push_back(values[old]);
        values = std::move(kept);
    }
};

}  // namespace

void TetMesh::delete_cell(CellHandle c) {
    if (is_deleted(c)) return;
    const auto vertices = cell_vertices(c);
    std::array<CellList, 4> cells_at;
    for (int i = 0; i < 4; ++i) {
        cells_at[i] = vc_range(vertices[i]);
        cells_at[i].erase(std::ranges::find(cells_at[i], c));
    }
    members_.forget();
    forget_numbers(c);
    for (Index& opposite : cells_[c.idx()].neighbors) {
        n_boundary_ += opposite == none ? -1 : 1;
        if (opposite != none) cells_[opposite / 4].neighbors[opposite % 4] = none;
        opposite = none;
    }
    if (deleted_cells_.empty()) deleted_cells_.resize(cells_.size(), 0);
    deleted_cells_[c.idx()] = 1;
    repair_fans(vertices, cells_at);
}

void TetMesh::delete_isolated_vertices() {
    members_.forget();
    for (Index v = 0; v < n_vertices(); ++v)
        if (vertex_cells_[v] == none) {
            if (deleted_vertices_.empty()) deleted_vertices_.resize(points_.size(), 0);
            deleted_vertices_[v] = 1;
        }
}

IndexMaps TetMesh::garbage_collection() {
    members_.forget();
    const Kept vertices(points_.size(), [&](Index v) { return !is_deleted(VertexHandle(v)); });
    const Kept cells(cells_.size(), [&](Index c) { return !is_deleted(CellHandle(c)); });
    const Kept edges(edges_ ? edges_->place.size() : 0, [&](Index e) { return edges_->place[e] != none; });
    const Kept faces(faces_ ? faces_->halfface.size() : 0,
                     [&](Index f) { return faces_->halfface[f] != none; });
    const auto move_halfface = [&](Index& hf) {
        if (hf != none) hf = 4 * cells.new_indices[hf / 4] + hf % 4;
    };

    vertices.gather(points_);
    vertices.gather(vertex_combinations_);
    vertices.gather(vertex_cells_);
    for (Index& c : vertex_cells_)
        if (c != none) c = cells.new_indices[c];
    cells.gather(cells_);
    cells.gather(cell_rows_);
    for (Cell& cell : cells_) {
        for (Index& v : cell.vertices) v = vertices.new_indices[v];
        for (Index& hf : cell.neighbors) move_halfface(hf);
    }
    deleted_cells_.clear();
    deleted_vertices_.clear();

    if (edges_) {
        edges.gather(edges_->place);
        cells.gather(edges_->of_cell);
        for (Index& place : edges_->place) place = 8 * cells.new_indices[place / 8] + place % 8;
        for (auto& numbers : edges_->of_cell)
            for (Index& e : numbers) e = edges.new_indices[e];
    }
    if (faces_) {
        faces.gather(faces_->halfface);
        cells.gather(faces_->of_cell);
        for (Index& hf : faces_->halfface) move_halfface(hf);
        for (auto& numbers : faces_->of_cell)
            for (Index& f : numbers) f = faces.new_indices[f];
    }
    const std::array<const Kept*, 4> by_kind{&vertices, &edges, &faces, &cells};
    for (int kind = 0; kind < 4; ++kind)
        properties_[kind].for_each(
            [&](BaseProperty& property) { property.gather(by_kind[kind]->old_indices); });
    find_pinches(boundary_sides());
    return {vertices.new_indices, edges.new_indices, faces.new_indices, cells.new_indices};
}

}  // namespace maille::volmesh
