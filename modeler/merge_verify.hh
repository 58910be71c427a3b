#pragma once

#include <span>

#include "modeler/merge_operand.hh"

namespace maille::modeler {

/// Throws InputError unless the faces named are exactly those on the boundary and between regions, and the
/// new cells of each region have the volume that these and the kept cells leave them. `seams` are the faces
/// at which kept cells were put together with others or with nothing; what lies beyond them is as it was and
/// not looked at.
void verify(const Merged& merged, std::span<const volmesh::HalffaceHandle> seams);

}  // namespace maille::modeler
