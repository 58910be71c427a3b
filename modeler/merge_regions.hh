#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "modeler/csg_tree.hh"
#include "modeler/merge_operand.hh"
#include "modeler/merge_planes.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::modeler {

/// The cells of a mesh that are in the same sets: they take part in a merge as one operand.
struct MeshRegion {
    std::uint32_t mesh;
    std::vector<volmesh::CellHandle> cells;       ///< by their numbers in the operand's mesh
    std::vector<volmesh::VertexHandle> vertices;  ///< likewise
};

/// A patch of a region's surface.
struct MeshSurface {
    std::uint32_t mesh;
    Plane plane;
    volmesh::HalffaceHandle example;  ///< one of its faces
};

/// Meshes taken apart into regions.
struct MeshRegions {
    std::vector<MeshRegion> regions;
    std::vector<MeshSurface> surfaces;
    std::vector<Operand> operands;  ///< one a region
    CsgTree tree;                   ///< over the regions
};

/// Whether the face is on the boundary or between two regions.
bool is_on_surface(const volmesh::TetMesh& mesh, volmesh::HalffaceHandle face);

/// Throws InputError where a mesh has no cells or the tree names one that does not exist.
MeshRegions take_apart(std::span<const volmesh::TetMesh> meshes, const CsgTree& tree, double size);

}  // namespace maille::modeler
