#pragma once

#include <vector>

#include "volmesh/tet_mesh.hh"
#include "volmesh/tri_mesh.hh"

namespace maille::volmesh {

/// The boundary of a mesh as a surface, seen from outside.
struct BoundarySurface {
    TriMesh surface;
    /// By vertex of the surface: the vertex of the mesh.
    std::vector<VertexHandle> vertices;
    /// By face of the surface: the half-face of the mesh.
    std::vector<HalffaceHandle> halffaces;
};

/// Every boundary face is a face of the surface, in the order of boundary_halffaces().
///
/// The surface is manifold. Where the boundary is not, at an edge or vertex in which cells merely touch, the
/// sheets that touch have vertices of their own, each sheet being the one that bounds the same fan of cells.
/// A sheet that comes to an edge twice, which OpenMesh cannot hold, is cut open there: faces at the cut have
/// vertices of their own.
BoundarySurface boundary(const TetMesh& mesh);

}  // namespace maille::volmesh
