#pragma once

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// The exact sign of a tetrahedron's volume: 1 positively oriented, 0 flat, -1 inverted. Some flops where
/// floating point decides, exact rational arithmetic where it can't.
int orientation(const Point& a, const Point& b, const Point& c, const Point& d);

}  // namespace maille::volmesh
