#pragma once

#include <span>
#include <vector>

#include "modeler/shapes.hh"
#include "modeler/triple.hh"

namespace maille::modeler {

/// The triangles of a closed surface as the faces of a polyhedron: those that lie in one plane, to rounding,
/// and hang together are one face. Faces between which the surface bends by less than 30 degrees share a
/// name; the names are `patch0`, `patch1`, ... in the order of the triangles.
std::vector<PolyhedronFace> merge_coplanar(std::span<const Point> points, std::span<const Triple> triangles);

}  // namespace maille::modeler
