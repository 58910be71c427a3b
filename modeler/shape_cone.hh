#pragma once

#include <optional>
#include <vector>

#include "modeler/shape_cone_side.hh"
#include "modeler/shape_plane.hh"

namespace maille::modeler {

/// The affine image of a cylinder, cone or frustum: what lies between z = 0 and z = 1, within (1 - z) r1 + z
/// r2 of the z axis. The larger radius is 1; where a radius is 0 that cap does not exist.
class Cone final : public Shape {
  public:
    Cone(double r1, double r2, const Eigen::Affine3d& map);

    std::span<const PrimitiveFace> faces() const override { return faces_; }
    Eigen::AlignedBox3d bounding_box() const override;
    double implicit(const Point& p) const override;
    double face_implicit(std::uint32_t face, const Point& p) const override;
    Point face_normal(std::uint32_t face, const Point& p) const override;
    Eigen::Matrix3d face_curvature(std::uint32_t face, const Point& p) const override;
    Point project(std::uint32_t face, const Point& p) const override;
    double max_curvature(std::uint32_t face) const override;

    const Eigen::Affine3d& map() const { return map_; }
    double radius(double z) const { return side_.radius(z); }
    /// The face of the cap at z = 0 or 1, or nothing.
    const std::optional<std::uint32_t>& cap(bool top) const { return top ? top_ : bottom_; }

  private:
    Eigen::Affine3d map_;
    ConeSide side_;  ///< face 0
    std::vector<PrimitiveFace> faces_;
    std::vector<Plane> caps_;  ///< of face 1 and on
    std::optional<std::uint32_t> bottom_, top_;
};

}  // namespace maille::modeler
