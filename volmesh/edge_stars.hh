#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "volmesh/handles.hh"

namespace maille::volmesh {

/// Edges that are to be split at once, each with the cells round it: no two of them have a cell in common.
class EdgeStars {
  public:
    /// An edge by its ends, in any order.
    struct Edge {
        VertexHandle a;  ///< the end near which the old cells stay
        VertexHandle b;  ///< the end near which the new ones are
        /// Whether it is the same edge.
        friend bool operator==(const Edge& e, const Edge& f) {
            return (e.a == f.a && e.b == f.b) || (e.a == f.b && e.b == f.a);
        }
    };

    /// `ring`: all cells round the edge a-b, as TetMesh::cells_around gives them.
    void add(Edge edge, std::span<const CellHandle> ring) {
        edges_.push_back(edge);
        cells_.insert(cells_.end(), ring.begin(), ring.end());
        ends_.push_back(static_cast<std::uint32_t>(cells_.size()));
    }
    /// Forgets all edges, and keeps the memory.
    void clear() {
        edges_.clear();
        cells_.clear();
        ends_.clear();
    }

    std::size_t size() const { return edges_.size(); }  ///< number of edges
    bool empty() const { return edges_.empty(); }       ///< whether there are none
    /// In the order in which they were added.
    Edge edge(std::size_t i) const { return edges_[i]; }
    /// Number of cells round the edges before this one.
    std::uint32_t begin_of(std::size_t i) const { return i == 0 ? 0 : ends_[i - 1]; }
    /// The cells round an edge.
    std::span<const CellHandle> ring(std::size_t i) const {
        return {cells_.data() + begin_of(i), cells_.data() + ends_[i]};
    }
    /// Number of cells round all edges together.
    std::size_t n_cells() const { return cells_.size(); }

  private:
    std::vector<Edge> edges_;
    std::vector<CellHandle> cells_;
    std::vector<std::uint32_t> ends_;  ///< of each ring, in `cells_`
};

}  // namespace maille::volmesh
