#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "modeler/parser.hh"
#include "modeler/primitive.hh"

namespace maille::modeler {

using TransformReader = Eigen::Affine3d (*)(const Node&, const std::string& file);

/// The function that reads a transform of this name (`translate`, `rotate`, ...); null where there is none.
TransformReader find_transform(std::string_view name);
std::vector<std::string_view> transform_names();

/// The turn by an angle about an axis through the origin; right angles are exact.
Eigen::Matrix3d rotation(const Point& axis, double degrees);

/// The mirror image by the plane through the origin with that normal.
Eigen::Matrix3d mirror_image(const Point& normal);

/// Whether the map is finite and flattens nothing: its condition number is less than 1e12.
bool is_regular(const Eigen::Affine3d& map);

}  // namespace maille::modeler
