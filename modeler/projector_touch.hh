#pragma once

#include "modeler/projector_newton.hh"

namespace maille::modeler {

/// A point near p where the two surfaces touch: one of both, with parallel normals. Where they touch along a
/// curve, about the nearest. Nothing where an iteration from p finds none within `size` of it. The result is
/// within 1e-12 `size` of both.
std::optional<Point> touching_point(const ShapeFace& a, const ShapeFace& b, const Point& p, double size);

}  // namespace maille::modeler
