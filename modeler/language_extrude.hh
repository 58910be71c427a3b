#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "modeler/language_solids.hh"

namespace maille::modeler {

/// A boolean expression over shapes: what one node of the language stands for.
struct ShapeTree {
    Operation operation = Operation::join;
    std::shared_ptr<const Shape> shape;  ///< leaf only
    std::vector<ShapeTree> children{};
};

using Extruder = ShapeTree (*)(const Node&, const std::string& file, const Placement&);

/// The function that makes the solid of `linear_extrude` or `rotate_extrude`; null for another name.
///
/// Circles that are to be round become true cylinders and cones, or tori, since an extrusion of a union,
/// difference or intersection is that of the extrusions; not so in an `offset` or `hull`, under a twist or a
/// scale that differs in x and y, and where one of the shapes to turn reaches across the axis.
Extruder find_extruder(std::string_view name);
std::vector<std::string_view> extruder_names();

}  // namespace maille::modeler
