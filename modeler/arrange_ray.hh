#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include <CGAL/Origin.h>
#include <CGAL/enum.h>
#include <Eigen/Geometry>

#include "modeler/arrange_box_tree.hh"
#include "modeler/arrange_filter.hh"

namespace maille::modeler::detail {

/// How a ray meets a triangle.
enum class Hit {
    miss,
    leaving,   ///< crosses it from behind to the front
    entering,  ///< crosses it from the front to behind
    start,     ///< starts on it
    unclear    ///< meets its edge, or runs in its plane
};

/// The ray from p through q against a triangle, which must have an area. Points of any CGAL kernel.
template <class Kernel>
Hit hit(const typename Kernel::Point_3& p, const typename Kernel::Point_3& q,
        const std::array<typename Kernel::Point_3, 3>& t) {
    bool left = false, right = false, touches = false;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto side = CGAL::orientation(p, q, t[k], t[(k + 1) % 3]);
        left |= side == CGAL::POSITIVE;
        right |= side == CGAL::NEGATIVE;
        touches |= side == CGAL::ZERO;
        if (left && right) return Hit::miss;
    }
    if (touches) return typename Kernel::Triangle_3(t[0], t[1], t[2]).has_on(p) ? Hit::start : Hit::unclear;
    const auto height = CGAL::orientation(t[0], t[1], t[2], p);
    if (height == CGAL::ZERO) return Hit::start;
    const bool is_behind = height == CGAL::NEGATIVE;
    if (is_behind != left) return Hit::miss;
    return left ? Hit::leaving : Hit::entering;
}

/// The same where doubles suffice to tell; their coordinates may be off by `slack`.
inline std::optional<Hit> certain_hit(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                                      const std::array<Eigen::Vector3d, 3>& t, double slack) {
    bool left = false, right = false, unsure = false;
    for (std::size_t k = 0; k < 3; ++k) {
        const int side = certain_orientation(p, q, t[k], t[(k + 1) % 3], slack);
        left |= side > 0;
        right |= side < 0;
        unsure |= side == 0;
        if (left && right) return Hit::miss;
    }
    const int height = certain_orientation(t[0], t[1], t[2], p, slack);
    if (unsure || height == 0) return std::nullopt;
    if ((height < 0) != left) return Hit::miss;
    return left ? Hit::leaving : Hit::entering;
}

/// A direction in general position; another one at each attempt. About of length one.
inline Eigen::Vector3d ray_direction(int attempt) {
    const double a = 1.2345678 + 2.3999632297 * attempt,
                 z = std::fmod(0.5772156649 + 0.7548776662 * attempt, 2) - 1;
    const double r = std::sqrt(std::max(0.01, 1 - z * z));
    return {r * std::cos(a), r * std::sin(a), z};
}

/// Gives up on finding a ray in general position: so many can only fail by a mistake of the program.
inline constexpr int max_ray_attempts = 200;

}  // namespace maille::modeler::detail
