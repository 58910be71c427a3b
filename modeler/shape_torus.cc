#include "modeler/shape_torus.hh"

#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "modeler/shape_frame.hh"
#include "modeler/shape_plane.hh"

namespace maille::modeler {
namespace {

/// The direction from the axis through a point; along x for points of the axis itself.
Eigen::Vector2d away_from_axis(const Point& reference) {
    const double rho = reference.head<2>().norm();
    return rho > 0 ? Eigen::Vector2d(reference.head<2>() / rho) : Eigen::Vector2d::UnitX();
}

}  // namespace

Torus::Torus(double major, double minor, const Eigen::Affine3d& map)
    : major_(major),
      minor_(minor),
      map_((check_frame(map), map)),
      inverse_(map.inverse()),
      is_round_(is_similarity(map.linear())) {
    const double largest = largest_stretch(map.linear());
    least_stretch_ = smallest_stretch(map.linear());
    size_ = largest * (major + minor);
    // Federer: the reach is the infimum of |q - p|^2 / 2 dist(q - p, tangent plane at p).
    reach_ = std::min(minor, major - minor) * least_stretch_ * least_stretch_ / largest;
    constexpr int samples = 64;
    max_curvature_ = 0;
    for (int i = 0; i < (is_round_ ? 1 : samples); ++i)
        for (int j = 0; j < samples; ++j) {
            const Eigen::Vector2d u = unit_circle(i, samples), v = unit_circle(j, samples);
            const double rho = major + minor * v.x();
            const Point reference(rho * u.x(), rho * u.y(), minor * v.y());
            const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(curvature_at(reference),
                                                                       Eigen::EigenvaluesOnly);
            max_curvature_ = std::max(max_curvature_, eigen.eigenvalues().cwiseAbs().maxCoeff());
        }
}

std::span<const PrimitiveFace> Torus::faces() const {
    static const std::array<PrimitiveFace, 1> surface{{{"surface", false}}};
    return surface;
}

Eigen::AlignedBox3d Torus::bounding_box() const {
    // A circle's reach and a ball's, added: the torus is their Minkowski sum.
    const Point reach =
        major_ * map_.linear().leftCols<2>().rowwise().norm() + minor_ * map_.linear().rowwise().norm();
    return {map_.translation() - reach, map_.translation() + reach};
}

Point Torus::gradient(const Point& reference) const {
    const Eigen::Vector2d outward = away_from_axis(reference);
    const Eigen::Vector2d from_tube(reference.head<2>().norm() - major_, reference.z());
    const double distance = from_tube.norm();
    const Eigen::Vector2d n = distance > 0 ? Eigen::Vector2d(from_tube / distance) : Eigen::Vector2d::UnitX();
    return inverse_.linear().transpose() * Point(n.x() * outward.x(), n.x() * outward.y(), n.y());
}

double Torus::implicit(const Point& p) const {
    const Point reference = inverse_ * p;
    const double distance = std::hypot(reference.head<2>().norm() - major_, reference.z());
    if (distance == 0) return -minor_ * least_stretch_;
    return (distance - minor_) / gradient(reference).norm();
}

double Torus::face_implicit(std::uint32_t, const Point& p) const {
    return implicit(p);
}

Point Torus::face_normal(std::uint32_t face, const Point& p) const {
    return gradient(inverse_ * project(face, p)).normalized();
}

Eigen::Matrix3d Torus::curvature_at(const Point& reference) const {
    const Eigen::Vector2d outward = away_from_axis(reference);
    const double rho = reference.head<2>().norm();
    const Eigen::Vector2d n = Eigen::Vector2d(rho - major_, reference.z()).normalized();
    const Eigen::Matrix3d to_reference = inverse_.linear();
    const Point around_tube =
        to_reference.transpose() * Point(-n.y() * outward.x(), -n.y() * outward.y(), n.x());
    const Point around_axis = to_reference.transpose() * Point(-outward.y(), outward.x(), 0);
    const Eigen::Matrix3d hessian =
        around_tube * around_tube.transpose() / minor_ + n.x() / rho * around_axis * around_axis.transpose();
    return level_set_curvature(gradient(reference), hessian);
}

Eigen::Matrix3d Torus::face_curvature(std::uint32_t face, const Point& p) const {
    return curvature_at(inverse_ * project(face, p));
}

double Torus::max_curvature(std::uint32_t) const {
    return max_curvature_;
}

Point Torus::project(std::uint32_t, const Point& p) const {
    if (std::abs(implicit(p)) <= rounding_at(p, size_)) return p;
    return is_round_ ? nearest_on_round(p) : nearest_on_image(p);
}

Point Torus::nearest_on_round(const Point& p) const {
    const Point reference = inverse_ * p;
    const Eigen::Vector2d outward = away_from_axis(reference);
    const Eigen::Vector2d from_tube(reference.head<2>().norm() - major_, reference.z());
    const double distance = from_tube.norm();
    const Eigen::Vector2d n = distance > 0 ? Eigen::Vector2d(from_tube / distance) : Eigen::Vector2d::UnitX();
    const Point normal(n.x() * outward.x(), n.x() * outward.y(), n.y());
    return p + map_.linear() * ((minor_ - distance) * normal);
}

Point Torus::reference_point(const Angles& angles) const {
    const double rho = major_ + minor_ * std::cos(angles.y());
    return {rho * std::cos(angles.x()), rho * std::sin(angles.x()), minor_ * std::sin(angles.y())};
}

// Newton's method on the squared distance, damped; always downhill.
Torus::Angles Torus::descend(Angles angles, const Point& p) const {
    const auto distance2 = [&](const Angles& at) { return (p - map_ * reference_point(at)).squaredNorm(); };
    double best = distance2(angles);
    for (int iteration = 0; iteration < 60; ++iteration) {
        const double cu = std::cos(angles.x()), su = std::sin(angles.x());
        const double cv = std::cos(angles.y()), sv = std::sin(angles.y());
        const double rho = major_ + minor_ * cv;
        const auto in_space = [&](double x, double y, double z) {
            return Point(map_.linear() * Point(x, y, z));
        };
        const Point error = p - map_ * reference_point(angles);
        const Point pu = in_space(-rho * su, rho * cu, 0);
        const Point pv = minor_ * in_space(-sv * cu, -sv * su, cv);
        const Point puu = in_space(-rho * cu, -rho * su, 0);
        const Point pvv = -minor_ * in_space(cv * cu, cv * su, sv);
        const Point puv = minor_ * in_space(sv * su, -sv * cu, 0);
        const Eigen::Vector2d slope(error.dot(pu), error.dot(pv));
        const Eigen::Matrix2d metric{{pu.dot(pu), pu.dot(pv)}, {pu.dot(pv), pv.dot(pv)}};
        const Eigen::Matrix2d bend{{error.dot(puu), error.dot(puv)}, {error.dot(puv), error.dot(pvv)}};
        Eigen::Matrix2d hessian = metric - bend;
        if (!(hessian.determinant() > 1e-12 * metric.determinant() && hessian.trace() > 0)) hessian = metric;
        Angles step = hessian.inverse() * slope;
        // What rounding can make of an equal distance is no ascent: the last steps are that small.
        const double limit = best + 1e-15 * (best + size_ * std::sqrt(best));
        double next = distance2(angles + step);
        for (int halving = 0; next > limit && halving < 40; ++halving) next = distance2(angles + (step /= 2));
        if (next > limit) break;
        angles += step;
        best = next;
        if (step.norm() < 1e-15) break;
    }
    return angles;
}

Point Torus::nearest_on_image(const Point& p) const {
    const Point reference = inverse_ * p;
    const Angles start(std::atan2(reference.y(), reference.x()),
                       std::atan2(reference.z(), reference.head<2>().norm() - major_));
    Point best = map_ * reference_point(descend(start, p));
    if ((p - best).norm() < reach_) return best;

    constexpr int across = 96, around = 48;
    std::array<std::array<double, around>, across> distance;
    const auto angles_of = [](int i, int j) {
        return Angles(2 * std::numbers::pi * i / across, 2 * std::numbers::pi * j / around);
    };
    for (int i = 0; i < across; ++i)
        for (int j = 0; j < around; ++j)
            distance[i][j] = (p - map_ * reference_point(angles_of(i, j))).squaredNorm();
    for (int i = 0; i < across; ++i)
        for (int j = 0; j < around; ++j) {
            bool is_minimum = true;
            for (int di = -1; di <= 1; ++di)
                for (int dj = -1; dj <= 1; ++dj)
                    is_minimum &=
                        distance[i][j] <= distance[(i + di + across) % across][(j + dj + around) % around];
            if (!is_minimum) continue;
            const Point candidate = map_ * reference_point(descend(angles_of(i, j), p));
            if ((p - candidate).norm() < (p - best).norm()) best = candidate;
        }
    return best;
}

}  // namespace maille::modeler
