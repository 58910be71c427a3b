#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "modeler/facet_complex.hh"
#include "modeler/merge_operand.hh"

namespace maille::modeler {

/// Stands for the cells that are kept where a complex bounds what is to be meshed anew.
inline constexpr Region kept_part = -2;

/// Which cells of the operands stay as they are: by operand, by cell.
using KeptCells = std::vector<std::vector<std::uint8_t>>;

/// Cells stay that belong to the region of their operand, that no facet of the interface touches other than
/// as one of the operand's own triangles, and that share no vertex with a cell that one does touch.
KeptCells choose_kept_cells(std::span<const Operand> operands, const CsgTree& tree,
                            const FacetComplex& interface);

/// The surface of what is left: the interface, its facets frozen where they are faces of kept cells, and the
/// kept cells' other faces, frozen, with `shell_surface` as their surface. Kept cells' sides have the region
/// `kept_part`.
FacetComplex zone_complex(std::span<const Operand> operands, const KeptCells& kept,
                          const FacetComplex& interface, std::uint32_t shell_surface);

}  // namespace maille::modeler
