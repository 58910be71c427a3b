#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "modeler/csg_tree.hh"
#include "modeler/facet_complex.hh"
#include "volmesh/error.hh"

namespace maille::modeler {

/// The surface of one primitive: closed and oriented outwards. It may be empty.
struct ClosedSurface {
    std::vector<Eigen::Vector3d> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t>
        surfaces;  ///< of each triangle, the number of the smooth surface that it lies on
    /// Whether its triangles may meet elsewhere than in common corners and edges. What it winds around is
    /// inside then.
    bool crosses_itself = false;
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

/// Surfaces that could not be arranged.
class ArrangeError : public InputError {
  public:
    /// `problem` goes on from the names of the primitives: "cannot be cut where they meet".
    ArrangeError(std::string problem, std::vector<std::uint32_t> primitives, const Eigen::Vector3d& place);

    const std::string& problem() const { return problem_; }
    /// Those that meet at the place, rising.
    const std::vector<std::uint32_t>& primitives() const { return primitives_; }
    const Eigen::Vector3d& place() const { return place_; }

  private:
    std::string problem_;
    std::vector<std::uint32_t> primitives_;
    Eigen::Vector3d place_;
};

/// An arrangement that takes more work than `ArrangeOptions::most_contacts`.
class ArrangeLimitError : public ArrangeError {
  public:
    using ArrangeError::ArrangeError;
};

struct ArrangeOptions {
    /// Points nearer than this, and points nearer than this to a plane of triangles, are made to coincide;
    /// relative to the diagonal of the scene. Where that leaves surfaces too near to each other, ten times as
    /// much is tried, and a hundred times.
    double weld = 1e-9;
    /// How often the surface is arranged again when the rounding of its points made it cross itself.
    int max_repairs = 8;
    /// Most pairs of triangles near each other, and points where surfaces cross, together: for each triangle
    /// that the surfaces have if planar faces are in as few as can be. What takes more would hardly end.
    double most_contacts = 5000;
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
/// Throws InputError for an index out of range, a point that is not finite or a surface that is not closed;
/// ArrangeError when the regions found do not close, when no rounding free of self-intersections is found, or
/// when it takes too much work.
Arrangement arrange(std::span<const ClosedSurface> primitives, const CsgTree& tree,
                    const ArrangeOptions& options = {});

}  // namespace maille::modeler
