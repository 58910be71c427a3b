#include "modeler/shape_cone_side.hh"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "modeler/shape_frame.hh"
#include "modeler/shape_nearest.hh"
#include "modeler/shape_plane.hh"

namespace maille::modeler {
namespace {

bool is_right_circular(const Eigen::Matrix3d& linear) {
    const Eigen::Matrix3d gram = linear.transpose() * linear;
    const double tolerance = 1e-14;
    return std::abs(gram(0, 0) - gram(1, 1)) <= tolerance * gram(0, 0) &&
           std::abs(gram(0, 1)) <= tolerance * gram(0, 0) &&
           std::hypot(gram(0, 2), gram(1, 2)) <= tolerance * std::sqrt(gram(0, 0) * gram(2, 2));
}

}  // namespace

ConeSide::ConeSide(double r1, double r2, const Eigen::Affine3d& map)
    : r1_(r1), r2_(r2), map_(map), inverse_(map.inverse()) {
    const Eigen::Matrix3d& linear = map.linear();
    size_ = linear.norm();
    max_curvature_ = find_max_curvature();
    if (r1 != r2) apex_ = map * Point(0, 0, r1 / (r1 - r2));
    if (is_right_circular(linear)) {
        kind_ = Kind::right_circular;
        for (int i = 0; i < 3; ++i) axes_.col(i) = linear.col(i).normalized();
    } else if (r1 == r2) {
        kind_ = Kind::cylinder;
        axes_.col(2) = linear.col(2).normalized();
        const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - axes_.col(2) * axes_.col(2).transpose();
        const Eigen::JacobiSVD<Eigen::MatrixXd> svd(r1 * across * linear.leftCols<2>(), Eigen::ComputeThinU);
        axes_.leftCols<2>() = svd.matrixU();
        semi_axes_ = svd.singularValues();
    } else {
        // In the coordinates (x, y, radius(z)) the surface is x^2 + y^2 = z^2, z >= 0.
        kind_ = Kind::cone;
        const Eigen::Matrix3d to_cone = Eigen::Vector3d(1, 1, r2 - r1).asDiagonal() * inverse_.linear();
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(
            to_cone.transpose() * Eigen::Vector3d(1, 1, -1).asDiagonal() * to_cone);
        axes_ << eigen.eigenvectors().col(1), eigen.eigenvectors().col(2), eigen.eigenvectors().col(0);
        if (to_cone.row(2).dot(axes_.col(2)) < 0) axes_.col(2) = -axes_.col(2);
        for (int i = 0; i < 2; ++i)
            semi_axes_[i] = std::sqrt(-eigen.eigenvalues()[0] / eigen.eigenvalues()[i + 1]);
    }
}

Point ConeSide::gradient(const Point& reference) const {
    const double rho = reference.head<2>().norm();
    const Eigen::Vector2d outward =
        rho > 0 ? Eigen::Vector2d(reference.head<2>() / rho) : Eigen::Vector2d::UnitX();
    return inverse_.linear().transpose() * Point(outward.x(), outward.y(), r1_ - r2_);
}

double ConeSide::implicit(const Point& p) const {
    const Point reference = inverse_ * p;
    return (reference.head<2>().norm() - radius(reference.z())) / gradient(reference).norm();
}

Point ConeSide::normal(const Point& p) const {
    const Point on_surface = project(p);
    if (r1_ != r2_ && (on_surface - apex_).norm() <= rounding_at(p, size_)) {
        const Point from_apex = p - apex_;
        const Point outward = map_.linear().col(2) * (r1_ - r2_);
        return (from_apex.norm() > 0 ? from_apex : outward).normalized();
    }
    return gradient(inverse_ * on_surface).normalized();
}

Eigen::Matrix3d ConeSide::curvature_at(const Point& reference) const {
    const double rho = reference.head<2>().norm();
    if (rho == 0) return Eigen::Matrix3d::Zero();
    const Point along(-reference.y() / rho, reference.x() / rho, 0);
    const Point turned = inverse_.linear().transpose() * along;
    return level_set_curvature(gradient(reference), turned * turned.transpose() / rho);
}

Eigen::Matrix3d ConeSide::curvature(const Point& p) const {
    return curvature_at(inverse_ * project(p));
}

double ConeSide::find_max_curvature() const {
    constexpr int samples = 360;
    const double z = (r1_ < r2_) == (std::min(r1_, r2_) > 0) ? 0 : 1;
    double largest = 0;
    for (int i = 0; i < samples; ++i) {
        const Eigen::Vector2d direction = radius(z) * unit_circle(i, samples);
        largest = std::max(largest, curvature_at({direction.x(), direction.y(), z}).norm());
    }
    return largest;
}

Point ConeSide::project(const Point& p) const {
    if (std::abs(implicit(p)) <= rounding_at(p, size_)) return p;
    switch (kind_) {
        case Kind::right_circular:
            return nearest_on_right_circular(p);
        case Kind::cylinder:
            return nearest_on_cylinder(p);
        case Kind::cone:
            break;
    }
    return nearest_on_cone(p);
}

Point ConeSide::nearest_on_right_circular(const Point& p) const {
    const double scale = map_.linear().col(0).norm(), height = map_.linear().col(2).norm();
    const Eigen::Vector2d along = Eigen::Vector2d(scale * (r2_ - r1_), height).normalized();
    const Point axis = axes_.col(2);
    Point image = p;
    for (int pass = 0; pass < 2; ++pass) {  // the second takes away the rounding of a long way
        const Point from_base = image - map_.translation();
        const double z = axis.dot(from_base);
        const Point radial = from_base - z * axis;
        const double rho = radial.norm();
        const Point outward = rho > 0 ? Point(radial / rho) : Point(axes_.col(0));
        const double distance = (rho - scale * r1_) * along.y() - z * along.x();
        if (rho - distance * along.y() < 0) return apex_;
        image -= distance * along.y() * outward - distance * along.x() * axis;
    }
    return image;
}

Point ConeSide::nearest_on_cylinder(const Point& p) const {
    const Eigen::Vector2d local = axes_.leftCols<2>().transpose() * (p - map_.translation());
    return p + axes_.leftCols<2>() * (nearest_on_ellipsoid<2>(semi_axes_, local) - local);
}

// The principal axes give the right generator. Where the apex is far away they give it roughly only, and a
// few steps of Newton's method, on the generator's angle and the place on it, make it sharp.
Point ConeSide::nearest_on_cone(const Point& p) const {
    const Point found =
        nearest_on_elliptic_cone(semi_axes_[0], semi_axes_[1], axes_.transpose() * (p - apex_));
    const Point reference = inverse_ * (apex_ + axes_ * found);
    const double rho = reference.head<2>().norm();
    if (rho == 0) return apex_;

    Eigen::Vector2d direction = reference.head<2>() / rho;
    double z = reference.z();
    const auto column = [&](const Eigen::Vector2d& xy, double height) {
        return Point(map_.linear() * Point(xy.x(), xy.y(), height));
    };
    const auto generator = [&] { return column((r2_ - r1_) * direction, 1); };
    const auto nearest_on_generator = [&] {
        const Point base = map_ * Point(r1_ * direction.x(), r1_ * direction.y(), 0);
        return generator().dot(p - base) / generator().squaredNorm();
    };
    const auto image = [&] { return map_ * Point(radius(z) * direction.x(), radius(z) * direction.y(), z); };
    for (int iteration = 0; iteration < 3; ++iteration) {
        z = nearest_on_generator();
        const Eigen::Vector2d turned(-direction.y(), direction.x());
        const Point error = p - image();
        const Point by_angle = column(radius(z) * turned, 0), by_height = generator();
        const double aa = by_angle.squaredNorm() + error.dot(column(radius(z) * direction, 0));
        const double ah = by_angle.dot(by_height) - error.dot(column((r2_ - r1_) * turned, 0));
        const double curvature = aa - ah * ah / by_height.squaredNorm();
        if (!(curvature > 1e-9 * by_angle.squaredNorm())) break;
        const double step = error.dot(by_angle) / curvature;
        if (!(std::abs(step) < 1e-2)) break;
        direction = (direction + step * turned).normalized();
    }
    z = nearest_on_generator();
    return radius(z) > 0 ? image() : apex_;
}

}  // namespace maille::modeler
