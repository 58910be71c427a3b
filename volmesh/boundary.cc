#include "volmesh/boundary.hh"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "volmesh/tet_ranges.hh"
#include "volmesh/union_find.hh"

namespace maille::volmesh {

namespace {

/// Corners of the faces; those that are one vertex of the surface are joined.
using Corners = UnionFind;

std::uint32_t corner_of(std::size_t face, std::size_t i) {
    return static_cast<std::uint32_t>(3 * face + i);
}

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

/// Faces f and g share the edge.
void join_at(const TetMesh& mesh, const std::vector<HalffaceHandle>& faces, Corners& corners, std::size_t f,
             std::size_t g, std::array<VertexHandle, 2> edge) {
    for (VertexHandle v : edge)
        corners.unite(corner_of(f, place(mesh.halfface_vertices(faces[f]), v)),
                      corner_of(g, place(mesh.halfface_vertices(faces[g]), v)));
}

/// Of all boundary faces: what turning through the cells joins.
Corners corners_of_boundary(const TetMesh& mesh, const std::vector<HalffaceHandle>& faces) {
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
            join_at(mesh, faces, corners, f, g, {a, b});
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

/// The surface of these faces, whose corners are joined as is said.
ExtractedSurface surface_of(const TetMesh& mesh, std::vector<HalffaceHandle> halffaces, Corners corners) {
    ExtractedSurface result;
    result.halffaces = std::move(halffaces);
    const auto& faces = result.halffaces;
    const auto add_vertex = [&](VertexHandle v) {
        result.vertices.push_back(v);
        return result.surface.add_vertex(mesh.point(v));
    };
    // By the corner that stands for the others.
    std::vector<TriMesh::VertexHandle> vertex_of(3 * faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const auto vertices = mesh.halfface_vertices(faces[f]);
        std::array<TriMesh::VertexHandle, 3> face;
        for (int i = 0; i < 3; ++i) {
            TriMesh::VertexHandle& vertex = vertex_of[corners.find(corner_of(f, i))];
            if (!vertex.is_valid()) vertex = add_vertex(vertices[i]);
            face[i] = vertex;
        }
        if (!has_room(result.surface, face))
            for (int i = 0; i < 3; ++i) face[i] = add_vertex(vertices[i]);
        result.surface.add_face(face[0], face[1], face[2]);
    }
    return result;
}

/// An edge at which exactly two of the faces meet.
struct Seam {
    VertexHandle a, b;
    std::array<std::size_t, 2> faces;
};

std::vector<Seam> seams_of(const TetMesh& mesh, const std::vector<HalffaceHandle>& faces) {
    struct Side {
        VertexHandle a, b;
        std::size_t face;
        auto operator<=>(const Side&) const = default;
    };
    std::vector<Side> sides;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const auto v = mesh.halfface_vertices(faces[f]);
        for (int i = 0; i < 3; ++i) {
            const auto [a, b] = std::minmax(v[i], v[(i + 1) % 3]);
            sides.push_back({a, b, f});
        }
    }
    std::ranges::sort(sides);
    std::vector<Seam> seams;
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t same = i + 1;
        while (same < sides.size() && sides[same].a == sides[i].a && sides[same].b == sides[i].b) ++same;
        if (same - i == 2) seams.push_back({sides[i].a, sides[i].b, {sides[i].face, sides[i + 1].face}});
        i = same;
    }
    return seams;
}

bool turns_from_a_to_b(const TetMesh& mesh, HalffaceHandle hf, const Seam& seam) {
    const auto v = mesh.halfface_vertices(hf);
    return v[(place(v, seam.a) + 1) % 3] == seam.b;
}

bool turn_alike(const TetMesh& mesh, const std::vector<HalffaceHandle>& faces, const Seam& seam) {
    return turns_from_a_to_b(mesh, faces[seam.faces[0]], seam) !=
           turns_from_a_to_b(mesh, faces[seam.faces[1]], seam);
}

/// Turns faces inside the mesh as their neighbours turn, beginning at the boundary.
void make_turn_alike(const TetMesh& mesh, std::vector<HalffaceHandle>& faces,
                     const std::vector<Seam>& seams) {
    std::vector<std::vector<std::size_t>> seams_at(faces.size());
    for (std::size_t s = 0; s < seams.size(); ++s)
        for (std::size_t f : seams[s].faces) seams_at[f].push_back(s);
    std::vector<std::uint8_t> is_settled(faces.size(), 0);
    std::vector<std::size_t> queue;
    const auto settle = [&](std::size_t f) {
        is_settled[f] = 1;
        queue.push_back(f);
    };
    for (std::size_t f = 0; f < faces.size(); ++f)
        if (mesh.is_boundary(faces[f])) settle(f);
    std::size_t next = 0;
    for (std::size_t first = 0; first < faces.size() || next < queue.size();) {
        if (next == queue.size()) {
            if (is_settled[first] == 0) settle(first);
            ++first;
            continue;
        }
        const std::size_t face = queue[next++];
        for (std::size_t s : seams_at[face]) {
            const std::size_t beside = seams[s].faces[seams[s].faces[0] == face ? 1 : 0];
            if (is_settled[beside] != 0) continue;
            if (!turn_alike(mesh, faces, seams[s]))
                faces[beside] = mesh.opposite_halfface_handle(faces[beside]);
            settle(beside);
        }
    }
}

}  // namespace

ExtractedSurface boundary(const TetMesh& mesh) {
    std::vector<HalffaceHandle> faces;
    for (const auto hf : mesh.boundary_halffaces()) faces.push_back(hf);
    Corners corners = corners_of_boundary(mesh, faces);
    return surface_of(mesh, std::move(faces), std::move(corners));
}

ExtractedSurface extract_surface(const TetMesh& mesh, std::vector<HalffaceHandle> faces) {
    Corners corners(3 * faces.size());
    for (const Seam& seam : seams_of(mesh, faces))
        if (turn_alike(mesh, faces, seam))
            join_at(mesh, faces, corners, seam.faces[0], seam.faces[1], {seam.a, seam.b});
    return surface_of(mesh, std::move(faces), std::move(corners));
}

ExtractedSurface extract_surface(const TetMesh& mesh, SetHandle face_set) {
    if (mesh.set_info(face_set).kind != EntityKind::face)
        throw std::invalid_argument("a surface is told by a set of faces");
    std::vector<HalffaceHandle> faces = mesh.face_members(face_set);
    make_turn_alike(mesh, faces, seams_of(mesh, faces));
    return extract_surface(mesh, std::move(faces));
}

}  // namespace maille::volmesh
