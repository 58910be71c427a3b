#pragma once

#include "modeler/arrange_kernel.hh"

namespace maille::modeler::detail {

/// Looks at a plane along the axis that it faces most: drops that coordinate. What runs counter-clockwise
/// around the normal of the plane does so in the image.
class Projection {
  public:
    /// The plane through three points that are not on a line; its normal by the right-hand rule.
    Projection(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c);

    Exact::Point_2 operator()(const ExactPoint& p) const {
        switch (axis_) {
            case 0:
                return mirrored_ ? Exact::Point_2(p.z(), p.y()) : Exact::Point_2(p.y(), p.z());
            case 1:
                return mirrored_ ? Exact::Point_2(p.x(), p.z()) : Exact::Point_2(p.z(), p.x());
            default:
                return mirrored_ ? Exact::Point_2(p.y(), p.x()) : Exact::Point_2(p.x(), p.y());
        }
    }

    /// The point of the plane that has this image.
    ExactPoint lift(const Exact::Point_2& p, const ExactPlane& plane) const;

  private:
    int axis_;
    bool mirrored_;
};

}  // namespace maille::modeler::detail
