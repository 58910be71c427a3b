#pragma once

#include <cstdint>
#include <memory>

#include "modeler/primitive.hh"
#include "volmesh/tri_mesh.hh"

namespace maille::modeler {

struct SharedSurface;

/// How finely a primitive's surface is cut into triangles.
struct TessellateOptions {
    double size = 0;               ///< wanted edge length; has to be given
    Eigen::AlignedBox3d within{};  ///< where that is wanted; empty: everywhere
    double size_beyond = 0;        ///< how large the triangles may be elsewhere
    double chord_tolerance = 0;    ///< greatest distance from a triangle to the true surface; 0: no limit
    bool is_draft = false;         ///< planar faces may have badly shaped triangles: they are made anew later
    /// How the curved surface is cut that the primitive shares with others; null: as the primitive likes.
    std::shared_ptr<const SharedSurface> shared{};
};

/// A closed surface of nearly equilateral triangles, oriented outwards. All vertices lie on the true surface;
/// the sharp curves of the primitive are chains of edges. A circle has at least eight edges, however large
/// the size. Throws InputError where the size is not positive, or so small that there would be too many
/// triangles.
volmesh::TriMesh tessellate(const Primitive& primitive, const TessellateOptions& options);
volmesh::TriMesh tessellate(const Primitive& primitive, double size);

/// The face of the primitive that a triangle of its tessellation lies on.
std::uint32_t surface_of(const volmesh::TriMesh& mesh, volmesh::TriMesh::FaceHandle face);

/// Tells the triangle's face; makes the mesh able to hold that where it is not yet.
void set_surface(volmesh::TriMesh& mesh, volmesh::TriMesh::FaceHandle face, std::uint32_t surface);

}  // namespace maille::modeler
