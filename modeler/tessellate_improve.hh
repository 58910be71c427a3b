#pragma once

#include <span>

#include "modeler/tessellate_seed.hh"

namespace maille::modeler {

/// Gives the triangles good shapes and the wanted size, by splitting and collapsing edges, flipping them, and
/// moving vertices along the surface. The edges between two faces, and the corners, stay as they are; so does
/// all of face 0 if asked.
void improve(volmesh::TriMesh& mesh, const Shape& shape, const Sizing& sizing,
             std::span<const std::uint32_t> corners, bool keep_first_face = false);

}  // namespace maille::modeler
