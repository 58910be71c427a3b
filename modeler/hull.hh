#pragma once

#include <memory>
#include <vector>

#include "modeler/primitive.hh"

namespace maille::modeler {

/// The convex hull of points, exact; facets that lie in one plane, to rounding, are one face. Faces
/// `patch<i>`, parted where the surface bends by 30 degrees or more. Throws InputError where all points lie
/// in one plane.
std::shared_ptr<const Shape> make_hull(const std::vector<Point>& points, const Eigen::Affine3d& frame);

}  // namespace maille::modeler
