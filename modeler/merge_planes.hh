#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "volmesh/tet_mesh.hh"

namespace maille::modeler {

struct Plane {
    Eigen::Vector3d point;
    Eigen::Vector3d normal;  ///< of unit length
};

/// Connected coplanar faces of a mesh that are in the same sets.
struct PlanarPatches {
    std::vector<Plane> planes;
    std::vector<volmesh::HalffaceHandle> examples;  ///< a face of each patch
    std::vector<std::uint32_t> patch_of_face;       ///< of each face asked for, in their order
};

PlanarPatches planar_patches(const volmesh::TetMesh& mesh, std::span<const volmesh::HalffaceHandle> faces);

/// The point nearest to `p` on all the planes; nothing where they have none in common near it.
std::optional<Eigen::Vector3d> nearest_on_planes(std::span<const Plane> planes, const Eigen::Vector3d& p);

}  // namespace maille::modeler
