#pragma once

#include "modeler/primitive.hh"

namespace maille::modeler {

/// The affine image of a torus around z.
class Torus final : public Shape {
  public:
    Torus(double major, double minor, const Eigen::Affine3d& map);

    std::span<const PrimitiveFace> faces() const override;
    Eigen::AlignedBox3d bounding_box() const override;
    double implicit(const Point& p) const override;
    double face_implicit(std::uint32_t face, const Point& p) const override;
    Point face_normal(std::uint32_t face, const Point& p) const override;
    Eigen::Matrix3d face_curvature(std::uint32_t face, const Point& p) const override;
    Point project(std::uint32_t face, const Point& p) const override;
    double max_curvature(std::uint32_t face) const override;

    const Eigen::Affine3d& map() const { return map_; }
    double major() const { return major_; }
    double minor() const { return minor_; }

  private:
    /// Angles around the axis and around the tube.
    using Angles = Eigen::Vector2d;

    Point gradient(const Point& reference) const;
    Eigen::Matrix3d curvature_at(const Point& reference) const;
    Point reference_point(const Angles& angles) const;
    Point nearest_on_round(const Point& p) const;
    Point nearest_on_image(const Point& p) const;
    Angles descend(Angles angles, const Point& p) const;

    double major_, minor_;
    Eigen::Affine3d map_, inverse_;
    bool is_round_;
    double size_, least_stretch_;
    double reach_;  ///< the nearest point is unique for whatever is no further away
    double max_curvature_;
};

}  // namespace maille::modeler
