#pragma once

#include <vector>

#include "volmesh/named_sets.hh"

namespace maille::volmesh::io {

/// Numbers 1, 2, ... for combinations of sets by their first appearance, so that they depend on the mesh
/// alone and not on how it came about. The same combination has numbers of its own among vertices, edges,
/// faces and cells.
class CombinationNumbers {
  public:
    int number(CombinationId id) {
        if (id >= numbers_.size()) numbers_.resize(id + 1, 0);
        if (numbers_[id] == 0) {
            ids_.push_back(id);
            numbers_[id] = static_cast<int>(ids_.size());
        }
        return numbers_[id];
    }

    /// The combinations, that of number 1 first.
    const std::vector<CombinationId>& ids() const { return ids_; }

  private:
    std::vector<int> numbers_;  ///< 0: none yet
    std::vector<CombinationId> ids_;
};

}  // namespace maille::volmesh::io
