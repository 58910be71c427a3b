#pragma once

#include "modeler/model.hh"

namespace maille::modeler {

/// The same solid, of primitives that end not far beyond where they matter: a cube of a kilometre that halves a
/// bolt becomes a few times as large as the bolt. Planar faces of polyhedra and cones that lie farther out
/// than the part that matters is large are moved in, parallel to themselves, where all edges that they shorten
/// allow it. Numbers, names and the tree stay.
Model trimmed(const Model& model);

}  // namespace maille::modeler
