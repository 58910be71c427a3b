#pragma once

// clang-format off: EigenVectorT.hh specialises what vector_traits.hh declares, without including it.
#include <OpenMesh/Core/Utils/vector_traits.hh>
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
// clang-format on

namespace maille::volmesh {

/// OpenMesh's traits that put Eigen's vectors in its meshes.
struct TriMeshTraits : OpenMesh::DefaultTraits {
    using Point = Eigen::Vector3d;       ///< as the mesh's
    using Normal = Eigen::Vector3d;      ///< of length 1 where OpenMesh makes it
    using TexCoord2D = Eigen::Vector2d;  ///< not used here
    using TexCoord3D = Eigen::Vector3d;  ///< not used here
};

/// Surfaces: tessellated primitives and extracted boundaries.
using TriMesh = OpenMesh::TriMesh_ArrayKernelT<TriMeshTraits>;

}  // namespace maille::volmesh
