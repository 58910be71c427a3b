#pragma once

#include "volmesh/tet_mesh.hh"

namespace maille::benchmark {

/// Twenty named sets on a mesh of the unit cube, of every kind and with every rule but custom ones, and a
/// vertex property "temperature" that interpolates: what a user's mesh carries through refinement.
void name_parts(volmesh::TetMesh& mesh);

}  // namespace maille::benchmark
