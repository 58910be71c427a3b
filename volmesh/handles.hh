#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <limits>

namespace maille::volmesh {

/// A 32-bit index that knows what it points at. Handles of different kinds neither convert nor compare.
template <class Kind>
class Handle {
  public:
    using Index = std::uint32_t;  ///< what a handle holds
    /// That of a handle of nothing.
    static constexpr Index invalid_index = std::numeric_limits<Index>::max();

    constexpr Handle() = default;  ///< of nothing
    /// Of the entity with that index; nobody checks that there is one.
    constexpr explicit Handle(Index idx) : idx_(idx) {}

    /// The place of the entity in the mesh's arrays, from 0.
    constexpr Index idx() const { return idx_; }
    /// Whether it is a handle of something. The entity may still be deleted: ask the mesh.
    constexpr bool is_valid() const { return idx_ != invalid_index; }
    /// Makes it a handle of nothing.
    constexpr void invalidate() { idx_ = invalid_index; }

    /// By index; what is invalid comes last.
    friend constexpr auto operator<=>(Handle, Handle) = default;

  private:
    Index idx_ = invalid_index;
};

///@{
/// An entity of a mesh. Edges and faces have numbers only when they are asked for, see TetMesh.
using VertexHandle = Handle<struct VertexKind>;
using EdgeHandle = Handle<struct EdgeKind>;
using FaceHandle = Handle<struct FaceKind>;
using CellHandle = Handle<struct CellKind>;
///@}
/// 2 * edge + side; side 0 runs from the end with the lower vertex index.
using HalfedgeHandle = Handle<struct HalfedgeKind>;
/// 4 * cell + local face: the face of a cell opposite its local vertex, seen from within that cell.
using HalffaceHandle = Handle<struct HalffaceKind>;
/// A named set of one mesh.
using SetHandle = Handle<struct SetKind>;

}  // namespace maille::volmesh

template <class Kind>
struct std::hash<maille::volmesh::Handle<Kind>> {
    std::size_t operator()(maille::volmesh::Handle<Kind> h) const noexcept {
        return std::hash<std::uint32_t>{}(h.idx());
    }
};
