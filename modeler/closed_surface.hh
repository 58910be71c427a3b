#pragma once

#include <cstdint>

#include "modeler/arrange.hh"
#include "modeler/shape_polyhedron.hh"
#include "volmesh/tri_mesh.hh"

namespace maille::modeler {

/// A tessellation as an arrangement takes it. Face i of the primitive has the surface number
/// `first_surface` + i.
ClosedSurface closed_surface(const volmesh::TriMesh& tessellation, std::uint32_t first_surface);

/// A polyhedron in as few triangles as there can be; its surfaces are numbered by its faces.
ClosedSurface closed_surface(const Polyhedron& shape);

}  // namespace maille::modeler
