#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "modeler/arrange_intersect.hh"
#include "modeler/arrange_projection.hh"

namespace maille::modeler::detail {

/// How far the winding number of a primitive is higher behind a sheet than in front of it.
struct Cover {
    Region primitive;
    int winding;
    std::uint32_t facet;  ///< one of the scene that makes the difference
};

/// A connected part of a plane, covered by the same primitives everywhere: the unit that is kept or dropped.
struct Sheet {
    std::uint32_t cluster;  ///< none for a facet of the scene that nothing meets
    bool mirrored;          ///< its pieces run clockwise around the normal of the cluster
    std::uint32_t first_cover, end_cover;
};

/// A triangle of a sheet.
struct Piece {
    std::array<std::uint32_t, 3> corners;  ///< numbers in the registry
    std::uint32_t sheet;
};

/// Facets that lie in one plane and hang together, with whatever meets them: subdivided together.
struct Cluster {
    std::vector<std::uint32_t> facets;
    Projection projection;
};

/// All facets cut where they meet.
struct Subdivision {
    std::vector<Cluster> clusters;
    std::vector<Sheet> sheets;
    std::vector<Cover> covers;
    std::vector<Piece> pieces;

    /// By rising primitive; the first winding is positive.
    std::span<const Cover> covers_of(const Sheet& sheet) const {
        return std::span(covers).subspan(sheet.first_cover, sheet.end_cover - sheet.first_cover);
    }
};

/// Cuts all facets along their contacts. Crossings of contacts are added to the registry.
Subdivision subdivide(const FacetComplex& complex, const ExactPositions& positions, const Contacts& contacts,
                      PointRegistry& registry);

}  // namespace maille::modeler::detail
