#include <fmt/format.h>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {
namespace {

using Index = TetMesh::Index;

/// Plain indices of the handles. Throws std::invalid_argument where one is given twice or is not in the mesh.
template <class H>
std::vector<Index> indices_of(const TetMesh& mesh, std::span<const H> handles, Index n, const char* kind) {
    std::vector<std::uint8_t> is_given(n, 0);
    std::vector<Index> indices;
    indices.reserve(handles.size());
    for (H h : handles) {
        if (h.idx() >= n || mesh.is_deleted(h))
            throw std::invalid_argument(fmt::format("{} {} is not in the mesh", kind, h.idx()));
        if (is_given[h.idx()]++ != 0)
            throw std::invalid_argument(fmt::format("{} {} is given twice", kind, h.idx()));
        indices.push_back(h.idx());
    }
    return indices;
}

template <class T>
void gather(Column<T>& to, const Column<T>& from, const std::vector<Index>& indices) {
    if (from.empty()) return;
    to.grow(indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i) to[i] = from[indices[i]];
}

PropertyList gathered(const PropertyList& from, const std::vector<Index>& indices) {
    PropertyList list = from;
    list.for_each([&](BaseProperty& property) { property.gather(indices); });
    return list;
}

}  // namespace

TetMesh TetMesh::taken(std::span<const VertexHandle> vertices, std::span<const CellHandle> cells) const {
    const auto old_vertices = indices_of(*this, vertices, n_vertices(), "vertex");
    const auto old_cells = indices_of(*this, cells, n_cells(), "cell");
    std::vector<Index> new_vertices(n_vertices(), none);
    std::vector<Point> points;
    points.reserve(old_vertices.size());
    for (Index v : old_vertices) {
        new_vertices[v] = static_cast<Index>(points.size());
        points.push_back(points_[v]);
    }
    std::vector<Index> new_cells(n_cells(), none);
    for (std::size_t i = 0; i < old_cells.size(); ++i) new_cells[old_cells[i]] = static_cast<Index>(i);
    Column<Cell> taken_cells;
    taken_cells.grow(old_cells.size());
    for (std::size_t i = 0; i < old_cells.size(); ++i) {
        Cell& cell = taken_cells[i] = cells_[old_cells[i]];
        for (Index& v : cell.vertices) {
            if (new_vertices[v] == none)
                throw std::invalid_argument(
                    fmt::format("cell {} has vertex {}, which is not given", old_cells[i], v));
            v = new_vertices[v];
        }
        for (Index& hf : cell.neighbors)
            if (hf != none) hf = new_cells[hf / 4] == none ? none : 4 * new_cells[hf / 4] + hf % 4;
    }

    TetMesh mesh = from_linked_cells(std::move(points), std::move(taken_cells));
    mesh.sets_ = sets_;
    gather(mesh.vertex_combinations_, vertex_combinations_, old_vertices);
    gather(mesh.cell_rows_, cell_rows_, old_cells);
    mesh.mesh_properties_ = mesh_properties_;
    mesh.status_requests_ = status_requests_;
    mesh.status_property_ = status_property_;
    mesh.properties_of(EntityKind::vertex) = gathered(properties_of(EntityKind::vertex), old_vertices);
    mesh.properties_of(EntityKind::cell) = gathered(properties_of(EntityKind::cell), old_cells);
    if (edges_) {
        mesh.request_edges();
        std::vector<Index> old_edges;
        for (Index place : mesh.edges_->place)
            old_edges.push_back(edges_->of_cell[old_cells[place / 8]][place % 8]);
        mesh.properties_of(EntityKind::edge) = gathered(properties_of(EntityKind::edge), old_edges);
    }
    if (faces_) {
        mesh.request_faces();
        std::vector<Index> old_faces;
        for (Index hf : mesh.faces_->halfface)
            old_faces.push_back(faces_->of_cell[old_cells[hf / 4]][hf % 4]);
        mesh.properties_of(EntityKind::face) = gathered(properties_of(EntityKind::face), old_faces);
    }
    return mesh;
}

}  // namespace maille::volmesh
