#pragma once

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// Signed volume of the tetrahedron abcd: positive where bcd turns counter-clockwise seen from outside.
double tet_volume(const Point& a, const Point& b, const Point& c, const Point& d);
double triangle_area(const Point& a, const Point& b, const Point& c);

double volume(const TetMesh& mesh, CellHandle c);
double area(const TetMesh& mesh, HalffaceHandle hf);
/// Of all cells; of all boundary faces.
double volume(const TetMesh& mesh);
double boundary_area(const TetMesh& mesh);
/// Volume, area or length of a set's members; for a vertex set their number.
double measure(const TetMesh& mesh, SetHandle set);

}  // namespace maille::volmesh
