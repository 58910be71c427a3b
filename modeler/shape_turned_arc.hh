#pragma once

#include "modeler/primitive.hh"

namespace maille::modeler {

/// The image, by a map that keeps angles, of a circle turned about the z axis: a torus, or a sphere where the
/// centre is on the axis. A torus that crosses itself counts with what is nearest in the half-plane of the
/// point that is asked for.
class TurnedArc {
  public:
    /// `centre` is (distance from the axis, height). `convex`: the solid is on the side of the centre.
    TurnedArc(const Eigen::Vector2d& centre, double radius, bool convex, const Eigen::Affine3d& map);

    double implicit(const Point& p) const;
    Point project(const Point& p) const;
    Point normal(const Point& p) const;
    Eigen::Matrix3d curvature(const Point& p) const;

    const Eigen::Vector2d& centre() const { return centre_; }
    double radius() const { return radius_; }

  private:
    /// A point in the half-plane of its own, seen from the centre.
    struct Seen {
        Eigen::Vector2d outward;    ///< from the axis, in x and y
        Eigen::Vector2d direction;  ///< from the centre, in the half-plane
        double distance;            ///< from the centre
    };
    Seen seen(const Point& p) const;
    Point in_space(const Seen& seen) const;  ///< the direction as a unit vector

    Eigen::Vector2d centre_;
    double radius_;
    double sense_;  ///< 1 where the solid is on the side of the centre, else -1
    Eigen::Affine3d map_, inverse_;
    double scale_;
};

}  // namespace maille::modeler
