#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "modeler/arrange_boxes.hh"
#include "modeler/arrange_planes.hh"
#include "modeler/arrange_registry.hh"

namespace maille::modeler::detail {

/// Where facets meet others.
struct Contacts {
    using Segment =
        std::array<std::uint32_t, 2>;  ///< numbers in the registry; twice the same for a single point

    std::vector<std::vector<Segment>> segments;  ///< on each facet; not its own edges and corners
    std::vector<std::uint64_t> edges;            ///< of facets, along which others meet them; rising
    std::vector<Pair> coplanar;                  ///< facets in one plane that meet
    std::vector<bool> degenerate;                ///< facets with no area
};

/// Which facets have no area.
std::vector<bool> degenerate_facets(const FacetComplex& complex, const ExactPositions& positions);

/// Intersects the pairs of facets; the new points go to the registry, which begins with the positions'
/// points.
Contacts intersect(const FacetComplex& complex, const ExactPositions& positions, std::span<const Pair> pairs,
                   PointRegistry& registry);

}  // namespace maille::modeler::detail
