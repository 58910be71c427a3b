#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "modeler/facet_complex.hh"
#include "modeler/merge_interface.hh"
#include "modeler/merge_operand.hh"

namespace maille::modeler {

/// Stands for the cells that are kept where a complex bounds what is to be meshed anew.
inline constexpr Region kept_part = -2;

/// Which cells of an operand stay as they are.
struct KeptPart {
    std::size_t n_cells = 0;                     ///< that stay
    std::vector<std::uint8_t> is_kept;           ///< by cell
    std::vector<volmesh::CellHandle> gone;       ///< the others, ascending
    std::vector<volmesh::HalffaceHandle> sides;  ///< faces between cells that stay and others or nothing,
                                                 ///< seen from those that stay, ascending
};

/// Cells stay that belong to the region of their operand, that no facet of the interface touches other than
/// as one of the operand's own triangles, and that share no vertex with a cell that one does touch. By
/// operand; `table` is that of the interface.
std::vector<KeptPart> choose_kept_cells(std::span<const Operand> operands, const CsgTree& tree,
                                        const FacetComplex& interface, const InterfaceTable& table);

/// The surface of what is left: the interface, its facets frozen where they are faces of kept cells, and the
/// kept cells' other faces, frozen, with `shell_surface` as their surface. Kept cells' sides have the region
/// `kept_part`.
FacetComplex zone_complex(std::span<const Operand> operands, std::span<const KeptPart> kept,
                          const FacetComplex& interface, const InterfaceTable& table,
                          std::uint32_t shell_surface);

}  // namespace maille::modeler
