#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace maille::modeler {

/// Numbered points, to be found by places no further away than a distance. Its cells are a few times as wide,
/// so that a place rarely has to look into more than its own.
class PointGrid {
  public:
    explicit PointGrid(double distance) : distance_(distance), cell_(16 * distance) {}

    void add(const Eigen::Vector3d& p, std::uint32_t number) {
        cells_[hash(cell_of(p.array()))].emplace_back(number, p);
    }

    /// The point of lowest number near the place, if there is one: of each cell the first that was added
    /// counts.
    std::optional<std::uint32_t> find(const Eigen::Vector3d& place) const {
        std::optional<std::uint32_t> found;
        const Cell low = cell_of(place.array() - distance_), high = cell_of(place.array() + distance_);
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
            for (std::int64_t y = low[1]; y <= high[1]; ++y)
                for (std::int64_t z = low[2]; z <= high[2]; ++z)
                    if (const auto here = find_in({x, y, z}, place))
                        found = std::min(found.value_or(*here), *here);
        return found;
    }

  private:
    using Cell = std::array<std::int64_t, 3>;

    Cell cell_of(const Eigen::Array3d& p) const {
        const Eigen::Array3d c = (p / cell_).floor();
        return {static_cast<std::int64_t>(c[0]), static_cast<std::int64_t>(c[1]),
                static_cast<std::int64_t>(c[2])};
    }
    static std::uint64_t hash(const Cell& c) {
        std::uint64_t h = 0;
        for (const auto x : c) h = (h ^ static_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15U, h ^= h >> 29;
        return h;
    }
    std::optional<std::uint32_t> find_in(const Cell& c, const Eigen::Vector3d& place) const {
        const auto at = cells_.find(hash(c));
        if (at == cells_.end()) return std::nullopt;
        const auto near = std::ranges::find_if(
            at->second, [&](const auto& point) { return (point.second - place).norm() <= distance_; });
        return near == at->second.end() ? std::nullopt : std::optional(near->first);
    }

    double distance_;
    double cell_;
    std::unordered_map<std::uint64_t, std::vector<std::pair<std::uint32_t, Eigen::Vector3d>>> cells_;
};

}  // namespace maille::modeler
