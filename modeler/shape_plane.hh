#pragma once

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "modeler/primitive.hh"

namespace maille::modeler {

/// Anything nearer to a surface than this is on it: what rounding leaves of a point computed near `p`.
inline double rounding_at(const Point& p, double size) {
    return 4 * std::numeric_limits<double>::epsilon() * (p.cwiseAbs().maxCoeff() + size);
}

/// A plane with a unit normal. Where it is axis-aligned, it is so exactly.
class Plane {
  public:
    Plane() = default;
    Plane(const Point& origin, const Point& normal) : origin_(origin), normal_(normal.normalized()) {
        Eigen::Index axis = 0;
        const double largest = normal_.cwiseAbs().maxCoeff(&axis);
        const double rest = (normal_ - normal_[axis] * Point::Unit(axis)).norm();
        if (rest <= 1e-14 * largest) {
            axis_ = static_cast<int>(axis);
            normal_ = std::copysign(1.0, normal_[axis]) * Point::Unit(axis);
        }
        u_ = normal_.cross(Point::Unit((axis + 2) % 3)).normalized();
        v_ = normal_.cross(u_);
    }

    /// Coordinates in the plane, true to length; positively oriented seen from the normal's side.
    Eigen::Vector2d flatten(const Point& p) const { return {u_.dot(p - origin_), v_.dot(p - origin_)}; }
    Point unflatten(const Eigen::Vector2d& q) const { return project(origin_ + q.x() * u_ + q.y() * v_); }

    const Point& normal() const { return normal_; }
    const Point& origin() const { return origin_; }
    double distance(const Point& p) const { return normal_.dot(p - origin_); }

    Point project(const Point& p) const {
        Point image = p;
        if (axis_ >= 0) {
            image[axis_] = origin_[axis_];
            return image;
        }
        const double d = distance(p);
        if (std::abs(d) <= rounding_at(p, (p - origin_).cwiseAbs().maxCoeff())) return p;
        image -= d * normal_;
        return image - distance(image) * normal_;
    }

  private:
    Point origin_ = Point::Zero();
    Point normal_ = Point::UnitZ();
    Point u_ = Point::UnitX(), v_ = Point::UnitY();
    int axis_ = -1;  ///< the axis that the plane is square to, if any
};

}  // namespace maille::modeler
