#pragma once

#include <Eigen/Geometry>

#include "modeler/tessellate_seed.hh"
#include "volmesh/tri_mesh.hh"

namespace maille::modeler {

/// Divides the triangles that reach into the box until their edges are at most as long as wanted there, by
/// bisecting longest edges (Rivara), so that triangles grow gradually away from the box. New vertices lie on
/// the true surfaces.
void refine_within(volmesh::TriMesh& mesh, const Shape& shape, const Sizing& sizing,
                   const Eigen::AlignedBox3d& box);

}  // namespace maille::modeler
