#pragma once

#include <span>

#include "modeler/merge_operand.hh"
#include "modeler/merge_regions.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::modeler {

/// Puts the cells, faces, edges and vertices of a merged mesh into the sets of the meshes that they come
/// from.
void carry_sets_over(std::span<const volmesh::TetMesh> meshes, const MeshRegions& regions, Merged& merged);

}  // namespace maille::modeler
