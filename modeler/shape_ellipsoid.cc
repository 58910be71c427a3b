#include "modeler/shape_ellipsoid.hh"

#include <array>

#include <Eigen/SVD>

#include "modeler/shape_frame.hh"
#include "modeler/shape_nearest.hh"
#include "modeler/shape_plane.hh"

namespace maille::modeler {

Ellipsoid::Ellipsoid(const Eigen::Affine3d& map) : map_(map), is_sphere_(is_similarity(map.linear())) {
    check_frame(map);
    if (is_sphere_) {
        axes_.setIdentity();
        semi_axes_.setConstant(std::cbrt(std::abs(map.linear().determinant())));
        return;
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(map.linear(), Eigen::ComputeThinU);
    axes_ = svd.matrixU();
    semi_axes_ = svd.singularValues();
}

std::span<const PrimitiveFace> Ellipsoid::faces() const {
    static const std::array<PrimitiveFace, 1> surface{{{"surface", false}}};
    return surface;
}

Eigen::AlignedBox3d Ellipsoid::bounding_box() const {
    const Point centre = map_.translation(), reach = map_.linear().rowwise().norm();
    return {centre - reach, centre + reach};
}

double Ellipsoid::implicit(const Point& p) const {
    const Point from_centre = p - map_.translation();
    if (is_sphere_) return from_centre.norm() - semi_axes_[0];
    const Point unit = (axes_.transpose() * from_centre).cwiseQuotient(semi_axes_);
    const double norm = unit.norm();
    if (norm == 0) return -semi_axes_[2];
    return (norm - 1) * norm / unit.cwiseQuotient(semi_axes_).norm();
}

double Ellipsoid::face_implicit(std::uint32_t, const Point& p) const {
    return implicit(p);
}

Point Ellipsoid::project(std::uint32_t, const Point& p) const {
    const Point from_centre = p - map_.translation();
    if (std::abs(implicit(p)) <= rounding_at(p, semi_axes_[0])) return p;
    if (is_sphere_) {
        const double distance = from_centre.norm();
        const Point direction = distance > 0 ? Point(from_centre / distance) : Point::UnitZ();
        return map_.translation() + semi_axes_[0] * direction;
    }
    return map_.translation() + axes_ * nearest_on_ellipsoid<3>(semi_axes_, axes_.transpose() * from_centre);
}

Point Ellipsoid::gradient(const Point& on_surface) const {
    const Point local = axes_.transpose() * (on_surface - map_.translation());
    return axes_ * local.cwiseQuotient(semi_axes_).cwiseQuotient(semi_axes_);
}

Point Ellipsoid::face_normal(std::uint32_t face, const Point& p) const {
    return gradient(project(face, p)).normalized();
}

Eigen::Matrix3d Ellipsoid::face_curvature(std::uint32_t face, const Point& p) const {
    const Eigen::Matrix3d hessian =
        axes_ * semi_axes_.cwiseAbs2().cwiseInverse().asDiagonal() * axes_.transpose();
    return level_set_curvature(gradient(project(face, p)), hessian);
}

double Ellipsoid::max_curvature(std::uint32_t) const {
    return semi_axes_[0] / (semi_axes_[2] * semi_axes_[2]);
}

}  // namespace maille::modeler
