#include "modeler/meridian.hh"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Eigenvalues>

#include "modeler/shape_cone.hh"
#include "modeler/shape_ellipsoid.hh"
#include "modeler/shape_torus.hh"

namespace maille::modeler {
namespace {

using Eigen::Vector2d;

/// Of lengths, in parts of the surface's radius.
constexpr double tolerance = 1e-9;
/// Nearer to a rim than that a line is as good as on an ellipse that it touches there.
constexpr double beside = 1e-4;

std::optional<Meridian> meridian_of(const Eigen::Affine3d& map, const Torus& torus) {
    const Eigen::Matrix3d& linear = map.linear();
    const Eigen::Matrix2d across = linear.topLeftCorner<2, 2>();
    const double scale = std::sqrt(std::abs(across.determinant()));
    const double slack = tolerance * scale;
    const Eigen::Matrix2d stretch = across.transpose() * across / (scale * scale);
    if (!((stretch - Eigen::Matrix2d::Identity()).norm() <= tolerance) ||
        !(linear.col(2).head<2>().norm() <= slack) || !(linear.row(2).head<2>().norm() <= slack) ||
        !(map.translation().head<2>().norm() <= slack))
        return std::nullopt;
    return Meridian{{scale * torus.major(), map.translation().z()},
                    torus.minor() * Vector2d(scale, std::abs(linear(2, 2)))};
}

/// The ellipsoid is x = centre + linear * u, |u| = 1, in other words (x - centre)' gram^-1 (x - centre) = 1.
std::optional<Meridian> meridian_of(const Eigen::Affine3d& map, const Ellipsoid&) {
    const Eigen::Matrix3d gram = map.linear() * map.linear().transpose();
    const double across = std::sqrt(gram(0, 0)), along = std::sqrt(gram(2, 2));
    if (!(std::abs(gram(1, 1) - gram(0, 0)) <= tolerance * gram(0, 0)) ||
        !(std::abs(gram(0, 1)) <= tolerance * gram(0, 0)) ||
        !(gram.col(2).head<2>().norm() <= tolerance * across * along) ||
        !(map.translation().head<2>().norm() <= tolerance * across))
        return std::nullopt;
    return Meridian{{0, map.translation().z()}, {across, along}};
}

/// The direction of the axis about which the ellipsoid is one of revolution, where the first is the unit
/// sphere.
std::optional<Point> axis_with_unit_sphere(const Eigen::Affine3d& map) {
    if (map.translation().norm() > tolerance) return map.translation().normalized();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(map.linear() * map.linear().transpose());
    const Point& values = solver.eigenvalues();
    const double slack = tolerance * values[2];
    const bool low = values[1] - values[0] <= slack, high = values[2] - values[1] <= slack;
    if (low == high) return std::nullopt;
    return solver.eigenvectors().col(low ? 2 : 0);
}

const Eigen::Affine3d* map_of(const Shape& shape) {
    if (const auto* torus = dynamic_cast<const Torus*>(&shape)) return &torus->map();
    if (const auto* ellipsoid = dynamic_cast<const Ellipsoid*>(&shape)) return &ellipsoid->map();
    return nullptr;
}

/// Half the squared distance from the centre of the one ellipse, in its semi-axes, along the other: its first
/// and second derivative.
Vector2d slopes(const Meridian& one, const Meridian& other, double angle) {
    const Vector2d p = (other.at(angle) - one.centre).cwiseQuotient(one.semi);
    const Vector2d scale = other.semi.cwiseQuotient(one.semi);
    const Vector2d first = scale.cwiseProduct(Vector2d(-std::sin(angle), std::cos(angle)));
    const Vector2d second = -scale.cwiseProduct(Vector2d(std::cos(angle), std::sin(angle)));
    return {p.dot(first), first.squaredNorm() + p.dot(second)};
}

/// Places between the angles where the distance is least or greatest.
std::vector<double> extremes(const Meridian& one, const Meridian& other) {
    constexpr int samples = 64, most_iterations = 60;
    const auto slope = [&](double angle) { return slopes(one, other, angle)[0]; };
    std::vector<double> found;
    for (int i = 0; i < samples; ++i) {
        // Not beginning at an axis, where there often is one.
        double low = 2 * std::numbers::pi * (i + 0.3) / samples - std::numbers::pi;
        double high = low + 2 * std::numbers::pi / samples;
        if ((slope(low) > 0) == (slope(high) > 0)) continue;
        const bool rises = slope(high) > 0;
        double angle = (low + high) / 2;
        for (int k = 0; k < most_iterations; ++k) {
            const Vector2d now = slopes(one, other, angle);
            ((now[0] > 0) == rises ? high : low) = angle;
            const double next = angle - now[0] / now[1];
            const double last = std::exchange(angle, next > low && next < high ? next : (low + high) / 2);
            if (std::abs(angle - last) <= 1e-16) break;
        }
        found.push_back(angle);
    }
    return found;
}

}  // namespace

Vector2d Meridian::at(double angle) const {
    return centre + semi.cwiseProduct(Vector2d(std::cos(angle), std::sin(angle)));
}

double Meridian::angle_of(const Vector2d& p) const {
    const Vector2d unit = (p - centre).cwiseQuotient(semi);
    return std::atan2(unit.y(), unit.x());
}

double Meridian::distance(const Vector2d& p) const {
    return (p - centre).cwiseQuotient(semi).norm() - 1;
}

std::optional<Meridian> meridian_in(const Eigen::Affine3d& frame, const Shape& shape) {
    if (const auto* torus = dynamic_cast<const Torus*>(&shape))
        return meridian_of(frame.inverse() * torus->map(), *torus);
    if (const auto* ellipsoid = dynamic_cast<const Ellipsoid*>(&shape))
        return meridian_of(frame.inverse() * ellipsoid->map(), *ellipsoid);
    return std::nullopt;
}

std::optional<Eigen::Affine3d> common_frame(const Shape& a, const Shape& b) {
    const Eigen::Affine3d *of_a = map_of(a), *of_b = map_of(b);
    if (of_a == nullptr || of_b == nullptr) return std::nullopt;
    Eigen::Affine3d frame = *of_a;
    if (dynamic_cast<const Torus*>(&b) != nullptr) {
        frame = *of_b;
    } else if (dynamic_cast<const Torus*>(&a) == nullptr) {
        const auto axis = axis_with_unit_sphere(of_a->inverse() * *of_b);
        if (!axis) return std::nullopt;
        frame = *of_a * Eigen::Quaterniond::FromTwoVectors(Point::UnitZ(), *axis);
    }
    if (!meridian_in(frame, a) || !meridian_in(frame, b)) return std::nullopt;
    return frame;
}

std::vector<TouchingCircle> touching_circles(const Meridian& meridian, const Cone& cone, double low,
                                             double high, std::span<const double> rims) {
    std::vector<TouchingCircle> found;
    const auto add = [&](double height) {
        const Vector2d p(cone.radius(height), height);
        if (p.x() > tolerance && std::abs(meridian.distance(p)) <= tolerance)
            found.push_back({meridian.angle_of(p), height});
    };
    for (const double height : rims) add(height);
    // Where the ellipse is the unit circle, a line r = a + b z is nearest to its centre at z = -ab / (1 +
    // b^2).
    const double a = (cone.radius(meridian.centre.y()) - meridian.centre.x()) / meridian.semi.x();
    const double b = (cone.radius(1) - cone.radius(0)) * meridian.semi.y() / meridian.semi.x();
    const double height = meridian.centre.y() - meridian.semi.y() * a * b / (1 + b * b);
    const auto is_at_rim = [&](double rim) { return std::abs(rim - height) <= beside * meridian.semi.y(); };
    if (height > low && height < high && std::ranges::none_of(rims, is_at_rim)) add(height);
    return found;
}

std::vector<TouchingCircle> touching_circles(const Meridian& meridian, const Meridian& other) {
    std::vector<TouchingCircle> found;
    for (const double angle : extremes(meridian, other)) {
        const Vector2d p = other.at(angle);
        if (p.x() > tolerance * other.semi.x() && std::abs(meridian.distance(p)) <= tolerance)
            found.push_back({meridian.angle_of(p), angle});
    }
    return found;
}

std::optional<double> touching_angle(const Meridian& meridian, double height) {
    const double place = (height - meridian.centre.y()) / meridian.semi.y();
    if (!meridian.is_torus() || !(std::abs(std::abs(place) - 1) <= tolerance)) return std::nullopt;
    return std::copysign(std::numbers::pi / 2, place);
}

}  // namespace maille::modeler
