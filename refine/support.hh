#pragma once

#include <span>
#include <utility>
#include <vector>

#include "volmesh/face_surfaces.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::refine {

/// The geometric supports of the vertices from `first` on: the surfaces that their faces lie on; vertices on
/// none are left out. (The paper, section 3.3, "Evaluation of boundary nodes".) Precondition: the cells given
/// are all that have such a vertex, or more.
std::vector<std::pair<volmesh::VertexHandle, volmesh::Surfaces>> supports_from(
    const volmesh::TetMesh& mesh, volmesh::FaceSurfaces& surfaces_of, std::uint32_t first,
    std::span<const volmesh::CellHandle> cells);

}  // namespace maille::refine
