#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// The cells of each vertex, or of each edge, laid out one list after another: for whoever goes through them
/// again and again, many times faster than vc_range and ec_range, which walk. A copy of what the mesh was
/// like when the table was made.
template <class Entity>
class CellTable {
  public:
    /// The cells at an entity, ascending. Valid as long as the table.
    std::span<const CellHandle> operator[](Entity h) const {
        return {cells_.data() + begins_[h.idx()], cells_.data() + begins_[h.idx() + 1]};
    }

  private:
    template <class E, class Entities>
    friend CellTable<E> make_table(const TetMesh& mesh, std::size_t n, const Entities& entities_of);

    std::vector<std::uint32_t> begins_;
    std::vector<CellHandle> cells_;
};

/// Each list ascends. 17 bytes a cell or so.
CellTable<VertexHandle> vertex_cells(const TetMesh& mesh);
/// Each list ascends. Numbers the edges if they aren't; 29 bytes a cell or so.
CellTable<EdgeHandle> edge_cells(const TetMesh& mesh);

}  // namespace maille::volmesh
