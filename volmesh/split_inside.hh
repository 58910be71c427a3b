#pragma once

#include <array>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

///@{
/// The weights of the corners of a face or cell; they sum to 1.
using FaceWeights = std::array<double, 3>;
using CellWeights = std::array<double, 4>;
///@}
///@{
/// Those of its centroid.
inline constexpr FaceWeights middle_of_face{1.0 / 3, 1.0 / 3, 1.0 / 3};
inline constexpr CellWeights middle_of_cell{0.25, 0.25, 0.25, 0.25};
///@}

///@{
/// Splits the cell into four, or the face into three and its one or two cells into three each, at a new
/// vertex: the weighted mean of the corners (of the half-face in the order of halfface_vertices), which may
/// be moved afterwards. Cell and face sets and values pass to the parts by their rules; the new vertex is in
/// a vertex set whose rule is `both_ends` if all corners are and the face or cell lies in the rule's source,
/// and in one whose rule is `from_faces` if the face is in the source. Custom rules count as `copy`.
///
/// Ok where the weights are positive, sum to 1 and give every part a positive volume (exactly).
bool is_split_face_ok(const TetMesh& mesh, HalffaceHandle hf, const FaceWeights& weights = middle_of_face);
VertexHandle split_face(TetMesh& mesh, HalffaceHandle hf, const FaceWeights& weights = middle_of_face);
bool is_split_cell_ok(const TetMesh& mesh, CellHandle c, const CellWeights& weights = middle_of_cell);
VertexHandle split_cell(TetMesh& mesh, CellHandle c, const CellWeights& weights = middle_of_cell);
///@}

}  // namespace maille::volmesh
