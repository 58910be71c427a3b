#pragma once

#include <array>
#include <span>

#include <Eigen/Core>

namespace maille::modeler {

/// Whether a tetrahedron and a triangle, both closed, may come nearer than `margin` to each other: never
/// false where they do.
bool may_touch(const std::array<Eigen::Vector3d, 4>& cell, const std::array<Eigen::Vector3d, 3>& triangle,
               double margin);

}  // namespace maille::modeler
