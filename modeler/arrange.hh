#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "modeler/csg_tree.hh"
#include "modeler/facet_complex.hh"

namespace maille::modeler {

/// The surface of one primitive: closed, oriented outwards, free of self-intersections. It may be empty.
struct ClosedSurface {
    std::vector<Eigen::Vector3d> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t>
        surfaces;  ///< of each triangle, the number of the smooth surface that it lies on
};

/// The input triangle that a facet is a part of.
struct FacetParent {
    std::uint32_t primitive;
    std::uint32_t triangle;
    bool whole;  ///< the facet is that triangle: the same three points, bit by bit
};

/// The interface between all regions, and where each of its facets comes from.
struct Arrangement {
    FacetComplex complex;
    std::vector<FacetParent> parents;  ///< one for each facet
};

struct ArrangeOptions {
    /// Points nearer than this, and points nearer than this to a plane of triangles, are made to coincide;
    /// relative to the diagonal of the scene.
    double weld = 1e-9;
    /// How often the surface is arranged again when the rounding of its points made it cross itself.
    int max_repairs = 8;
};

/// The surfaces that separate the regions which the tree gives to the primitives (see `owner`): all facets
/// between different regions, conforming, with the region on either side.
///
/// Exact: intersections are computed in rational arithmetic and rounded at the end. Surfaces may touch,
/// coincide or share planes and edges in any way. Triangles that meet no other primitive come back as they
/// are; all points of the input that remain keep their coordinates. No two facets of the result meet except
/// in common vertices and edges. An empty result is an empty complex. The result does not depend on anything
/// but the input.
///
/// Where surfaces of several primitives coincide, the facet has the surface of a primitive that owns one of
/// its sides (the earliest), or else of the earliest primitive.
///
/// Throws InputError for an index out of range, a point that is not finite, a surface that is not closed,
/// when the regions found do not close, or when no rounding free of self-intersections is found.
Arrangement arrange(std::span<const ClosedSurface> primitives, const CsgTree& tree,
                    const ArrangeOptions& options = {});

}  // namespace maille::modeler
