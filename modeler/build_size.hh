#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "modeler/arrange.hh"
#include "modeler/arrange_box_tree.hh"
#include "modeler/model.hh"

namespace maille::modeler {

/// The wanted edge length on the surfaces between a model's primitives: the smaller size of the two sides,
/// and less near surfaces whose curvature asks for shorter edges.
class SurfaceSize {
  public:
    /// `sizes` are those of the primitives; `tessellated` their surfaces as numbered by surfaces(model):
    /// their edges tell what curved surfaces need.
    SurfaceSize(const Model& model, std::vector<double> sizes, std::span<const ClosedSurface> tessellated);

    double operator()(const Eigen::Vector3d& p, Region front, Region back) const;

  private:
    struct FineSurface {
        std::shared_ptr<const Shape> shape;
        std::uint32_t face;
        double size;
        Eigen::AlignedBox3d box;
    };

    std::vector<double> sizes_;
    double largest_;
    std::vector<FineSurface> fine_;
    std::shared_ptr<const detail::BoxTree> reaches_;  ///< where they may matter
};

}  // namespace maille::modeler
