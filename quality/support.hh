#pragma once

#include <vector>

#include "volmesh/face_surfaces.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::quality {

using volmesh::Surfaces;

/// Where a vertex may go without a change to the geometry, the sets or the materials of the mesh.
struct Freedom {
    bool is_fixed = false;
    Surfaces surfaces{};  ///< none: anywhere
};

/// The freedom of every vertex, by index. Cost: one pass over the mesh, some look-ups for each face on a
/// surface.
std::vector<Freedom> freedoms(const volmesh::TetMesh& mesh, const volmesh::Projector* projector);

}  // namespace maille::quality
