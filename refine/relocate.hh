#pragma once

#include "volmesh/tet_mesh.hh"

namespace maille::refine {

using volmesh::CellHandle;
using volmesh::CellList;
using volmesh::Point;
using volmesh::TetMesh;
using volmesh::VertexHandle;

/// Shape of the tetrahedron, 6 sqrt(2) V / Lrms^3 (the paper's gamma): 1 where it is regular, 0 where it is
/// flat or inverted, which is decided exactly.
double shape(const Point& a, const Point& b, const Point& c, const Point& d);

/// The worst shape among the cells, if the vertex were at `at`.
double worst_shape(const TetMesh& mesh, const CellList& cells, VertexHandle v, const Point& at);

/// Whether a vertex may move without changing anything but the shapes of the cells round it: it is inside the
/// mesh, and all its cells are in the same sets and its faces and edges in none.
bool is_free(const TetMesh& mesh, VertexHandle v, const CellList& cells);

/// The centroid of the polyhedron that these cells make up.
Point polyhedron_centroid(const TetMesh& mesh, const CellList& cells);

/// Moves the vertex towards the centroid of the polyhedron round it, or less far, if that betters the worst
/// of its cells. Returns whether it moved. Precondition: the vertex is free, and these are its cells.
bool relax(TetMesh& mesh, VertexHandle v, const CellList& cells);

}  // namespace maille::refine
