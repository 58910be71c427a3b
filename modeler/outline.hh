#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "modeler/csg_tree.hh"

namespace maille::modeler {

/// What OpenSCAD's six digits and a few transforms leave of places, relative to the diagonal of what they are
/// part of: nothing nearer than that is meant to be apart.
inline constexpr double written_precision = 1e-5;

/// A place in the plane.
using Point2 = Eigen::Vector2d;
/// A closed polygon by its corners.
using PlaneLoop = std::vector<Point2>;

/// A connected piece of the plane: its outline, counter-clockwise, then its holes, clockwise. A loop passes
/// each corner once, but loops may have corners in common.
using PlaneRegion = std::vector<PlaneLoop>;

/// A flat shape: regions that don't overlap.
using Outline = std::vector<PlaneRegion>;

/// What is inside an odd number of the loops, which may cross.
Outline make_outline(const std::vector<PlaneLoop>& loops);

/// Union, intersection, or the first without the others (`operation` is one of these). Corners that are
/// nearer to each other, or to an edge, than `written_precision` of the shapes' diagonal meet: what six
/// digits left between shapes that are meant to be flush. Other corners keep their coordinates to the bit;
/// those where edges cross are right to about 1e-15 of the greatest.
Outline combine(Operation operation, std::span<const Outline> shapes);

/// Affine image; the map must not be singular.
Outline transformed(Outline shape, const Eigen::Affine2d& map);

/// What becomes of convex corners.
enum class OffsetCorners { round, mitred, chamfered };

/// The shape grown by `distance`, or shrunk where that is negative. Round corners have facets whose middles
/// are at most `arc_tolerance` inside the true arc.
Outline offset(const Outline& shape, double distance, OffsetCorners corners, double arc_tolerance);

/// The smallest convex shape around all of them.
Outline convex_hull(std::span<const Outline> shapes);

}  // namespace maille::modeler
