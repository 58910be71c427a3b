#pragma once

#include <span>
#include <utility>
#include <vector>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// The members of every set of a mesh, gathered in one pass over it: for whoever asks for many sets, or for
/// one again and again. From then on a set costs what its members do. A copy of what the sets were like.
class SetMembers {
  public:
    explicit SetMembers(const TetMesh& mesh);

    /// In the order of TetMesh's own lists of members, ascending; nothing for sets of other kinds.
    std::span<const VertexHandle> vertices(SetHandle s) const { return of_set_[s.idx()].vertices; }
    std::span<const CellHandle> cells(SetHandle s) const { return of_set_[s.idx()].cells; }
    /// One half-face each, that with the lower index.
    std::span<const HalffaceHandle> faces(SetHandle s) const { return of_set_[s.idx()].faces; }
    /// By the lowest cell and its local number.
    std::span<const std::pair<CellHandle, int>> edges(SetHandle s) const { return of_set_[s.idx()].edges; }
    std::size_t size(SetHandle s) const;

  private:
    struct Members {
        std::vector<VertexHandle> vertices;
        std::vector<std::pair<CellHandle, int>> edges;
        std::vector<HalffaceHandle> faces;
        std::vector<CellHandle> cells;
    };
    std::vector<Members> of_set_;
};

}  // namespace maille::volmesh
