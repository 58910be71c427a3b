#pragma once

#include <array>
#include <cstddef>

#include <boost/container/small_vector.hpp>

#include "volmesh/handles.hh"

namespace maille::volmesh {

class TetMesh;

/// Entities met by a local query, in an order that depends on the mesh alone.
template <class H>
using HandleList = boost::container::small_vector<H, 48>;
///@{
/// A list of entities of one kind.
using VertexList = HandleList<VertexHandle>;
using EdgeList = HandleList<EdgeHandle>;
using HalfedgeList = HandleList<HalfedgeHandle>;
using FaceList = HandleList<FaceHandle>;
using HalffaceList = HandleList<HalffaceHandle>;
using CellList = HandleList<CellHandle>;
///@}

/// The incidences and steps of a TetMesh that follow from the few that it stores; a TetMesh has them all.
///
/// Edges and faces are numbered when they are first asked for by handle, see TetMesh. The handles given must
/// be of entities that the mesh has.
class TetNavigation {
  public:
    // ---- at a vertex; ascending
    HalfedgeList voh_range(VertexHandle v) const;  ///< half-edges that leave it, one an edge
    HalfedgeList vih_range(VertexHandle v) const;  ///< half-edges that come to it
    FaceList vf_range(VertexHandle v) const;       ///< faces that have it as a corner
    HalffaceList vhf_range(VertexHandle v) const;  ///< their half-faces: three a cell
    /// Number of edges.
    std::size_t valence(VertexHandle v) const;

    // ---- at an edge or a half-edge
    std::array<VertexHandle, 2> ev_range(EdgeHandle e) const;     ///< the lower one first
    std::array<HalfedgeHandle, 2> ehe_range(EdgeHandle e) const;  ///< by side
    /// Half-faces of the cells round the edge, in their order: two a cell.
    HalffaceList ehf_range(EdgeHandle e) const;
    /// Those of ehf_range that have the half-edge among theirs: one a cell.
    HalffaceList hehf_range(HalfedgeHandle he) const;
    CellList hec_range(HalfedgeHandle he) const;  ///< as TetMesh::ec_range of its edge
    /// Number of faces.
    std::size_t valence(EdgeHandle e) const;

    // ---- at a face or a half-face
    std::array<VertexHandle, 3> fv_range(FaceHandle f) const;        ///< as its first half-face turns
    std::array<VertexHandle, 3> hfv_range(HalffaceHandle hf) const;  ///< as TetMesh::halfface_vertices
    HalffaceList fhf_range(FaceHandle f) const;                      ///< one or two
    CellList fc_range(FaceHandle f) const;                           ///< one or two
    /// From each vertex of halfface_vertices() to the next.
    std::array<HalfedgeHandle, 3> hfhe_range(HalffaceHandle hf) const;
    /// The edges of those half-edges, in their order.
    std::array<EdgeHandle, 3> hfe_range(HalffaceHandle hf) const;

    // ---- at a cell; by local number
    std::array<VertexHandle, 4> cv_range(CellHandle c) const;     ///< as TetMesh::cell_vertices
    std::array<EdgeHandle, 6> ce_range(CellHandle c) const;       ///< in the order of tet::edge_vertices
    std::array<FaceHandle, 4> cf_range(CellHandle c) const;       ///< each opposite the vertex of its number
    std::array<HalffaceHandle, 4> chf_range(CellHandle c) const;  ///< the same, seen from the cell
    /// Both half-edges of each edge, the one of side 0 first.
    std::array<HalfedgeHandle, 12> che_range(CellHandle c) const;

    // ---- steps; an invalid handle where there is none
    /// The half-edge between two vertices. Cost: the cells at the first.
    HalfedgeHandle find_halfedge(VertexHandle from, VertexHandle to) const;
    ///@{
    /// Which half-edge follows, or goes before, on the way round the half-face.
    HalfedgeHandle next_halfedge_in_halfface(HalfedgeHandle he, HalffaceHandle hf) const;
    HalfedgeHandle prev_halfedge_in_halfface(HalfedgeHandle he, HalffaceHandle hf) const;
    ///@}
    ///@{
    /// The other half-face of the same cell at the edge, which must be one of the half-face's.
    HalffaceHandle adjacent_halfface_in_cell(HalffaceHandle hf, EdgeHandle e) const;
    HalffaceHandle adjacent_halfface_in_cell(HalffaceHandle hf, HalfedgeHandle he) const;
    ///@}
    /// The vertex of the half-face's cell that is not on it.
    VertexHandle vertex_opposite_halfface(HalffaceHandle hf) const;
    /// The half-face of the cell that doesn't have the vertex, which must be one of the cell's.
    HalffaceHandle halfface_opposite_vertex(CellHandle c, VertexHandle v) const;

    /// @cond
  protected:
    TetNavigation() = default;
    ~TetNavigation() = default;
    TetNavigation(const TetNavigation&) = default;
    TetNavigation(TetNavigation&&) noexcept = default;
    TetNavigation& operator=(const TetNavigation&) = default;
    TetNavigation& operator=(TetNavigation&&) noexcept = default;
    /// @endcond

  private:
    const TetMesh& mesh() const;
    HalfedgeHandle directed(CellHandle c, VertexHandle from, VertexHandle to) const;
    HalfedgeHandle halfedge_beside(HalfedgeHandle he, HalffaceHandle hf, int step) const;
};

}  // namespace maille::volmesh
