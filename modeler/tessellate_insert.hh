#pragma once

#include <cstdint>
#include <span>

#include "modeler/primitive.hh"
#include "volmesh/tri_mesh.hh"

namespace maille::modeler {

/// Points so near to a surface, in parts of the edges' length, are on it: models are written with six digits.
constexpr double on_surface = 1e-5;

/// A place on a face of a primitive.
struct FacePoint {
    std::uint32_t face;
    Point point;
};

/// Makes the points vertices of a tessellation, so that its flat triangles are on the true surface there.
/// Points must lie on their faces' surfaces; those that no triangle of the face is under are left out. At a
/// rim the triangles on both sides are divided; between a rim's straight edge and its true curve, that edge
/// first. Where there is a vertex already, or one so near that there would be slivers, the edges at it are
/// halved: a point that is given again was not enough. Cost: a pass over the triangles for each point.
void insert_points(volmesh::TriMesh& mesh, const Shape& shape, std::span<const FacePoint> points);

}  // namespace maille::modeler
