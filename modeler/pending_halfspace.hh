#pragma once

#include <optional>
#include <span>

#include "modeler/model.hh"

namespace maille::modeler {

/// A half-space of a model that has no shape yet: it cannot take one before the size of everything else is
/// known.
struct PendingHalfspace {
    std::uint32_t primitive;
    Point point;   ///< in space
    Point normal;  ///< likewise, of length 1, out of it
};

/// Gives every half-space the piece of it that covers the solids that have an end. Does nothing but return
/// the primitive of a half-space that makes the model endless, if one does.
std::optional<std::uint32_t> shape_halfspaces(Model& model, std::span<const PendingHalfspace> halfspaces);

}  // namespace maille::modeler
