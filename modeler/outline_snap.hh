#pragma once

#include <span>
#include <vector>

#include "modeler/outline.hh"

namespace maille::modeler {

/// The shapes with corners that are nearer than `distance` to each other as one, in the earliest's place, and
/// edges bent to corners that are as near to them: what is flush but for that is flush to the bit. Loops that
/// are left with no inside are dropped.
std::vector<Outline> snapped(std::span<const Outline> shapes, double distance);

}  // namespace maille::modeler
