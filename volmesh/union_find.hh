#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace maille::volmesh {

/// Disjoint sets of numbers. The smallest member stands for its set.
class UnionFind {
  public:
    explicit UnionFind(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0U); }

    /// One more number, in a set of its own.
    std::uint32_t add() {
        parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
        return parent_.back();
    }
    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void unite(std::uint32_t a, std::uint32_t b) {
        const auto [low, high] = std::minmax({find(a), find(b)});
        parent_[high] = low;
    }

  private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace maille::volmesh
