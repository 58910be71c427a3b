#pragma once

#include "modeler/primitive.hh"

namespace maille::modeler {

/// The image of the unit sphere under an affine map.
class Ellipsoid final : public Shape {
  public:
    explicit Ellipsoid(const Eigen::Affine3d& map);

    std::span<const PrimitiveFace> faces() const override;
    Eigen::AlignedBox3d bounding_box() const override;
    double implicit(const Point& p) const override;
    double face_implicit(std::uint32_t face, const Point& p) const override;
    Point face_normal(std::uint32_t face, const Point& p) const override;
    Eigen::Matrix3d face_curvature(std::uint32_t face, const Point& p) const override;
    Point project(std::uint32_t face, const Point& p) const override;
    double max_curvature(std::uint32_t face) const override;

    /// The map from the unit sphere.
    const Eigen::Affine3d& map() const { return map_; }
    /// In descending order.
    const Eigen::Vector3d& semi_axes() const { return semi_axes_; }

  private:
    Point gradient(const Point& on_surface) const;

    Eigen::Affine3d map_;
    Eigen::Matrix3d axes_;  ///< directions of the semi-axes, in columns
    Eigen::Vector3d semi_axes_;
    bool is_sphere_;
};

}  // namespace maille::modeler
