#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "modeler/merge_operand.hh"
#include "modeler/primitive.hh"
#include "modeler/shared_surface.hh"

namespace maille::modeler {

/// The way by which the second shape is the first one moved; nothing where it is another shape. Round solids
/// may be turned about themselves too, and polyhedra may differ by rounding.
std::optional<Eigen::Vector3d> translation_between(const Shape& from, const Shape& to);

/// For each primitive the number of the first that differs from it in place only: in shape up to a
/// translation, and in size. Where the curved surface is shared, not even in place.
std::vector<std::size_t> first_alike(const std::vector<Primitive>& primitives,
                                     const std::vector<double>& sizes,
                                     std::span<const std::shared_ptr<const SharedSurface>> shared);

/// The operand of a primitive that is another one moved. Its points are on its own surfaces: corners and
/// planes square to an axis to the bit.
Operand moved_operand(const Operand& original, const Primitive& from, const Primitive& to,
                      std::uint32_t first_surface_from, std::uint32_t first_surface_to);

}  // namespace maille::modeler
