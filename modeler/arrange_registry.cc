#include "modeler/arrange_registry.hh"

#include <cmath>

namespace maille::modeler::detail {

PointRegistry::PointRegistry(std::vector<ExactPoint> points, double cell, std::size_t most_new)
    : cell_(cell), most_(points.size() + most_new), points_(std::move(points)) {
    cells_.reserve(2 * points_.size());
    for (std::uint32_t i = 0; i < points_.size(); ++i) insert(i);
}

std::uint32_t PointRegistry::add(const ExactPoint& point) {
    const Eigen::Array3d at_about = place(point);
    const Cell low = cell_of(at_about - 2 * slack()), high = cell_of(at_about + 2 * slack());
    for (auto x = low[0]; x <= high[0]; ++x)
        for (auto y = low[1]; y <= high[1]; ++y)
            for (auto z = low[2]; z <= high[2]; ++z) {
                const auto at = cells_.find({x, y, z});
                if (at == cells_.end()) continue;
                for (const auto i : at->second)
                    if (points_[i] == point) return i;
            }
    if (points_.size() >= most_) throw RegistryFull();
    points_.push_back(point);
    insert(size() - 1);
    return size() - 1;
}

void PointRegistry::insert(std::uint32_t i) {
    cells_[cell_of(place(points_[i]))].push_back(i);
}

PointRegistry::Cell PointRegistry::cell_of(const Eigen::Array3d& p) const {
    const Eigen::Array3d c = (p / cell_).floor();
    return {static_cast<std::int64_t>(c[0]), static_cast<std::int64_t>(c[1]),
            static_cast<std::int64_t>(c[2])};
}

std::size_t PointRegistry::Hash::operator()(const Cell& c) const {
    std::uint64_t h = 0;
    for (const auto x : c) h = (h ^ static_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15U, h ^= h >> 29;
    return h;
}

}  // namespace maille::modeler::detail
