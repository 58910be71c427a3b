#include "modeler/coincident.hh"

#include <algorithm>
#include <cmath>

#include "modeler/meridian.hh"
#include "modeler/shape_frame.hh"

namespace maille::modeler {
namespace {

constexpr double tolerance = coincidence;

/// By how much the map stretches a circle about the z axis, where it makes one about the z axis of it.
std::optional<double> scale_about_axis(const Eigen::Affine3d& map) {
    const Eigen::Matrix2d across = map.linear().topLeftCorner<2, 2>();
    const double scale = std::sqrt(std::abs(across.determinant()));
    const Eigen::Matrix2d stretch = across.transpose() * across / (scale * scale);
    if (!((stretch - Eigen::Matrix2d::Identity()).norm() <= tolerance) ||
        !(map.linear().row(2).head<2>().norm() <= tolerance))
        return std::nullopt;
    return scale;
}

bool is_round(const Cone& cone, double slack) {
    const Eigen::Matrix3d gram = cone.map().linear().transpose() * cone.map().linear();
    return std::abs(gram(0, 0) / gram(1, 1) - 1) <= slack && std::abs(gram(0, 1)) <= slack * gram(0, 0) &&
           std::max(std::abs(gram(0, 2)), std::abs(gram(1, 2))) <= slack * std::sqrt(gram(0, 0) * gram(2, 2));
}

}  // namespace

bool near(double a, double b) {
    return std::abs(a - b) <= tolerance * std::max({1.0, std::abs(a), std::abs(b)});
}

bool meet(const Span& a, const Span& b) {
    return a.low <= b.high + tolerance && b.low <= a.high + tolerance;
}

std::optional<Span> span_on(const Cone& reference, const Cone& cone) {
    const Eigen::Affine3d map = reference.map().inverse() * cone.map();
    const Point bottom = map.translation(), way = map.linear().col(2);
    if (!(bottom.head<2>().norm() <= tolerance && way.head<2>().norm() <= tolerance)) return std::nullopt;
    const auto scale = scale_about_axis(map);
    if (!scale) return std::nullopt;
    const double top = bottom.z() + way.z();
    if (!near(*scale * cone.radius(0), reference.radius(bottom.z())) ||
        !near(*scale * cone.radius(1), reference.radius(top)))
        return std::nullopt;
    return Span{std::min(bottom.z(), top), std::max(bottom.z(), top)};
}

bool is_right_circular(const Cone& cone) {
    return is_round(cone, tolerance);
}

bool is_nearly_round(const Cone& cone) {
    return is_round(cone, 1e-5);
}

bool is_sphere(const Ellipsoid& shape) {
    return is_similarity(shape.map().linear());
}

bool are_equal(const Ellipsoid& a, const Ellipsoid& b) {
    const Eigen::Affine3d map = a.map().inverse() * b.map();
    const Eigen::Matrix3d gram = map.linear() * map.linear().transpose();
    return map.translation().norm() <= tolerance && (gram - Eigen::Matrix3d::Identity()).norm() <= tolerance;
}

bool are_equal(const Torus& a, const Torus& b) {
    const auto meridian = meridian_in(a.map(), b);
    const double slack = tolerance * a.major();
    return meridian && (meridian->centre - Eigen::Vector2d(a.major(), 0)).norm() <= slack &&
           (meridian->semi - Eigen::Vector2d::Constant(a.minor())).norm() <= slack;
}

bool are_ends_equal(const Cone& a, bool end_of_a, const Cone& b, bool end_of_b) {
    const Eigen::Affine3d map = a.map().inverse() * b.map();
    const auto scale = scale_about_axis(map);
    return scale && near(*scale * b.radius(end_of_b), a.radius(end_of_a)) &&
           (map * Point(0, 0, end_of_b) - Point(0, 0, end_of_a)).norm() <= tolerance;
}

std::optional<Eigen::Vector2d> touching_direction(const Cone& cylinder, const Point& normal, const Point& p) {
    const Point local = cylinder.map().linear().transpose() * normal;
    const double across = local.head<2>().norm();
    const double distance = normal.dot(p - cylinder.map().translation());
    if (!(std::abs(local.z()) <= tolerance * cylinder.map().linear().col(2).norm()) ||
        !near(std::abs(distance) / across, 1))
        return std::nullopt;
    return Eigen::Vector2d(local.head<2>() * std::copysign(1 / across, distance));
}

std::optional<Eigen::Vector2d> touching_direction_of_edge(const Cone& cylinder, const Point& a,
                                                          const Point& b) {
    const Eigen::Affine3d inverse = cylinder.map().inverse();
    const Eigen::Vector2d from = (inverse * a).head<2>(), to = (inverse * b).head<2>();
    if (!((to - from).norm() <= tolerance) || !near(from.norm(), 1)) return std::nullopt;
    return from.normalized();
}

}  // namespace maille::modeler
