#pragma once

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// Signed volume of the tetrahedron abcd: positive where bcd turns counter-clockwise seen from outside.
double tet_volume(const Point& a, const Point& b, const Point& c, const Point& d);
/// Area of the triangle abc, never negative.
double triangle_area(const Point& a, const Point& b, const Point& c);

double volume(const TetMesh& mesh, CellHandle c);     ///< signed: negative where the cell is inside out
double area(const TetMesh& mesh, HalffaceHandle hf);  ///< of the face
double volume(const TetMesh& mesh);                   ///< sum over all cells
double boundary_area(const TetMesh& mesh);            ///< sum over all boundary faces
/// Volume, area or length of a set's members; for a vertex set their number.
double measure(const TetMesh& mesh, SetHandle set);

}  // namespace maille::volmesh
