#include "modeler/shape_frame.hh"

#include <cmath>
#include <numbers>

#include <Eigen/SVD>
#include <fmt/format.h>

#include "volmesh/error.hh"

namespace maille::modeler {

void check_frame(const Eigen::Affine3d& frame) {
    if (!frame.matrix().allFinite()) throw InputError("the transformation holds numbers that are not finite");
    const double largest = largest_stretch(frame.linear());
    if (!(smallest_stretch(frame.linear()) > 1e-12 * largest))
        throw InputError("the transformation squashes the solid flat: its matrix is singular");
}

void check_positive(double value, const char* name) {
    if (!(value > 0) || !std::isfinite(value))
        throw InputError(fmt::format("{} is {}; it has to be greater than 0", name, value));
}

void check_not_negative(double value, const char* name) {
    if (!(value >= 0) || !std::isfinite(value))
        throw InputError(fmt::format("{} is {}; it must not be negative", name, value));
}

bool is_similarity(const Eigen::Matrix3d& linear) {
    const Eigen::Matrix3d gram = linear.transpose() * linear;
    const double scale = gram.trace() / 3;
    return (gram - scale * Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= 1e-14 * scale;
}

double largest_stretch(const Eigen::Matrix3d& linear) {
    return Eigen::JacobiSVD<Eigen::Matrix3d>(linear).singularValues()[0];
}

double smallest_stretch(const Eigen::Matrix3d& linear) {
    return Eigen::JacobiSVD<Eigen::Matrix3d>(linear).singularValues()[2];
}

Eigen::Vector2d unit_circle(int i, int n) {
    const long long eighths = 8LL * i;
    const long long octant = (eighths % (8LL * n) + 8LL * n) % (8LL * n) / n;
    // The angle from the nearest axis, at most an eighth of the circle.
    const long long quarter = (octant + 1) / 2;
    const long long rest = (eighths % (8LL * n) + 8LL * n) % (8LL * n) - 2 * quarter * n;
    double c = std::cos(std::numbers::pi / 4 * static_cast<double>(rest) / n);
    double s = std::sin(std::numbers::pi / 4 * static_cast<double>(rest) / n);
    if (rest == n || rest == -n) s = std::copysign(c = std::numbers::sqrt2 / 2, s);
    switch (quarter % 4) {
        case 0:
            return {c, s};
        case 1:
            return {-s, c};
        case 2:
            return {-c, -s};
        default:
            return {s, -c};
    }
}

Eigen::Matrix3d level_set_curvature(const Eigen::Vector3d& gradient, const Eigen::Matrix3d& hessian) {
    const double length = gradient.norm();
    const Eigen::Vector3d n = gradient / length;
    const Eigen::Matrix3d tangential = Eigen::Matrix3d::Identity() - n * n.transpose();
    return tangential * hessian * tangential / length;
}

}  // namespace maille::modeler
