#pragma once

// Included by tet_mesh.hh.

#include <iterator>
#include <ranges>

namespace maille::volmesh {

/// The entities of one kind, or those on the boundary, in ascending order; deleted ones are left out.
template <class H>
class EntityRange : public std::ranges::view_interface<EntityRange<H>> {
  public:
    /// Goes forward, over what is left out; gives smart handles.
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
    /// TetMesh::cells and its like make these; n is the number of indices in use.
    EntityRange(const TetMesh& mesh, typename H::Index n, Filter filter)
        : mesh_(&mesh), n_(n), filter_(filter) {}
    ///@{
    /// Valid until the mesh is moved or gets more entities.
    Iterator begin() const { return Iterator(*this, 0); }
    Iterator end() const { return Iterator(*this, n_); }
    ///@}

  private:
    const TetMesh* mesh_ = nullptr;
    typename H::Index n_ = 0;
    Filter filter_{};
};

}  // namespace maille::volmesh

/// @cond
template <class H>
inline constexpr bool std::ranges::enable_borrowed_range<maille::volmesh::EntityRange<H>> = true;
/// @endcond
