#pragma once

#include <cstdint>
#include <span>

#include "modeler/primitive.hh"
#include "volmesh/tri_mesh.hh"

namespace maille::modeler {

/// A place on a face of a primitive.
struct FacePoint {
    std::uint32_t face;
    Point point;
};

/// Makes the points vertices of a tessellation, so that its flat triangles are on the true surface there.
/// Points must lie on their faces' surfaces; those that no triangle of the face is under are left out, and
/// those so near to a vertex that there would be slivers. At a rim the triangles on both sides are divided.
/// Cost: a pass over the triangles for each point.
void insert_points(volmesh::TriMesh& mesh, const Shape& shape, std::span<const FacePoint> points);

}  // namespace maille::modeler
