#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace maille::volmesh {

/// The members of a mesh's sets as numbers, ascending: listed when one is first asked for, kept until they
/// may have changed. Several threads may ask. A copy begins without lists.
class MemberLists {
  public:
    using Lists = std::vector<std::optional<std::vector<std::uint32_t>>>;  ///< by set

    MemberLists() = default;
    MemberLists(const MemberLists&) noexcept {}
    MemberLists& operator=(const MemberLists&) noexcept {
        forget();
        return *this;
    }
    ~MemberLists() = default;

    /// Calls use(members) for a set. `list(lists)` is called before if they aren't known, and lists at least
    /// this set's. What splits add needs no word here: meshes only ever grow by them, and lists of a mesh of
    /// another size are forgotten.
    template <class List, class Use>
    auto with(std::uint32_t set, std::uint32_t n_vertices, const List& list, const Use& use) {
        const std::scoped_lock lock(mutex_);
        if (n_vertices_ != n_vertices) lists_.clear();
        n_vertices_ = n_vertices;
        if (lists_.size() <= set) lists_.resize(set + 1);
        if (!lists_[set]) list(lists_);
        return use(std::span<const std::uint32_t>(*lists_[set]));
    }

    /// Every other edit must tell, of all sets or of one.
    void forget() { lists_.clear(); }
    void forget(std::uint32_t set) {
        if (set < lists_.size()) lists_[set].reset();
    }

  private:
    std::mutex mutex_;
    Lists lists_;
    std::uint32_t n_vertices_ = 0;
};

}  // namespace maille::volmesh
