#pragma once

#include "modeler/arrange_cluster.hh"
#include "modeler/arrange_label.hh"
#include "modeler/arrange_scene.hh"

namespace maille::modeler::detail {

/// The facets between different regions, each cluster triangulated anew with as few of the new points as it
/// needs, in doubles. Points of the scene that are kept keep their coordinates.
Arrangement simplify(const Subdivision& subdivision, const std::vector<Sides>& sides, const Scene& scene,
                     const PointRegistry& registry);

}  // namespace maille::modeler::detail
