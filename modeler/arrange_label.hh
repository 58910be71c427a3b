#pragma once

#include <vector>

#include "modeler/arrange_cluster.hh"
#include "modeler/csg_tree.hh"

namespace maille::modeler::detail {

/// The regions on the two sides of a sheet, as its pieces are oriented.
struct Sides {
    Region front;
    Region back;
};

/// Finds for each sheet which region the tree gives its two sides to. The scene is what was subdivided.
std::vector<Sides> label_sheets(const Subdivision& subdivision, const FacetComplex& scene,
                                const ExactPositions& positions, const PointRegistry& registry,
                                const CsgTree& tree);

}  // namespace maille::modeler::detail
