#pragma once

// clang-format off: EigenVectorT.hh specialises what vector_traits.hh declares, without including it.
#include <OpenMesh/Core/Utils/vector_traits.hh>
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
// clang-format on

namespace maille::volmesh {

struct TriMeshTraits : OpenMesh::DefaultTraits {
    using Point = Eigen::Vector3d;
    using Normal = Eigen::Vector3d;
    using TexCoord2D = Eigen::Vector2d;
    using TexCoord3D = Eigen::Vector3d;
};

/// Surfaces: tessellated primitives and extracted boundaries.
using TriMesh = OpenMesh::TriMesh_ArrayKernelT<TriMeshTraits>;

}  // namespace maille::volmesh
