#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace maille::volmesh::io {

/// Places of items by the numbers that a file gives them, which may have gaps and be in any order.
/// Numbers that follow each other, as they mostly do, cost nothing.
class NumberMap {
  public:
    void push_back(std::uint64_t number) {
        if (size_ == 0) first_ = number;
        if (sorted_.empty() && number == first_ + size_) {
            ++size_;
            return;
        }
        list_all();
        sorted_.emplace_back(number, size_++);
    }

    /// Items have moved: the one at i is at place[i] now; several may have come together.
    void redirect(const std::vector<std::uint32_t>& place) {
        list_all();
        for (auto& [number, i] : sorted_) i = place[i];
    }

    /// To be called after the last push_back: a number that is there twice, if there is one.
    std::optional<std::uint64_t> sort() {
        std::ranges::sort(sorted_);
        const auto same = std::ranges::adjacent_find(sorted_, {}, &Entry::first);
        return same == sorted_.end() ? std::nullopt : std::optional(same->first);
    }

    std::optional<std::uint32_t> find(std::uint64_t number) const {
        if (sorted_.empty())
            return number - first_ < size_ ? std::optional(static_cast<std::uint32_t>(number - first_))
                                           : std::nullopt;
        const auto at = std::ranges::lower_bound(sorted_, number, {}, &Entry::first);
        return at != sorted_.end() && at->first == number ? std::optional(at->second) : std::nullopt;
    }

    std::uint32_t size() const { return size_; }

  private:
    using Entry = std::pair<std::uint64_t, std::uint32_t>;

    void list_all() {
        if (!sorted_.empty()) return;
        for (std::uint32_t i = 0; i < size_; ++i) sorted_.emplace_back(first_ + i, i);
    }

    std::uint64_t first_ = 0;
    std::uint32_t size_ = 0;
    std::vector<Entry> sorted_;  ///< empty while the numbers follow each other
};

}  // namespace maille::volmesh::io
