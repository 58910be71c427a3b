#include "modeler/projector_touch.hh"

#include <cmath>

#include <Eigen/SVD>

#include "modeler/shape_plane.hh"

namespace maille::modeler {
namespace {

struct Contact {
    Point foot, normal;
    Eigen::Matrix3d curvature;
};

Contact contact_at(const ShapeFace& target, const Point& x) {
    const Point foot = target.shape->project(target.face, x);
    return {foot, target.shape->face_normal(target.face, foot),
            target.shape->face_curvature(target.face, foot)};
}

/// Newton's step towards both surfaces and towards parallel normals; the shortest where they stay parallel
/// along some way.
Point step_to_touch(const Contact& a, const Contact& b, const Point& x) {
    constexpr double least_bend = 1e-5;  // of one surface against the other, to the size of their curvatures
    const double sense = a.normal.dot(b.normal) < 0 ? -1 : 1;
    const Point normal = (a.normal + sense * b.normal).normalized();
    const double to_surfaces = -normal.dot((x - a.foot) + (x - b.foot)) / 2;

    const Eigen::Matrix3d along = Eigen::Matrix3d::Identity() - normal * normal.transpose();
    const Eigen::Matrix3d bend = along * (a.curvature - sense * b.curvature) * along;
    Eigen::JacobiSVD<Eigen::Matrix3d> svd(bend, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double scale = a.curvature.norm() + b.curvature.norm();
    if (!(svd.singularValues()[0] > least_bend * scale)) return to_surfaces * normal;
    svd.setThreshold(least_bend * scale / svd.singularValues()[0]);
    return to_surfaces * normal - svd.solve(Point(along * (a.normal - sense * b.normal)));
}

}  // namespace

std::optional<Point> touching_point(const ShapeFace& a, const ShapeFace& b, const Point& p, double size) {
    constexpr int most_iterations = 50;
    constexpr double parallel = 1e-6;  // sine of the angle between normals
    Point x = p;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        const Contact on_a = contact_at(a, x), on_b = contact_at(b, x);
        Point step = step_to_touch(on_a, on_b, x);
        if (!step.allFinite()) return std::nullopt;
        if (step.norm() > size / 4) step *= size / 4 / step.norm();
        x += step;
        if ((x - p).norm() > size) return std::nullopt;
        if (step.norm() > 1e-14 * size + rounding_at(x, 0)) continue;
        const bool on_both = (x - on_a.foot).norm() + (x - on_b.foot).norm() <= 1e-12 * size;
        const bool touching = on_a.normal.cross(on_b.normal).norm() <= parallel;
        return on_both && touching ? std::optional(x) : std::nullopt;
    }
    return std::nullopt;
}

}  // namespace maille::modeler
