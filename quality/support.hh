#pragma once

#include <cstdint>
#include <vector>

#include <boost/container/small_vector.hpp>

#include "volmesh/projector.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::quality {

/// Numbers of the projector's surfaces that a vertex lies on, ascending.
using Surfaces = boost::container::small_vector<std::uint32_t, 3>;

/// Where a vertex may go without a change to the geometry, the sets or the materials of the mesh.
struct Freedom {
    bool is_fixed = false;
    Surfaces surfaces{};  ///< none: anywhere
};

/// The freedom of every vertex, by index. Cost: one pass over the mesh, some look-ups for each face on a
/// surface.
std::vector<Freedom> freedoms(const volmesh::TetMesh& mesh, const volmesh::Projector* projector);

}  // namespace maille::quality
