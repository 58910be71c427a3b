#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include <Eigen/Core>

namespace maille::modeler {

/// Numbers of points, to be found by their exact coordinates.
class PointIndex {
  public:
    void reserve(std::size_t n) { numbers_.reserve(n); }

    /// The number that the place had already, or else the one given.
    std::uint32_t insert(const Eigen::Vector3d& p, std::uint32_t number) {
        return numbers_.emplace(key(p), number).first->second;
    }
    std::optional<std::uint32_t> find(const Eigen::Vector3d& p) const {
        const auto found = numbers_.find(key(p));
        return found == numbers_.end() ? std::nullopt : std::optional(found->second);
    }

  private:
    using Key = std::array<double, 3>;
    struct Hash {
        std::size_t operator()(const Key& k) const {
            std::uint64_t hash = 0;
            for (double x : k)
                hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15ULL, hash ^= hash >> 29;
            return hash;
        }
    };
    // Adding 0 makes -0 and 0 one.
    static Key key(const Eigen::Vector3d& p) { return {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0}; }

    std::unordered_map<Key, std::uint32_t, Hash> numbers_;
};

}  // namespace maille::modeler
