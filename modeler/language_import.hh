#pragma once

#include "modeler/language_solids.hh"

namespace maille::modeler {

/// The solid in the file that an `import` node names, by its path from the model's folder: a closed surface
/// in an .stl, .off or .obj file. Faces `patch<i>`, parted where the surface bends by 30 degrees or more.
std::shared_ptr<const Shape> import(const Node& node, const std::string& file, const Placement& placement);

}  // namespace maille::modeler
