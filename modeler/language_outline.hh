#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "modeler/outline.hh"
#include "modeler/parser.hh"

namespace maille::modeler {

/// Whether the name is that of a node that makes or changes flat shapes only: `circle`, `offset`, ...
bool is_flat_node(std::string_view name);

/// How a node between an extrusion and its flat shapes combines them; nothing for other nodes.
std::optional<Operation> find_flat_operation(std::string_view name);

/// The flat shape that a node makes, with the polygons that OpenSCAD makes of circles. Throws InputError with
/// file, line and column where the node, or one in it, makes none.
Outline outline_of(const Node& node, const std::string& file);

/// All the nodes' shapes together.
Outline outline_of(const std::vector<Node>& nodes, const std::string& file);

/// What a transform does to flat shapes: its action on x and y.
Eigen::Affine2d flat_map(const Node& node, const std::string& file);

}  // namespace maille::modeler
