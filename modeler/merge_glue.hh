#pragma once

#include <cstdint>
#include <span>

#include "modeler/facet_complex.hh"
#include "modeler/merge_operand.hh"
#include "modeler/merge_zone.hh"
#include "modeler/tetrahedralize.hh"

namespace maille::modeler {

/// The part of a zone's surface that bounds something to be meshed, with the points that it uses.
FacetComplex bounds_of_new_cells(const FacetComplex& zone);

/// Puts the kept cells and the new ones together at the vertices that they have in common. `bounds` is what
/// was meshed, `zone` the whole of it with the facets between kept cells and others. Throws InputError where
/// the parts do not fit.
Merged glue(std::span<const Operand> operands, const KeptCells& kept, const FacetComplex& zone,
            const FacetComplex& bounds, const ComplexMesh& new_cells, std::uint32_t shell_surface);

/// Throws InputError unless the faces named are exactly those on the boundary and between regions, and the
/// cells of each region have the volume that its faces enclose.
void verify(const Merged& merged);

}  // namespace maille::modeler
