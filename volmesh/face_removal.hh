#pragma once

#include <span>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// Whether the faces between two vertices a and b can be removed: each has a cell with a on the side of the
/// half-face given and one with b beyond, they hang together like a polygon's triangulation, they and what
/// they are between is in no set that could tell the sides apart (strata.hh), and every new cell is
/// positively oriented (exactly).
bool is_face_removal_ok(const TetMesh& mesh, std::span<const HalffaceHandle> faces);

/// Removes the faces: 2 m cells become m + 2 round the new edge a-b, which is the reverse of an edge's
/// removal. (J. R. Shewchuk, "Two discrete optimization algorithms for the topological improvement of
/// tetrahedral meshes", 2002.) Precondition: is_face_removal_ok.
void remove_faces(TetMesh& mesh, std::span<const HalffaceHandle> faces);

///@{
/// The 2-3 flip: the removal of one face.
bool is_flip_23_ok(const TetMesh& mesh, HalffaceHandle hf);
void flip_23(TetMesh& mesh, HalffaceHandle hf);
///@}

}  // namespace maille::volmesh
