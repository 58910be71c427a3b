#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "modeler/arrange_crossings.hh"
#include "modeler/arrange_intersect.hh"
#include "modeler/arrange_projection.hh"

namespace maille::modeler::detail {

/// The facets of one plane, cut along all lines that cross it.
struct PlaneCut {
    /// A connected part, cut by no line.
    struct Part {
        std::vector<std::pair<std::uint32_t, int>>
            facets;  ///< that hold it; 1 if along the plane's normal, else -1. Of those that a dissolved edge
                     ///< joins, the first stands for all.
        std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise around the plane's normal
    };
    Projection projection;
    std::vector<Part> parts;
};

/// Cuts facets that lie in one plane by each other's edges (but for the `dissolved` ones, a sorted list) and
/// along their contacts. The plane's normal is that of the first facet.
PlaneCut cut_plane(const FacetComplex& complex, const ExactPositions& positions, const Contacts& contacts,
                   std::span<const std::uint32_t> facets, std::span<const std::uint64_t> dissolved,
                   PlaneCrossings& crossings, PointRegistry& registry);

}  // namespace maille::modeler::detail
