#include "volmesh/tet_navigation.hh"

#include <algorithm>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {
namespace {

template <class H>
void sort_unique(HandleList<H>& list) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

const TetMesh& TetNavigation::mesh() const {
    return static_cast<const TetMesh&>(*this);
}

/// The half-edge between two vertices of a cell.
HalfedgeHandle TetNavigation::directed(CellHandle c, VertexHandle from, VertexHandle to) const {
    return mesh().halfedge_handle(mesh().edge_handle(c, mesh().local_edge(c, from, to)), from < to ? 0 : 1);
}

// ---- at a vertex
HalfedgeList TetNavigation::voh_range(VertexHandle v) const {
    HalfedgeList halfedges;
    for (EdgeHandle e : mesh().ve_range(v))
        halfedges.push_back(mesh().halfedge_handle(e, mesh().edge_vertices(e)[0] == v ? 0 : 1));
    return halfedges;
}

HalfedgeList TetNavigation::vih_range(VertexHandle v) const {
    HalfedgeList halfedges = voh_range(v);
    for (HalfedgeHandle& he : halfedges) he = mesh().opposite_halfedge_handle(he);
    return halfedges;
}

FaceList TetNavigation::vf_range(VertexHandle v) const {
    FaceList faces;
    for (HalffaceHandle hf : vhf_range(v)) faces.push_back(mesh().face_handle(hf));
    sort_unique(faces);
    return faces;
}

HalffaceList TetNavigation::vhf_range(VertexHandle v) const {
    HalffaceList halffaces;
    for (CellHandle c : mesh().vc_range(v))
        for (int f = 0; f < 4; ++f)
            if (mesh().cell_vertex(c, f) != v) halffaces.push_back(TetMesh::halfface(c, f));
    std::ranges::sort(halffaces);
    return halffaces;
}

std::size_t TetNavigation::valence(VertexHandle v) const {
    return mesh().vv_range(v).size();
}

// ---- at an edge or a half-edge
std::array<VertexHandle, 2> TetNavigation::ev_range(EdgeHandle e) const {
    return mesh().edge_vertices(e);
}

std::array<HalfedgeHandle, 2> TetNavigation::ehe_range(EdgeHandle e) const {
    return {mesh().halfedge_handle(e, 0), mesh().halfedge_handle(e, 1)};
}

HalffaceList TetNavigation::ehf_range(EdgeHandle e) const {
    const auto [a, b] = mesh().edge_vertices(e);
    HalffaceList halffaces;
    for (CellHandle c : mesh().ec_range(e))
        for (int f = 0; f < 4; ++f)
            if (mesh().cell_vertex(c, f) != a && mesh().cell_vertex(c, f) != b)
                halffaces.push_back(TetMesh::halfface(c, f));
    return halffaces;
}

HalffaceList TetNavigation::hehf_range(HalfedgeHandle he) const {
    const VertexHandle from = mesh().from_vertex_handle(he);
    const VertexHandle to = mesh().to_vertex_handle(he);
    HalffaceList halffaces;
    for (HalffaceHandle hf : ehf_range(mesh().edge_handle(he))) {
        const auto v = mesh().halfface_vertices(hf);
        if (v[(std::ranges::find(v, from) - v.begin() + 1) % 3] == to) halffaces.push_back(hf);
    }
    return halffaces;
}

CellList TetNavigation::hec_range(HalfedgeHandle he) const {
    return mesh().ec_range(mesh().edge_handle(he));
}

std::size_t TetNavigation::valence(EdgeHandle e) const {
    const auto [c, local] = mesh().edge_place(e);
    return mesh().halffaces_around(c, local).size();
}

// ---- at a face or a half-face
std::array<VertexHandle, 3> TetNavigation::fv_range(FaceHandle f) const {
    return mesh().face_vertices(f);
}

std::array<VertexHandle, 3> TetNavigation::hfv_range(HalffaceHandle hf) const {
    return mesh().halfface_vertices(hf);
}

HalffaceList TetNavigation::fhf_range(FaceHandle f) const {
    HalffaceList halffaces{mesh().halfface_handle(f, 0)};
    if (const HalffaceHandle other = mesh().halfface_handle(f, 1); other.is_valid())
        halffaces.push_back(other);
    return halffaces;
}

CellList TetNavigation::fc_range(FaceHandle f) const {
    CellList cells;
    for (HalffaceHandle hf : fhf_range(f)) cells.push_back(TetMesh::incident_cell(hf));
    return cells;
}

std::array<HalfedgeHandle, 3> TetNavigation::hfhe_range(HalffaceHandle hf) const {
    const auto v = mesh().halfface_vertices(hf);
    const CellHandle c = TetMesh::incident_cell(hf);
    return {directed(c, v[0], v[1]), directed(c, v[1], v[2]), directed(c, v[2], v[0])};
}

std::array<EdgeHandle, 3> TetNavigation::hfe_range(HalffaceHandle hf) const {
    const auto halfedges = hfhe_range(hf);
    return {mesh().edge_handle(halfedges[0]), mesh().edge_handle(halfedges[1]),
            mesh().edge_handle(halfedges[2])};
}

// ---- at a cell
std::array<VertexHandle, 4> TetNavigation::cv_range(CellHandle c) const {
    return mesh().cell_vertices(c);
}

std::array<EdgeHandle, 6> TetNavigation::ce_range(CellHandle c) const {
    std::array<EdgeHandle, 6> edges;
    for (int e = 0; e < 6; ++e) edges[e] = mesh().edge_handle(c, e);
    return edges;
}

std::array<FaceHandle, 4> TetNavigation::cf_range(CellHandle c) const {
    std::array<FaceHandle, 4> faces;
    for (int f = 0; f < 4; ++f) faces[f] = mesh().face_handle(TetMesh::halfface(c, f));
    return faces;
}

std::array<HalffaceHandle, 4> TetNavigation::chf_range(CellHandle c) const {
    return {TetMesh::halfface(c, 0), TetMesh::halfface(c, 1), TetMesh::halfface(c, 2),
            TetMesh::halfface(c, 3)};
}

std::array<HalfedgeHandle, 12> TetNavigation::che_range(CellHandle c) const {
    std::array<HalfedgeHandle, 12> halfedges;
    for (int i = 0; i < 12; ++i) halfedges[i] = mesh().halfedge_handle(mesh().edge_handle(c, i / 2), i % 2);
    return halfedges;
}

// ---- steps
HalfedgeHandle TetNavigation::find_halfedge(VertexHandle from, VertexHandle to) const {
    const EdgeHandle e = mesh().find_edge(from, to);
    return e.is_valid() ? mesh().halfedge_handle(e, from < to ? 0 : 1) : HalfedgeHandle();
}

HalfedgeHandle TetNavigation::halfedge_beside(HalfedgeHandle he, HalffaceHandle hf, int step) const {
    const auto halfedges = hfhe_range(hf);
    const auto at = std::ranges::find(halfedges, he) - halfedges.begin();
    return at == 3 ? HalfedgeHandle() : halfedges[(at + step) % 3];
}

HalfedgeHandle TetNavigation::next_halfedge_in_halfface(HalfedgeHandle he, HalffaceHandle hf) const {
    return halfedge_beside(he, hf, 1);
}

HalfedgeHandle TetNavigation::prev_halfedge_in_halfface(HalfedgeHandle he, HalffaceHandle hf) const {
    return halfedge_beside(he, hf, 2);
}

HalffaceHandle TetNavigation::adjacent_halfface_in_cell(HalffaceHandle hf, EdgeHandle e) const {
    const CellHandle c = TetMesh::incident_cell(hf);
    const auto [a, b] = mesh().edge_vertices(e);
    const int i = mesh().local_vertex(c, a);
    const int j = mesh().local_vertex(c, b);
    const int here = TetMesh::local_face(hf);
    if (i < 0 || j < 0 || i == here || j == here) return {};
    // The other face at the edge is opposite the third vertex of this one.
    return TetMesh::halfface(c, 6 - i - j - here);
}

HalffaceHandle TetNavigation::adjacent_halfface_in_cell(HalffaceHandle hf, HalfedgeHandle he) const {
    return adjacent_halfface_in_cell(hf, mesh().edge_handle(he));
}

VertexHandle TetNavigation::vertex_opposite_halfface(HalffaceHandle hf) const {
    return mesh().cell_vertex(TetMesh::incident_cell(hf), TetMesh::local_face(hf));
}

HalffaceHandle TetNavigation::halfface_opposite_vertex(CellHandle c, VertexHandle v) const {
    const int local = mesh().local_vertex(c, v);
    return local < 0 ? HalffaceHandle() : TetMesh::halfface(c, local);
}

}  // namespace maille::volmesh
