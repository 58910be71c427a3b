#pragma once

#include <span>

#include "volmesh/tet_mesh.hh"

namespace maille::quality {

using volmesh::CellHandle;
using volmesh::CellList;
using volmesh::Point;
using volmesh::TetMesh;
using volmesh::VertexHandle;

/// Shape of the tetrahedron, 6 sqrt(2) V / Lrms^3 (the paper's gamma): 1 where it is regular, 0 where it is
/// flat or inverted, which is decided exactly.
double exact_gamma(const Point& a, const Point& b, const Point& c, const Point& d);

/// The worst shape among the cells, if the vertex were at `at`.
double worst_shape(const TetMesh& mesh, const CellList& cells, VertexHandle v, const Point& at);

/// Whether a vertex may move without changing anything but the shapes of the cells round it: it is inside the
/// mesh, and all its cells are in the same sets and its faces and edges in none.
bool is_free(const TetMesh& mesh, VertexHandle v, const CellList& cells);

/// The centroid of the polyhedron that these cells make up.
Point polyhedron_centroid(const TetMesh& mesh, const CellList& cells);

/// Moves the vertex to where the worst of its cells is best: on the way to one of the targets, all, half or a
/// quarter of it. Returns whether it moved; it stays where no place is better. Precondition: the vertex is
/// free, and these are its cells.
bool relocate(TetMesh& mesh, VertexHandle v, const CellList& cells, std::span<const Point> targets);

/// Relocates the vertex towards the centroid of the polyhedron round it. (The paper, section 3.3, "Nodes
/// repositionning".)
bool relax(TetMesh& mesh, VertexHandle v, const CellList& cells);

}  // namespace maille::quality
