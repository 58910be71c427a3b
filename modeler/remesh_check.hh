#pragma once

#include "modeler/remesh_session.hh"

namespace maille::modeler::remeshing {

/// The sine of the smallest angle: 0 for a triangle without area, 0.87 for an equilateral one.
double quality(const Corners& corners);

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b);

double worst_quality(const Net& net, std::span<const Index> triangles);

/// Of the added triangles, as they will be.
double worst_quality(const Net& net, const Change& change);

/// Makes the change if its triangles are at least so good, point the way their surfaces do, and meet no other
/// triangle; and if nothing stands where the sheets sweep.
bool try_change(Session& session, const Change& change, double least_quality);

}  // namespace maille::modeler::remeshing
