#pragma once

#include "modeler/merge_operand.hh"
#include "quality/projection_result.hh"
#include "volmesh/projector.hh"

namespace maille::modeler {

/// Brings the new vertices of a merged mesh onto all the surfaces that their faces lie on, as far as no cell
/// is spoilt and the boundary does not come to cross itself. Kept cells stay as they are: their vertices are
/// there already. The mesh has its sets: they tell which vertices may make room. `projector` is the model's.
quality::ProjectionResult project_new_vertices(Merged& merged, const volmesh::Projector& projector);

}  // namespace maille::modeler
