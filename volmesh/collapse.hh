#pragma once

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// Whether the edge from `gone` to `heir` can be collapsed into `heir`, which stays where it is:
/// - the mesh stays one and the same solid (the link condition: T. K. Dey, H. Edelsbrunner, S. Guha, D. V.
///   Nekhayev, "Topology preserving edge contraction", 1999), and so do its interfaces and curves, along
///   which a vertex goes only if it and the edge lie in nothing less (strata.hh); nothing that is in a set
///   merges with something else;
/// - every new cell is positively oriented (exactly);
/// - interfaces and curves stay where they were, but for `tolerance`: the heir is as near as that to the
/// plane
///   of every interface face that changes, and the vertex that goes to the line that the curve has after.
bool is_collapse_ok(const TetMesh& mesh, VertexHandle gone, VertexHandle heir, double tolerance = 0);

/// Collapses the edge: the cells round it vanish, those at the other end take the heir in its place. Sets and
/// values pass on as retriangulation.hh says; values of the vertex that goes are lost. Precondition:
/// is_collapse_ok.
void collapse_edge(TetMesh& mesh, VertexHandle gone, VertexHandle heir);

}  // namespace maille::volmesh
