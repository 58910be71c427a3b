#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include <boost/container/small_vector.hpp>

#include "volmesh/projector.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::refine {

/// Numbers of the projector's surfaces, ascending: one for a vertex on a face, two on a curve, three at a
/// corner.
using Support = boost::container::small_vector<std::uint32_t, 4>;

/// The geometric support of a vertex: the surfaces of the face sets of its faces. (The paper, section 3.3,
/// "Evaluation of boundary nodes".) Nothing is stored in the mesh: the face sets, which refinement keeps
/// true, say it all.
class Supports {
  public:
    Supports(const volmesh::TetMesh& mesh, const volmesh::Projector& projector);

    /// Supports of the vertices from `first` on, those with none left out. Precondition: the cells given are
    /// all that have such a vertex, or more.
    std::vector<std::pair<volmesh::VertexHandle, Support>> of_vertices_from(
        std::uint32_t first, std::span<const volmesh::CellHandle> cells);

  private:
    const Support& of_combination(volmesh::CombinationId id);

    const volmesh::TetMesh& mesh_;
    std::map<volmesh::SetHandle, std::uint32_t> surface_of_set_;
    std::map<volmesh::CombinationId, Support> of_combination_;
};

}  // namespace maille::refine
