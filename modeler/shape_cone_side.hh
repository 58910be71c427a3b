#pragma once

#include "modeler/primitive.hh"

namespace maille::modeler {

/// The affine image of the surface x^2 + y^2 = radius(z)^2, radius(z) = (1 - z) r1 + z r2 >= 0: a circular or
/// elliptic, right or oblique, cylinder or single cone.
class ConeSide {
  public:
    ConeSide(double r1, double r2, const Eigen::Affine3d& map);

    double radius(double z) const { return r1_ + z * (r2_ - r1_); }
    double implicit(const Point& p) const;
    Point project(const Point& p) const;
    Point normal(const Point& p) const;
    Eigen::Matrix3d curvature(const Point& p) const;
    double max_curvature() const { return max_curvature_; }

  private:
    enum class Kind : std::uint8_t { right_circular, cylinder, cone };

    Point gradient(const Point& reference) const;
    double find_max_curvature() const;
    Eigen::Matrix3d curvature_at(const Point& reference) const;
    Point nearest_on_right_circular(const Point& p) const;
    Point nearest_on_cylinder(const Point& p) const;
    Point nearest_on_cone(const Point& p) const;

    double r1_, r2_;
    Eigen::Affine3d map_, inverse_;
    Kind kind_;
    double size_;
    double max_curvature_;
    Point apex_ = Point::Zero();
    Eigen::Matrix3d axes_ =
        Eigen::Matrix3d::Identity();  ///< principal axes, in columns; the last is the solid's
    Eigen::Vector2d
        semi_axes_;  ///< cylinder: of its cross-section; cone: of that at distance 1 from the apex
};

}  // namespace maille::modeler
