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
    using Index = std::uint32_t;
    static constexpr Index invalid_index = std::numeric_limits<Index>::max();

    constexpr Handle() = default;
    constexpr explicit Handle(Index idx) : idx_(idx) {}

    constexpr Index idx() const { return idx_; }
    constexpr bool is_valid() const { return idx_ != invalid_index; }
    constexpr void invalidate() { idx_ = invalid_index; }

    friend constexpr auto operator<=>(Handle, Handle) = default;

  private:
    Index idx_ = invalid_index;
};

using VertexHandle = Handle<struct VertexKind>;
using EdgeHandle = Handle<struct EdgeKind>;
/// 2 * edge + side; side 0 runs from the end with the lower vertex index.
using HalfedgeHandle = Handle<struct HalfedgeKind>;
using FaceHandle = Handle<struct FaceKind>;
/// 4 * cell + local face: the face of a cell opposite its local vertex, seen from within that cell.
using HalffaceHandle = Handle<struct HalffaceKind>;
using CellHandle = Handle<struct CellKind>;
/// A named set of one mesh.
using SetHandle = Handle<struct SetKind>;

}  // namespace maille::volmesh

template <class Kind>
struct std::hash<maille::volmesh::Handle<Kind>> {
    std::size_t operator()(maille::volmesh::Handle<Kind> h) const noexcept {
        return std::hash<std::uint32_t>{}(h.idx());
    }
};
