#pragma once

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// Whether a face bounds anything: the mesh, cells in different sets, or a face set.
bool is_interface(const TetMesh& mesh, HalffaceHandle hf);

/// Whether two interface faces belong to one patch: in the same face sets, between cells in the same sets.
bool is_same_patch(const TetMesh& mesh, HalffaceHandle one, HalffaceHandle other);

/// The dimension of what a vertex or an edge lies in, as far as sets tell: 3 inside a region, 2 within a
/// patch of an interface, 1 on a curve (where patches meet, or in an edge set), 0 a vertex that must stay: in
/// a vertex set, or where curves or sheets meet. The mesh's shape has no say: a box whose boundary is one set
/// has no curves.
int stratum(const TetMesh& mesh, VertexHandle v);
/// The same for an edge.
int stratum(const TetMesh& mesh, CellHandle c, int local_edge);
/// As the first one, for a caller who has the cells at v.
int stratum(const TetMesh& mesh, VertexHandle v, const CellList& cells);

}  // namespace maille::volmesh
