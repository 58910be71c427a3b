#pragma once

#include "modeler/arrange_coarsen.hh"
#include "modeler/arrange_scene.hh"

namespace maille::modeler::detail {

/// Gives planar faces the points back that coarsening left out: the triangles that nothing meets come back as
/// they were in `fine`. Points too near to where something meets the face stay out. Where the points fit in
/// nowhere, the arrangement comes back as it is.
Arrangement restore(const Arrangement& arrangement, const Scene& fine, const CoarseScene& coarse,
                    double tolerance);

}  // namespace maille::modeler::detail
