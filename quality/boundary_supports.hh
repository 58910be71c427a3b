#pragma once

#include <span>
#include <vector>

#include "volmesh/face_surfaces.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::quality {

/// A vertex and all surfaces that it should lie on: its geometric support.
struct VertexSupport {
    volmesh::VertexHandle vertex;
    volmesh::Surfaces surfaces;
};

/// The geometric supports of the vertices from `first` on: the surfaces that their faces lie on; vertices on
/// none are left out. (The paper, section 3.3, "Evaluation of boundary nodes".) Precondition: the cells given
/// are all that have such a vertex, or more.
std::vector<VertexSupport> supports_from(const volmesh::TetMesh& mesh, volmesh::FaceSurfaces& surfaces_of,
                                         std::uint32_t first, std::span<const volmesh::CellHandle> cells);

}  // namespace maille::quality
