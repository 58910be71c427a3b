#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace maille::modeler::detail {

/// A straight piece of the outline of a region in the plane. The region is on its left.
struct FlatEdge {
    std::uint32_t from, to;
    std::uint32_t region;
};

/// A triangle, counter-clockwise, and its region.
using FlatTriangle = std::pair<std::array<std::uint32_t, 3>, std::uint32_t>;

/// Triangulates regions inside their outlines, with all the points in them, as a constrained Delaunay
/// triangulation in which the segments `kept` occur. Nothing where segments cross, or where a part of an
/// outline does not come out as it was given.
std::optional<std::vector<FlatTriangle>> triangulate(std::span<const Eigen::Vector2d> points,
                                                     std::span<const FlatEdge> outline,
                                                     std::span<const std::array<std::uint32_t, 2>> kept = {});

/// Looks at a plane along the axis that it faces most. What runs counter-clockwise around the normal does so
/// in the image.
class FlatView {
  public:
    explicit FlatView(const Eigen::Vector3d& normal) {
        int axis = 0;
        normal.cwiseAbs().maxCoeff(&axis);
        u_ = (axis + 1) % 3, v_ = (axis + 2) % 3;
        if (normal[axis] < 0) std::swap(u_, v_);
    }
    Eigen::Vector2d operator()(const Eigen::Vector3d& p) const { return {p[u_], p[v_]}; }

  private:
    int u_, v_;
};

}  // namespace maille::modeler::detail
