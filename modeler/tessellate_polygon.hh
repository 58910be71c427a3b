#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace maille::modeler {

using Triangle = std::array<std::uint32_t, 3>;

/// The constrained Delaunay triangulation of a plane region: what an odd number of the loops surrounds. It
/// uses all points, those of no loop too; its triangles are counter-clockwise. Throws InputError where loops
/// cross or touch each other, or themselves.
std::vector<Triangle> triangulate(std::span<const Eigen::Vector2d> points,
                                  std::span<const std::vector<std::uint32_t>> loops);

}  // namespace maille::modeler
