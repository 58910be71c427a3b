#include "modeler/shape_turned_arc.hh"

#include <cmath>

#include <Eigen/LU>

#include "modeler/shape_plane.hh"

namespace maille::modeler {

TurnedArc::TurnedArc(const Eigen::Vector2d& centre, double radius, bool convex, const Eigen::Affine3d& map)
    : centre_(centre),
      radius_(radius),
      sense_(convex ? 1 : -1),
      map_(map),
      inverse_(map.inverse()),
      scale_(std::cbrt(std::abs(map.linear().determinant()))) {}

TurnedArc::Seen TurnedArc::seen(const Point& p) const {
    const Point reference = inverse_ * p;
    const double rho = reference.head<2>().norm();
    const Eigen::Vector2d from_centre(rho - centre_.x(), reference.z() - centre_.y());
    const double distance = from_centre.norm();
    return {.outward = rho > 0 ? Eigen::Vector2d(reference.head<2>() / rho) : Eigen::Vector2d::UnitX(),
            .direction = distance > 0 ? Eigen::Vector2d(from_centre / distance) : Eigen::Vector2d::UnitX(),
            .distance = distance};
}

Point TurnedArc::in_space(const Seen& seen) const {
    const Eigen::Vector2d& n = seen.direction;
    return map_.linear() * Point(n.x() * seen.outward.x(), n.x() * seen.outward.y(), n.y()) / scale_;
}

double TurnedArc::implicit(const Point& p) const {
    return sense_ * scale_ * (seen(p).distance - radius_);
}

Point TurnedArc::project(const Point& p) const {
    const Seen from = seen(p);
    const double off = scale_ * (radius_ - from.distance);
    if (std::abs(off) <= rounding_at(p, scale_ * (centre_.x() + radius_))) return p;
    return p + off * in_space(from);
}

Point TurnedArc::normal(const Point& p) const {
    return sense_ * in_space(seen(p)).normalized();
}

Eigen::Matrix3d TurnedArc::curvature(const Point& p) const {
    const Seen at = seen(p);
    const Eigen::Vector2d& n = at.direction;
    const Point along_arc =
        map_.linear() * Point(-n.y() * at.outward.x(), -n.y() * at.outward.y(), n.x()) / scale_;
    const Point around_axis = map_.linear() * Point(-at.outward.y(), at.outward.x(), 0) / scale_;
    // On a sphere both are alike; on the axis itself only a sphere is smooth.
    const double rho = centre_.x() + radius_ * n.x();
    const double around = centre_.x() == 0 ? 1 / radius_ : rho > 0 ? n.x() / rho : 0;
    return sense_ / scale_ *
           (along_arc * along_arc.transpose() / radius_ + around * around_axis * around_axis.transpose());
}

}  // namespace maille::modeler
