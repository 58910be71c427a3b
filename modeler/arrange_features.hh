#pragma once

#include <cstdint>
#include <vector>

#include "modeler/arrange_cluster.hh"
#include "modeler/arrange_label.hh"
#include "modeler/arrange_scene.hh"

namespace maille::modeler::detail {

/// The sheets of a cluster that have the same regions on their sides and the same surface. Facets that
/// nothing meets are a group each.
struct Group {
    std::uint32_t cluster;
    Sides sides;       ///< along the normal of the cluster
    Region primitive;  ///< whose surface it is
    std::uint32_t surface;
    FacetParent parent;
};

struct KeptSheets {
    std::vector<Group> groups;
    std::vector<std::uint32_t> group_of;  ///< of each sheet; none if it is not kept
};

/// A straight edge of a group's outline. The group is on its left.
struct OutlineEdge {
    std::uint32_t from, to;
    std::uint32_t group;
};

/// The edges that the kept groups of a cluster must have: where they end, or where other facets stand on
/// them. New points that merely subdivide a straight edge are left out; the primitive's own points stay.
class Features {
  public:
    Features(const Subdivision& subdivision, const KeptSheets& kept, const FacetComplex& scene,
             const PointRegistry& registry);

    /// By cluster.
    const std::vector<std::vector<OutlineEdge>>& outlines() const { return outlines_; }
    /// The points that the kept groups must have, by cluster, rising: also those that only touch a facet from
    /// elsewhere.
    const std::vector<std::vector<std::uint32_t>>& points() const { return points_; }

  private:
    std::vector<std::vector<OutlineEdge>> outlines_;
    std::vector<std::vector<std::uint32_t>> points_;
};

}  // namespace maille::modeler::detail
