#pragma once

#include <vector>

#include "modeler/model.hh"

namespace maille::modeler {

/// Points whose convex hull is that of the solid that the model's tree makes: the corners of its boundary.
/// Round primitives count as polyhedra with edges of a fortieth of their size. None where the solid is empty.
std::vector<Point> boundary_points(const Model& model);

/// The box of that solid; exact but where an intersection or difference cuts round primitives, which is right
/// to 1e-4 of the size. Empty where the solid is empty.
Eigen::AlignedBox3d solid_box(const Model& model);

}  // namespace maille::modeler
