#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "modeler/model.hh"

namespace maille::modeler {

/// By primitive: whether it is worth a mesh of its own, of `sizes[i]`. A large mesh is not worth making of
/// which less than a tenth will be kept, as of a ball that becomes a thin shell: what is left is sooner
/// meshed together with the others. Judged by places all over the primitive: kept is what belongs to it
/// in the tree and is farther from the other primitives than cells that are kept have to be.
std::vector<std::uint8_t> worth_meshing(const Model& model, std::span<const double> sizes);

}  // namespace maille::modeler
