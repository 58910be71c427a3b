#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "modeler/arrange_features.hh"

namespace maille::modeler::detail {

/// A triangle, counter-clockwise around the normal of its cluster, and its group.
using FilledTriangle = std::pair<std::array<std::uint32_t, 3>, std::uint32_t>;

/// Triangulates the groups of a cluster inside their outlines, with all the points: a constrained
/// Delaunay triangulation of the plane's image.
std::vector<FilledTriangle> fill(std::span<const OutlineEdge> outline, std::span<const std::uint32_t> points,
                                 const Cluster& cluster, const PointRegistry& registry);

}  // namespace maille::modeler::detail
