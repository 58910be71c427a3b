#pragma once

#include "modeler/remesh_net.hh"

namespace maille::modeler::remeshing {

/// A triangle by the numbers and the places of its vertices.
struct PlacedTriangle {
    std::array<Index, 3> vertices;
    Corners corners;
};

/// Whether two triangles meet elsewhere than in the vertices and the edge that they share. Exact. A triangle
/// without area counts as its edges, and its neighbours as clear of it.
bool collide(const PlacedTriangle& a, const PlacedTriangle& b);

/// Whether the three points lie on one line. Exact.
bool has_no_area(const Corners& corners);

/// Whether the point is strictly inside the tetrahedron, whichever way that is oriented. Exact.
bool is_inside(const std::array<Vec3, 4>& tetrahedron, const Vec3& p);

}  // namespace maille::modeler::remeshing
