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

/// The kept cells, or vertices, of a merged mesh, which come first in it: those of the operand of which the
/// most cells are kept, its base, then those of the others.
struct Kept {
    std::uint32_t base = 0;    ///< the operand
    std::uint32_t n_base = 0;  ///< so many are the base's, under the numbers that they had, but for those
    std::vector<std::uint32_t> moved{};  ///< of its numbers from n_base on: where these went, if anywhere
    std::vector<Origin> further{};

    std::uint32_t size() const { return n_base + static_cast<std::uint32_t>(further.size()); }
    std::uint32_t operand(std::uint32_t i) const { return i < n_base ? base : further[i - n_base].operand; }
    std::vector<Origin> origins() const;
};

/// What merging yields.
struct Merged {
    volmesh::TetMesh mesh;
    Kept kept_cells, kept_vertices;
    std::vector<std::uint32_t> regions_of_new;  ///< of each further cell: the operand that owns its place
    std::vector<InterfaceFace> faces;           ///< in the order of their half-faces

    /// The operand that owns the cell's place.
    std::uint32_t region(volmesh::CellHandle c) const {
        return c.idx() < kept_cells.size() ? kept_cells.operand(c.idx())
                                           : regions_of_new[c.idx() - kept_cells.size()];
    }
};

struct MergeSettings {
    bool keep_cells = true;  ///< false: everything is meshed anew
    double time_limit = 0;   ///< see TetrahedralizeOptions
    /// Whether the base's mesh may be taken from it and made the result, which leaves it none, but spares a
    /// copy: of large meshes, half of what the cells far from the interface cost.
    bool may_take_mesh = false;
};

/// The tree of the operands as one conforming mesh. Cells that no other surface touches are kept, with one
/// layer less; what lies between is meshed anew. Where that fails, everything is meshed anew; each such
/// retreat is told in `warnings`.
///
/// `geometry` knows the surfaces by the numbers in the operands' surfaces, `n_surfaces` of them.
/// Throws InputError where the result is empty or nothing succeeds.
Merged merge_operands(std::span<Operand> operands, const CsgTree& tree, const RemeshGeometry& geometry,
                      std::uint32_t n_surfaces, const MergeSettings& settings,
                      std::vector<std::string>& warnings);

}  // namespace maille::modeler
