#include "modeler/tessellate_rows.hh"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modeler/shape_frame.hh"

namespace maille::modeler {

void stitch(SurfaceSeed& seed, const Row& lower, const Row& upper, std::uint32_t surface, bool mirrored) {
    const int lower_edges = lower.edges(), upper_edges = upper.edges();
    int i = 0, j = 0;
    while (i < lower_edges || j < upper_edges) {
        const bool along_lower =
            j == upper_edges ||
            (i < lower_edges && lower.share(i + 1) - upper.share(j) <= upper.share(j + 1) - lower.share(i));
        if (along_lower) {
            seed.add_triangle({lower.at(i), lower.at(i + 1), upper.at(j)}, surface, mirrored);
            ++i;
        } else {
            seed.add_triangle({lower.at(i), upper.at(j + 1), upper.at(j)}, surface, mirrored);
            ++j;
        }
    }
}

RowPoints row_between(int first_rim, int last_rim, std::size_t k, std::size_t n, int wanted) {
    if (k == 1 && first_rim > 1) return {first_rim, 1};
    if (k + 1 == n && last_rim > 1) return {last_rim, 1};
    return {wanted, static_cast<int>(k % 2)};
}

Circumference::Circumference(const Eigen::Affine3d& map, const Sizing& sizing, double radius)
    : x_(map.linear().col(0)), y_(map.linear().col(1)) {
    constexpr double slack = 1e-4;
    is_circle_ = std::abs(x_.squaredNorm() - y_.squaredNorm()) < slack * x_.squaredNorm() &&
                 std::abs(x_.dot(y_)) < slack * x_.squaredNorm();
    if (is_circle_) {
        const double in_space = radius * std::sqrt(x_.cross(y_).norm());
        length_.back() = 2 * std::numbers::pi * in_space;
        steps_.back() = length_.back() / sizing.for_curvature(1 / in_space);
        return;
    }
    for (int i = 0; i < samples; ++i) {
        const Eigen::Vector2d u = unit_circle(2 * i + 1, 2 * samples);
        const double speed = (u.x() * y_ - u.y() * x_).norm();
        const double curvature = x_.cross(y_).norm() / (radius * std::pow(speed, 3));
        const double step = radius * speed * 2 * std::numbers::pi / samples;
        length_[i + 1] = length_[i] + step;
        steps_[i + 1] = steps_[i] + step / sizing.for_curvature(curvature);
    }
}

Eigen::Vector2d Circumference::direction(int k, int n) const {
    if (is_circle_) return unit_circle(k, n);
    const double wanted = edges() * (k % n) / n;
    const auto after = std::ranges::upper_bound(steps_, wanted);
    const auto i = std::clamp<std::ptrdiff_t>(after - steps_.begin() - 1, 0, samples - 1);
    const double part = (wanted - steps_[i]) / (steps_[i + 1] - steps_[i]);
    const double angle = 2 * std::numbers::pi * (static_cast<double>(i) + part) / samples;
    return {std::cos(angle), std::sin(angle)};
}

int rim_count(const Circumference& rim, double slant) {
    const double least = rim.length() / std::max(8.0, rim.edges()) / 8;
    const double edges = std::max(rim.edges(), rim.length() / std::max(slant, least));
    return 4 * doubling_count(edges / 4, 2);
}

}  // namespace maille::modeler
