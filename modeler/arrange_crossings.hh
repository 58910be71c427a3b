#pragma once

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "modeler/arrange_kernel.hh"
#include "modeler/triple.hh"

namespace maille::modeler::detail {

/// The points in which three planes meet, by the planes' numbers: who comes upon one again, in another of its
/// planes, need not compute it, nor prove that it is the same.
class PlaneCrossings {
  public:
    /// Tells for each facet a number that only facets of the same plane have.
    explicit PlaneCrossings(std::vector<std::uint32_t> plane_of_facet)
        : plane_of_facet_(std::move(plane_of_facet)) {}

    std::uint32_t plane_of(std::uint32_t facet) const { return plane_of_facet_[facet]; }
    /// The point of three planes that meet in one; `none` until it is set.
    std::uint32_t& point_of(const Triple& planes) {
        return points_.try_emplace(sorted(planes), none).first->second;
    }

  private:
    std::vector<std::uint32_t> plane_of_facet_;
    std::unordered_map<Triple, std::uint32_t, TripleHash> points_;
};

}  // namespace maille::modeler::detail
