#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "modeler/arrange_boxes.hh"
#include "modeler/arrange_kernel.hh"
#include "modeler/facet_complex.hh"

namespace maille::modeler::detail {

/// Where the points of a complex are taken to be, exactly: those that lie on common planes but for rounding
/// are moved onto them. Knowing the planes spares most of the expensive proofs that something is zero.
struct ExactPositions {
    std::vector<ExactPoint> points;
    std::vector<Eigen::Vector3d> near;  ///< the same in doubles
    double slack = 0;                   ///< by which their coordinates are off at most
    std::vector<ExactPlane> planes;
    std::vector<Eigen::Vector3d> normals;  ///< of the planes, in doubles
    std::vector<std::vector<std::uint32_t>>
        planes_of_point;                        ///< the planes that hold the point exactly, rising
    std::vector<std::uint32_t> plane_of_facet;  ///< the plane that holds its corners exactly, or none

    /// Whether the points are known to lie in one plane.
    bool coplanar(std::span<const std::uint32_t> asked) const;
    /// Whether the points are known to lie on one line.
    bool collinear(std::span<const std::uint32_t> asked) const;
    /// Whether the plane is known to hold the points.
    bool holds(std::uint32_t plane, std::span<const std::uint32_t> asked) const;
};

/// The points just as they are, on no known plane.
ExactPositions positions_as_given(const FacetComplex& complex);

/// The points of the facets that occur in `pairs` moved onto the planes that they lie on within `tolerance`.
ExactPositions positions_on_planes(const FacetComplex& complex, std::span<const Pair> pairs,
                                   double tolerance);

}  // namespace maille::modeler::detail
