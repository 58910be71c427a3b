#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace maille::modeler {

/// A region number: which primitive owns the cells there; `outside` where nothing does.
using Region = std::int32_t;
/// Where nothing is.
inline constexpr Region outside = -1;

/// A triangle of the interface between two regions.
struct Facet {
    std::array<std::uint32_t, 3> vertices;  ///< numbers of points
    std::uint32_t surface;                  ///< number of the smooth surface that it lies on
    Region front;                           ///< the region that the normal (right-hand rule) points into
    Region back;                            ///< the region behind it
    bool frozen = false;  ///< a face of elements that are kept: not to be split, moved or removed
};

/// A conforming complex of facets that bounds every region: the interface between the arrangement, the
/// surface remesher and the tetrahedral mesher. It need not be manifold. No facet has equal regions on both
/// sides, except a frozen one.
struct FacetComplex {
    std::vector<Eigen::Vector3d> points;  ///< each used by a facet
    std::vector<Facet> facets;            ///< each pair meets in a common edge or point, or not at all
};

}  // namespace maille::modeler
