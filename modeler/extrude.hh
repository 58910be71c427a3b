#pragma once

#include <memory>

#include "modeler/outline.hh"
#include "modeler/primitive.hh"

namespace maille::modeler {

/// As OpenSCAD's `linear_extrude`: the shape is turned clockwise by `twist` degrees on the way up, and is
/// `scale` times as large at the top, in `slices` equal steps.
struct LinearExtrusion {
    double height = 1;
    bool center = false;
    double twist = 0;
    int slices = 1;
    Point2 scale{1, 1};
};

/// As OpenSCAD's `rotate_extrude`: the shape's x is the distance from z, its y is z. A full turn begins on
/// the negative x axis, a part of one on the positive, counter-clockwise for an `angle` above 0.
struct RotateExtrusion {
    double angle = 360;  ///< in degrees
    int fragments = 0;   ///< facets on the way round
};

/// Faces `bottom`, `top` and, one for each edge of the region's loops, `side<i>`, counted from `first_side`.
/// A side that is twisted is cut into triangles as OpenSCAD 2021 does. Throws InputError where that is no
/// solid.
std::shared_ptr<const Shape> linear_extrude(const PlaneRegion& region, const LinearExtrusion& extrusion,
                                            std::size_t first_side, const Eigen::Affine3d& frame);

/// Faces `side<i>` and, unless the turn is full, `start` and `end`. The region must not reach across x = 0.
std::shared_ptr<const Shape> rotate_extrude(const PlaneRegion& region, const RotateExtrusion& extrusion,
                                            std::size_t first_side, const Eigen::Affine3d& frame);

/// The same truly round: each edge sweeps an annulus or the side of a cylinder or cone.
std::shared_ptr<const Shape> rotate_extrude_round(const PlaneRegion& region, double angle,
                                                  std::size_t first_side, const Eigen::Affine3d& frame);

}  // namespace maille::modeler
