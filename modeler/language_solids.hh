#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "modeler/model.hh"
#include "modeler/parser.hh"

namespace maille::modeler {

/// Where a solid of the model language stands, and how round it is.
struct Placement {
    Eigen::Affine3d frame = Eigen::Affine3d::Identity();
    Facets facets = Facets::automatic;
};

using SolidMaker = std::shared_ptr<const Shape> (*)(const Node&, const std::string& file, const Placement&);

/// The function that makes the solid of this name; null where there is none.
/// The function throws InputError with file, line and column for arguments of which no solid can be made.
SolidMaker find_solid(std::string_view name);
std::vector<std::string_view> solid_names();

}  // namespace maille::modeler
