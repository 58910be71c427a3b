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
/// was meshed, `zone` the whole of it with the facets between kept cells and others. The operand of which the
/// most is kept is taken as it is, or a copy of it, and all else put in the place of what goes there. What
/// comes out is verified. Throws InputError where the parts do not fit.
Merged glue(std::span<Operand> operands, std::span<const KeptPart> kept, const FacetComplex& zone,
            const FacetComplex& bounds, const ComplexMesh& new_cells, std::uint32_t shell_surface,
            bool may_take_mesh);

}  // namespace maille::modeler
