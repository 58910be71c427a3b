#pragma once

#include <optional>
#include <span>

#include "modeler/shape_plane.hh"

namespace maille::modeler {

/// The smallest box around what lies behind all the planes and within the box `world`; empty where nothing
/// does. With more than 100 planes those after the first 100 are left out, and the box may be larger.
Eigen::AlignedBox3d box_behind(std::span<const Plane> planes, const Eigen::AlignedBox3d& world);

/// The planes of a box.
std::vector<Plane> planes_of(const Eigen::AlignedBox3d& box);

/// Whether the box comes as far as an edge of the world.
bool reaches(const Eigen::AlignedBox3d& box, const Eigen::AlignedBox3d& world);

}  // namespace maille::modeler
