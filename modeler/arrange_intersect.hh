#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "modeler/arrange_boxes.hh"
#include "modeler/arrange_planes.hh"
#include "modeler/arrange_registry.hh"

namespace maille::modeler::detail {

/// Where facets meet others.
struct Contacts {
    struct Segment {
        std::array<std::uint32_t, 2> ends;  ///< numbers in the registry; twice the same for a single point
        std::uint64_t carrier;              ///< the edge of a facet that it is known to lie on, or 0
        std::uint32_t other;                ///< the facet that is met there
    };
    using PointOnEdge = std::pair<std::uint64_t, std::uint32_t>;

    /// The points known to lie on the edge.
    auto points_at(std::uint64_t edge) const {
        return std::ranges::equal_range(on_edges, edge, {}, &PointOnEdge::first);
    }

    std::vector<std::vector<Segment>> segments;  ///< on each facet; not its own edges and corners
    std::vector<PointOnEdge> on_edges;           ///< points found on edges of facets; rising
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
