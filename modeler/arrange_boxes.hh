#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "modeler/facet_complex.hh"

namespace maille::modeler::detail {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

Eigen::AlignedBox3d facet_box(const FacetComplex& complex, std::uint32_t facet);

/// The pairs of facets (the smaller number first, in rising order) whose boxes, each widened by `margin`,
/// meet, and which `wanted` says yes to.
std::vector<Pair> pairs_of_near_facets(const FacetComplex& complex, double margin,
                                       const std::function<bool(std::uint32_t, std::uint32_t)>& wanted);

}  // namespace maille::modeler::detail
