#pragma once

#include <string>

#include "modeler/parser.hh"
#include "modeler/primitive.hh"

namespace maille::modeler {

/// The factors by which a `resize` node scales what has this box, as OpenSCAD does: to the new size where
/// that is not 0; where it is, not at all, or by the factor of the largest new size where `auto` says so. In
/// directions in which the box has no extent (z, for flat shapes) nothing changes.
Point resize_factors(const Node& node, const std::string& file, const Eigen::AlignedBox3d& box);

}  // namespace maille::modeler
