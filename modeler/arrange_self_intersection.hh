#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "modeler/facet_complex.hh"

namespace maille::modeler {

/// Two facets that meet elsewhere than in common vertices and edges; `first == second` where one facet has no
/// area.
struct SelfIntersection {
    std::uint32_t first;
    std::uint32_t second;
};

/// Any place where the complex crosses or overlaps itself, or nothing where it is fit for a tetrahedral
/// mesher. Exact. Vertices are the same when their numbers are: two points at one place are a
/// self-intersection.
std::optional<SelfIntersection> find_self_intersection(const FacetComplex& complex);

/// All such places, in rising order.
std::vector<SelfIntersection> find_self_intersections(const FacetComplex& complex);

}  // namespace maille::modeler
