#pragma once

#include <cstdint>
#include <limits>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <Eigen/Core>

namespace maille::modeler::detail {

/// Internal to the arrangement: the exact kernel and its usual names.
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactNumber = Exact::FT;
using ExactPoint = Exact::Point_3;
using ExactPlane = Exact::Plane_3;

/// The index that stands for nothing.
inline constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// The point in doubles, each coordinate off by no more than `error` (or the last bit).
inline Eigen::Vector3d approximate(const ExactPoint& p, double error) {
    Eigen::Vector3d result;
    for (int k = 0; k < 3; ++k) {
        auto [low, high] = CGAL::to_interval(p[k]);
        if (!(high - low <= error)) {
            CGAL::exact(p);
            std::tie(low, high) = CGAL::to_interval(p[k]);
        }
        result[k] = low + (high - low) / 2;
    }
    return result;
}

}  // namespace maille::modeler::detail
