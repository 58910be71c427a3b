#pragma once

// Included by tet_mesh.hh.

#include <cstddef>
#include <iterator>
#include <tuple>
#include <utility>

namespace maille::volmesh {

template <>
struct SmartHandle<VertexHandle>;
template <>
struct SmartHandle<EdgeHandle>;
template <>
struct SmartHandle<HalfedgeHandle>;
template <>
struct SmartHandle<FaceHandle>;
template <>
struct SmartHandle<HalffaceHandle>;
template <>
struct SmartHandle<CellHandle>;

/// The entities round a smart handle, as smart handles in turn. It owns its handles, and passes as the list
/// of plain ones, or as their array where their number is fixed (auto [a, b] = edge.vertices()).
template <class List>
struct SmartList {
    using Plain = typename List::value_type;  ///< the kind of handle that is kept
    using value_type = SmartHandle<Plain>;    ///< the kind that it is read as

    /// Goes at random; what it points at is made when it is asked for.
    class Iterator {
      public:
        using value_type = SmartHandle<Plain>;
        using difference_type = std::ptrdiff_t;
        using reference = value_type;
        using iterator_category = std::input_iterator_tag;
        using iterator_concept = std::random_access_iterator_tag;

        Iterator() = default;
        Iterator(const Plain* at, const TetMesh* mesh) : at_(at), mesh_(mesh) {}
        value_type operator*() const { return {*at_, mesh_}; }
        value_type operator[](difference_type n) const { return {at_[n], mesh_}; }
        Iterator& operator+=(difference_type n) {
            at_ += n;
            return *this;
        }
        Iterator& operator-=(difference_type n) { return *this += -n; }
        Iterator& operator++() { return *this += 1; }
        Iterator& operator--() { return *this += -1; }
        Iterator operator++(int) { return std::exchange(*this, *this + 1); }
        Iterator operator--(int) { return std::exchange(*this, *this - 1); }
        friend Iterator operator+(Iterator i, difference_type n) { return i += n; }
        friend Iterator operator+(difference_type n, Iterator i) { return i += n; }
        friend Iterator operator-(Iterator i, difference_type n) { return i -= n; }
        friend difference_type operator-(const Iterator& a, const Iterator& b) { return a.at_ - b.at_; }
        friend bool operator==(const Iterator& a, const Iterator& b) { return a.at_ == b.at_; }
        friend auto operator<=>(const Iterator& a, const Iterator& b) { return a.at_ <=> b.at_; }

      private:
        const Plain* at_ = nullptr;
        const TetMesh* mesh_ = nullptr;
    };

    List handles;                   ///< the plain ones
    const TetMesh* mesh = nullptr;  ///< theirs

    ///@{
    /// As a constant std::vector of smart handles has it.
    Iterator begin() const { return {handles.data(), mesh}; }
    Iterator end() const { return {handles.data() + handles.size(), mesh}; }
    std::size_t size() const { return handles.size(); }
    bool empty() const { return handles.empty(); }
    value_type operator[](std::size_t i) const { return {handles[i], mesh}; }
    value_type front() const { return {handles.front(), mesh}; }
    value_type back() const { return {handles.back(), mesh}; }
    ///@}
    /// The plain handles.
    operator const List&() const { return handles; }  // NOLINT: it is such a list
    /// For structured bindings.
    template <std::size_t I>
    friend value_type get(const SmartList& list) {
        return list[I];
    }
};

/// The same where their number is fixed.
template <std::size_t N, class H>
using SmartArray = SmartList<std::array<H, N>>;

/// A vertex handle that knows its mesh, so that incidences read as vh.cells(). Valid while the mesh stays
/// where it is. Orders and costs are those of the mesh's queries.
template <>
struct SmartHandle<VertexHandle> : VertexHandle {
    const TetMesh* mesh = nullptr;  ///< whose vertex it is
    /// Its place.
    const Point& point() const { return mesh->point(*this); }
    SmartList<CellList> cells() const;                   ///< TetMesh::vc_range
    SmartList<EdgeList> edges() const;                   ///< TetMesh::ve_range
    SmartList<VertexList> vertices() const;              ///< TetMesh::vv_range: those an edge away
    SmartList<FaceList> faces() const;                   ///< TetNavigation::vf_range
    SmartList<HalffaceList> halffaces() const;           ///< TetNavigation::vhf_range
    SmartList<HalfedgeList> outgoing_halfedges() const;  ///< TetNavigation::voh_range
    SmartList<HalfedgeList> incoming_halfedges() const;  ///< TetNavigation::vih_range
    /// Number of edges.
    std::size_t valence() const { return mesh->valence(VertexHandle(*this)); }
    /// Whether a boundary face has it.
    bool is_boundary() const { return mesh->is_boundary(VertexHandle(*this)); }
};
/// An edge handle that knows its mesh.
template <>
struct SmartHandle<EdgeHandle> : EdgeHandle {
    const TetMesh* mesh = nullptr;                         ///< whose edge it is
    SmartArray<2, VertexHandle> vertices() const;          ///< its ends, the lower one first
    SmartHandle<HalfedgeHandle> halfedge(int side) const;  ///< side 0 leaves the lower end
    SmartArray<2, HalfedgeHandle> halfedges() const;       ///< both, by side
    SmartList<CellList> cells() const;                     ///< TetMesh::ec_range
    SmartList<FaceList> faces() const;                     ///< TetMesh::ef_range
    SmartList<HalffaceList> halffaces() const;             ///< TetNavigation::ehf_range
    /// Number of faces.
    std::size_t valence() const { return mesh->valence(EdgeHandle(*this)); }
    /// Whether a boundary face has it.
    bool is_boundary() const { return mesh->is_boundary(EdgeHandle(*this)); }
};
/// A half-edge handle that knows its mesh.
template <>
struct SmartHandle<HalfedgeHandle> : HalfedgeHandle {
    const TetMesh* mesh = nullptr;           ///< whose half-edge it is
    SmartHandle<VertexHandle> from() const;  ///< the end that it leaves
    SmartHandle<VertexHandle> to() const;    ///< the end that it comes to
    SmartHandle<EdgeHandle> edge() const;    ///< that it is one of the two of
    /// The same edge, the other way.
    SmartHandle opposite() const { return {mesh->opposite_halfedge_handle(*this), mesh}; }
    SmartList<CellList> cells() const;          ///< TetMesh::ec_range of its edge
    SmartList<HalffaceList> halffaces() const;  ///< TetNavigation::hehf_range: those that turn with it
    /// Whether a boundary face has its edge.
    bool is_boundary() const { return mesh->is_boundary(HalfedgeHandle(*this)); }
};
/// A face handle that knows its mesh.
template <>
struct SmartHandle<FaceHandle> : FaceHandle {
    const TetMesh* mesh = nullptr;                         ///< whose face it is
    SmartHandle<HalffaceHandle> halfface(int side) const;  ///< side 1 is invalid on the boundary
    SmartList<HalffaceList> halffaces() const;             ///< one or two
    SmartArray<3, VertexHandle> vertices() const;          ///< as its first half-face turns
    SmartList<EdgeList> edges() const;                     ///< TetMesh::fe_range
    SmartList<CellList> cells() const;                     ///< one or two
    /// Whether it has one cell only.
    bool is_boundary() const { return mesh->is_boundary(FaceHandle(*this)); }
};
/// A half-face handle that knows its mesh.
template <>
struct SmartHandle<HalffaceHandle> : HalffaceHandle {
    const TetMesh* mesh = nullptr;                    ///< whose half-face it is
    SmartHandle<CellHandle> cell() const;             ///< from which it is seen
    SmartHandle<FaceHandle> face() const;             ///< that it is a side of
    SmartArray<3, VertexHandle> vertices() const;     ///< counter-clockwise seen from outside its cell
    SmartArray<3, EdgeHandle> edges() const;          ///< from each of the vertices to the next
    SmartArray<3, HalfedgeHandle> halfedges() const;  ///< the same, as they turn
    /// The same face seen from its other cell; invalid on the boundary.
    SmartHandle opposite() const { return {mesh->opposite_halfface_handle(*this), mesh}; }
    SmartHandle<VertexHandle> opposite_vertex() const;  ///< the vertex of its cell that isn't on it
    /// The other half-face of its cell at one of its edges.
    SmartHandle adjacent_in_cell(EdgeHandle e) const {
        return {mesh->adjacent_halfface_in_cell(*this, e), mesh};
    }
    /// Whether it has no opposite.
    bool is_boundary() const { return mesh->is_boundary(HalffaceHandle(*this)); }
};
/// A cell handle that knows its mesh. Lists are by local number.
template <>
struct SmartHandle<CellHandle> : CellHandle {
    const TetMesh* mesh = nullptr;                     ///< whose cell it is
    SmartArray<4, VertexHandle> vertices() const;      ///< positively oriented
    SmartArray<6, EdgeHandle> edges() const;           ///< in the order of tet::edge_vertices
    SmartArray<12, HalfedgeHandle> halfedges() const;  ///< both of each edge, side 0 first
    SmartArray<4, FaceHandle> faces() const;           ///< each opposite the vertex of its number
    SmartArray<4, HalffaceHandle> halffaces() const;   ///< the same, seen from the cell
    SmartList<CellList> neighbors() const;             ///< those beyond its faces, at most four
    /// Whether one of its faces is on the boundary.
    bool is_boundary() const { return mesh->is_boundary(CellHandle(*this)); }
};

/// The handle with its mesh.
template <class H>
SmartHandle<H> make_smart(H h, const TetMesh& mesh) {
    return {h, &mesh};
}

inline SmartList<CellList> SmartHandle<VertexHandle>::cells() const {
    return {mesh->vc_range(*this), mesh};
}
inline SmartList<EdgeList> SmartHandle<VertexHandle>::edges() const {
    return {mesh->ve_range(*this), mesh};
}
inline SmartList<VertexList> SmartHandle<VertexHandle>::vertices() const {
    return {mesh->vv_range(*this), mesh};
}
inline SmartList<FaceList> SmartHandle<VertexHandle>::faces() const {
    return {mesh->vf_range(*this), mesh};
}
inline SmartList<HalffaceList> SmartHandle<VertexHandle>::halffaces() const {
    return {mesh->vhf_range(*this), mesh};
}
inline SmartList<HalfedgeList> SmartHandle<VertexHandle>::outgoing_halfedges() const {
    return {mesh->voh_range(*this), mesh};
}
inline SmartList<HalfedgeList> SmartHandle<VertexHandle>::incoming_halfedges() const {
    return {mesh->vih_range(*this), mesh};
}

inline SmartArray<2, VertexHandle> SmartHandle<EdgeHandle>::vertices() const {
    return {mesh->edge_vertices(*this), mesh};
}
inline SmartHandle<HalfedgeHandle> SmartHandle<EdgeHandle>::halfedge(int side) const {
    return {mesh->halfedge_handle(*this, side), mesh};
}
inline SmartArray<2, HalfedgeHandle> SmartHandle<EdgeHandle>::halfedges() const {
    return {mesh->ehe_range(*this), mesh};
}
inline SmartList<CellList> SmartHandle<EdgeHandle>::cells() const {
    return {mesh->ec_range(*this), mesh};
}
inline SmartList<FaceList> SmartHandle<EdgeHandle>::faces() const {
    return {mesh->ef_range(*this), mesh};
}
inline SmartList<HalffaceList> SmartHandle<EdgeHandle>::halffaces() const {
    return {mesh->ehf_range(*this), mesh};
}

inline SmartHandle<VertexHandle> SmartHandle<HalfedgeHandle>::from() const {
    return {mesh->from_vertex_handle(*this), mesh};
}
inline SmartHandle<VertexHandle> SmartHandle<HalfedgeHandle>::to() const {
    return {mesh->to_vertex_handle(*this), mesh};
}
inline SmartHandle<EdgeHandle> SmartHandle<HalfedgeHandle>::edge() const {
    return {mesh->edge_handle(*this), mesh};
}
inline SmartList<CellList> SmartHandle<HalfedgeHandle>::cells() const {
    return {mesh->hec_range(*this), mesh};
}
inline SmartList<HalffaceList> SmartHandle<HalfedgeHandle>::halffaces() const {
    return {mesh->hehf_range(*this), mesh};
}

inline SmartHandle<HalffaceHandle> SmartHandle<FaceHandle>::halfface(int side) const {
    return {mesh->halfface_handle(*this, side), mesh};
}
inline SmartList<HalffaceList> SmartHandle<FaceHandle>::halffaces() const {
    return {mesh->fhf_range(*this), mesh};
}
inline SmartArray<3, VertexHandle> SmartHandle<FaceHandle>::vertices() const {
    return {mesh->face_vertices(*this), mesh};
}
inline SmartList<EdgeList> SmartHandle<FaceHandle>::edges() const {
    return {mesh->fe_range(*this), mesh};
}
inline SmartList<CellList> SmartHandle<FaceHandle>::cells() const {
    return {mesh->fc_range(*this), mesh};
}

inline SmartHandle<CellHandle> SmartHandle<HalffaceHandle>::cell() const {
    return {TetMesh::incident_cell(*this), mesh};
}
inline SmartHandle<FaceHandle> SmartHandle<HalffaceHandle>::face() const {
    return {mesh->face_handle(*this), mesh};
}
inline SmartArray<3, VertexHandle> SmartHandle<HalffaceHandle>::vertices() const {
    return {mesh->halfface_vertices(*this), mesh};
}
inline SmartArray<3, EdgeHandle> SmartHandle<HalffaceHandle>::edges() const {
    return {mesh->hfe_range(*this), mesh};
}
inline SmartArray<3, HalfedgeHandle> SmartHandle<HalffaceHandle>::halfedges() const {
    return {mesh->hfhe_range(*this), mesh};
}
inline SmartHandle<VertexHandle> SmartHandle<HalffaceHandle>::opposite_vertex() const {
    return {mesh->vertex_opposite_halfface(*this), mesh};
}

inline SmartArray<4, VertexHandle> SmartHandle<CellHandle>::vertices() const {
    return {mesh->cell_vertices(*this), mesh};
}
inline SmartArray<6, EdgeHandle> SmartHandle<CellHandle>::edges() const {
    return {mesh->ce_range(*this), mesh};
}
inline SmartArray<12, HalfedgeHandle> SmartHandle<CellHandle>::halfedges() const {
    return {mesh->che_range(*this), mesh};
}
inline SmartArray<4, FaceHandle> SmartHandle<CellHandle>::faces() const {
    return {mesh->cf_range(*this), mesh};
}
inline SmartArray<4, HalffaceHandle> SmartHandle<CellHandle>::halffaces() const {
    return {mesh->chf_range(*this), mesh};
}
inline SmartList<CellList> SmartHandle<CellHandle>::neighbors() const {
    return {mesh->cc_range(*this), mesh};
}

}  // namespace maille::volmesh

template <class H, std::size_t N>
struct std::tuple_size<maille::volmesh::SmartList<std::array<H, N>>>
    : std::integral_constant<std::size_t, N> {};
template <std::size_t I, class H, std::size_t N>
struct std::tuple_element<I, maille::volmesh::SmartList<std::array<H, N>>> {
    using type = maille::volmesh::SmartHandle<H>;
};
