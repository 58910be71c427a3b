#pragma once

// Included by tet_mesh.hh.

#include <iterator>
#include <ranges>

namespace maille::volmesh {

/// A handle that knows its mesh, so that incidences read as vh.cells(). Valid while the mesh stays where it
/// is.
template <>
struct SmartHandle<VertexHandle> : VertexHandle {
    const TetMesh* mesh = nullptr;
    const Point& point() const { return mesh->point(*this); }
    CellList cells() const { return mesh->vc_range(*this); }
    EdgeList edges() const { return mesh->ve_range(*this); }
    VertexList vertices() const { return mesh->vv_range(*this); }
    bool is_boundary() const { return mesh->is_boundary(VertexHandle(*this)); }
};
template <>
struct SmartHandle<EdgeHandle> : EdgeHandle {
    const TetMesh* mesh = nullptr;
    std::array<VertexHandle, 2> vertices() const { return mesh->edge_vertices(*this); }
    CellList cells() const { return mesh->ec_range(*this); }
    FaceList faces() const { return mesh->ef_range(*this); }
    bool is_boundary() const { return mesh->is_boundary(EdgeHandle(*this)); }
};
template <>
struct SmartHandle<FaceHandle> : FaceHandle {
    const TetMesh* mesh = nullptr;
    HalffaceHandle halfface(int side) const { return mesh->halfface_handle(*this, side); }
    std::array<VertexHandle, 3> vertices() const { return mesh->face_vertices(*this); }
    EdgeList edges() const { return mesh->fe_range(*this); }
    bool is_boundary() const { return mesh->is_boundary(FaceHandle(*this)); }
};
template <>
struct SmartHandle<HalffaceHandle> : HalffaceHandle {
    const TetMesh* mesh = nullptr;
    CellHandle cell() const { return TetMesh::incident_cell(*this); }
    std::array<VertexHandle, 3> vertices() const { return mesh->halfface_vertices(*this); }
    SmartHandle opposite() const { return {mesh->opposite_halfface_handle(*this), mesh}; }
    bool is_boundary() const { return mesh->is_boundary(HalffaceHandle(*this)); }
};
template <>
struct SmartHandle<CellHandle> : CellHandle {
    const TetMesh* mesh = nullptr;
    std::array<VertexHandle, 4> vertices() const { return mesh->cell_vertices(*this); }
    CellList neighbors() const { return mesh->cc_range(*this); }
    std::array<FaceHandle, 4> faces() const {
        std::array<FaceHandle, 4> all;
        for (int f = 0; f < 4; ++f) all[f] = mesh->face_handle(TetMesh::halfface(*this, f));
        return all;
    }
    std::array<EdgeHandle, 6> edges() const {
        std::array<EdgeHandle, 6> all;
        for (int e = 0; e < 6; ++e) all[e] = mesh->edge_handle(*this, e);
        return all;
    }
    bool is_boundary() const { return mesh->is_boundary(CellHandle(*this)); }
};

/// The entities of one kind, or those on the boundary, in ascending order; deleted ones are left out.
template <class H>
class EntityRange : public std::ranges::view_interface<EntityRange<H>> {
  public:
    class Iterator {
      public:
        using value_type = SmartHandle<H>;
        using difference_type = std::ptrdiff_t;
        using iterator_concept = std::forward_iterator_tag;

        Iterator() = default;
        Iterator(const EntityRange& range, typename H::Index idx)
            : mesh_(range.mesh_), idx_(idx), end_(range.n_), filter_(range.filter_) {
            skip();
        }
        value_type operator*() const { return {H(idx_), mesh_}; }
        Iterator& operator++() {
            ++idx_;
            skip();
            return *this;
        }
        Iterator operator++(int) {
            Iterator before = *this;
            ++*this;
            return before;
        }
        friend bool operator==(const Iterator& a, const Iterator& b) { return a.idx_ == b.idx_; }

      private:
        void skip() {
            if (filter_ == Filter::nothing) return;
            while (idx_ < end_ && is_left_out(H(idx_))) ++idx_;
        }
        bool is_left_out(H h) const {
            return mesh_->is_deleted(h) || (filter_ == Filter::interior && !mesh_->is_boundary(h));
        }

        const TetMesh* mesh_ = nullptr;
        typename H::Index idx_ = 0, end_ = 0;
        typename EntityRange::Filter filter_{};
    };

    /// What is left out: nothing, deleted entities, or also those that aren't on the boundary.
    enum class Filter : std::uint8_t { nothing, deleted, interior };

    EntityRange() = default;
    EntityRange(const TetMesh& mesh, typename H::Index n, Filter filter)
        : mesh_(&mesh), n_(n), filter_(filter) {}
    Iterator begin() const { return Iterator(*this, 0); }
    Iterator end() const { return Iterator(*this, n_); }

  private:
    const TetMesh* mesh_ = nullptr;
    typename H::Index n_ = 0;
    Filter filter_{};
};

}  // namespace maille::volmesh

template <class H>
inline constexpr bool std::ranges::enable_borrowed_range<maille::volmesh::EntityRange<H>> = true;
