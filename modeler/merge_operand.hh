#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "modeler/arrange.hh"
#include "modeler/csg_tree.hh"
#include "modeler/remesh.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::modeler {

/// A primitive of the tree as it takes part in a merge.
struct Operand {
    std::string name;  ///< for messages
    double size;       ///< wanted edge length of new cells
    ClosedSurface surface;
    /// Fills the surface: its first vertices are the surface's points, its boundary faces the surface's
    /// triangles. Empty where no cells are to be kept.
    volmesh::TetMesh mesh;
};

/// The cells and vertices of an operand's mesh.
struct Origin {
    std::uint32_t operand;
    std::uint32_t index;
};

/// A face of a merged mesh that lies between two regions or on the boundary.
struct InterfaceFace {
    volmesh::HalffaceHandle face;
    std::uint32_t surface;
};

/// What merging yields. Cells and vertices that were kept come first.
struct Merged {
    volmesh::TetMesh mesh;
    std::vector<std::uint32_t> regions;  ///< of each cell: the operand that owns its place
    std::vector<Origin> kept_cells;
    std::vector<Origin> kept_vertices;
    std::vector<InterfaceFace> faces;  ///< in the order of their half-faces
};

struct MergeSettings {
    bool keep_cells = true;  ///< false: everything is meshed anew
    double time_limit = 0;   ///< see TetrahedralizeOptions
};

/// The tree of the operands as one conforming mesh. Cells that no other surface touches are kept, with one
/// layer less; what lies between is meshed anew. Where that fails, everything is meshed anew; each such
/// retreat is told in `warnings`.
///
/// `geometry` knows the surfaces by the numbers in the operands' surfaces, `n_surfaces` of them.
/// Throws InputError where the result is empty or nothing succeeds.
Merged merge_operands(std::span<const Operand> operands, const CsgTree& tree, const RemeshGeometry& geometry,
                      std::uint32_t n_surfaces, const MergeSettings& settings,
                      std::vector<std::string>& warnings);

}  // namespace maille::modeler
