#pragma once

#include <vector>

#include "volmesh/tet_mesh.hh"
#include "volmesh/tri_mesh.hh"

namespace maille::volmesh {

/// Faces of a mesh as a surface that knows what it was taken from.
struct ExtractedSurface {
    TriMesh surface;  ///< of the faces alone
    /// By vertex of the surface: the vertex of the mesh.
    std::vector<VertexHandle> vertices;
    /// By face of the surface: the half-face of the mesh, whose way of turning it has.
    std::vector<HalffaceHandle> halffaces;
};

/// The boundary, seen from outside: every boundary face, in the order of boundary_halffaces().
///
/// The surface is manifold. Where the boundary is not, at an edge or vertex in which cells merely touch, the
/// sheets that touch have vertices of their own, each sheet being the one that bounds the same fan of cells.
/// A sheet that comes to an edge twice, which OpenMesh cannot hold, is cut open there: faces at the cut have
/// vertices of their own.
ExtractedSurface boundary(const TetMesh& mesh);

/// The faces of a set, in the order of face_members(). Those on the boundary are seen from outside, and faces
/// inside the mesh turn as those that they share an edge with, as far as that can be.
///
/// The surface is manifold: it is cut open where more than two of the faces meet in an edge, or where two
/// cannot turn alike. Throws std::invalid_argument where the set is of another kind.
ExtractedSurface extract_surface(const TetMesh& mesh, SetHandle face_set);

/// The same of faces given by half-faces, whose way of turning is kept. Each face may be given once.
ExtractedSurface extract_surface(const TetMesh& mesh, std::vector<HalffaceHandle> halffaces);

}  // namespace maille::volmesh
