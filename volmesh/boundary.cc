#include "volmesh/boundary.hh"

#include <algorithm>
#include <array>
#include <numeric>

#include "volmesh/tet_ranges.hh"

namespace maille::volmesh {

namespace {

using Index = TetMesh::Index;

/// Corners of the boundary faces, 3 * face + i; those that are one vertex of the surface are joined.
class Corners {
  public:
    explicit Corners(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }

    std::size_t find(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    /// The lower one stands for both.
    void join(std::size_t i, std::size_t j) {
        const auto [low, high] = std::minmax({find(i), find(j)});
        parent_[high] = low;
    }

  private:
    std::vector<std::size_t> parent_;
};

/// The boundary face that one comes to by turning about the edge a-b through the cells, from the one given.
HalffaceHandle across_edge(const TetMesh& mesh, HalffaceHandle from, VertexHandle a, VertexHandle b) {
    HalffaceHandle hf = from;
    while (true) {
        // The cell's other face at the edge is opposite the vertex of this face that isn't on it.
        const CellHandle cell = TetMesh::incident_cell(hf);
        const auto vertices = mesh.halfface_vertices(hf);
        const auto third = std::ranges::find_if(vertices, [&](VertexHandle v) { return v != a && v != b; });
        hf = TetMesh::halfface(cell, mesh.local_vertex(cell, *third));
        const HalffaceHandle opposite = mesh.opposite_halfface_handle(hf);
        if (!opposite.is_valid()) return hf;
        hf = opposite;
    }
}

int place(const std::array<VertexHandle, 3>& vertices, VertexHandle v) {
    return static_cast<int>(std::ranges::find(vertices, v) - vertices.begin());
}

Corners joined_corners(const TetMesh& mesh, const std::vector<HalffaceHandle>& faces) {
    Corners corners(3 * faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const auto vertices = mesh.halfface_vertices(faces[f]);
        for (int i = 0; i < 3; ++i) {
            const VertexHandle a = vertices[i];
            const VertexHandle b = vertices[(i + 1) % 3];
            const HalffaceHandle other = across_edge(mesh, faces[f], a, b);
            // `faces` is in ascending order.
            const auto g = static_cast<std::size_t>(std::ranges::lower_bound(faces, other) - faces.begin());
            if (g < f) continue;
            const auto others = mesh.halfface_vertices(other);
            for (VertexHandle v : {a, b}) corners.join(3 * f + place(vertices, v), 3 * g + place(others, v));
        }
    }
    return corners;
}

/// Whether none of the face's edges has a face on that side yet.
bool has_room(const TriMesh& surface, const std::array<TriMesh::VertexHandle, 3>& face) {
    for (int i = 0; i < 3; ++i) {
        const auto edge = surface.find_halfedge(face[i], face[(i + 1) % 3]);
        if (edge.is_valid() && !surface.is_boundary(edge)) return false;
    }
    return true;
}

}  // namespace

BoundarySurface boundary(const TetMesh& mesh) {
    BoundarySurface result;
    for (const auto hf : mesh.boundary_halffaces()) result.halffaces.push_back(hf);
    const auto& faces = result.halffaces;
    Corners corners = joined_corners(mesh, faces);

    const auto add_vertex = [&](VertexHandle v) {
        result.vertices.push_back(v);
        return result.surface.add_vertex(mesh.point(v));
    };
    std::vector<TriMesh::VertexHandle> vertex_of(3 *
                                                 faces.size());  // by the corner that stands for the others
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const auto vertices = mesh.halfface_vertices(faces[f]);
        std::array<TriMesh::VertexHandle, 3> face;
        for (int i = 0; i < 3; ++i) {
            TriMesh::VertexHandle& vertex = vertex_of[corners.find(3 * f + i)];
            if (!vertex.is_valid()) vertex = add_vertex(vertices[i]);
            face[i] = vertex;
        }
        if (!has_room(result.surface, face))
            for (int i = 0; i < 3; ++i) face[i] = add_vertex(vertices[i]);
        result.surface.add_face(face[0], face[1], face[2]);
    }
    return result;
}

}  // namespace maille::volmesh
