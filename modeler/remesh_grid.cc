#include "modeler/remesh_grid.hh"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace maille::modeler::remeshing {

namespace {

constexpr std::size_t buckets_a_triangle = 8;  // about the cells that one is in: few share a bucket
constexpr int small_span = 2;                  // cells a side that a piece of a triangle may cover

Eigen::AlignedBox3d box_of(const Corners& corners) {
    return Eigen::AlignedBox3d(corners[0]).extend(corners[1]).extend(corners[2]);
}

void sort_unique(auto& values) {
    std::ranges::sort(values);
    values.erase(std::ranges::unique(values).begin(), values.end());
}

}  // namespace

void TriangleGrid::reset(double cell, std::size_t expected) {
    cell_ = cell;
    buckets_.assign(std::bit_ceil(std::max<std::size_t>(64, buckets_a_triangle * expected)), {});
}

TriangleGrid::Cell TriangleGrid::cell_of(const Vec3& p) const {
    return {static_cast<std::int64_t>(std::floor(p.x() / cell_)),
            static_cast<std::int64_t>(std::floor(p.y() / cell_)),
            static_cast<std::int64_t>(std::floor(p.z() / cell_))};
}

std::size_t TriangleGrid::bucket_of(const Cell& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t c : cell) {
        hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15ULL;
        hash ^= hash >> 29U;
    }
    return hash & (buckets_.size() - 1);
}

void TriangleGrid::buckets_of(const Corners& corners, Buckets& buckets) const {
    // A long triangle crosses few of the cells of its box: halve it until each piece has a small box.
    boost::container::small_vector<Corners, 8> pieces{corners};
    while (!pieces.empty()) {
        const auto [a, b, c] = pieces.back();
        pieces.pop_back();
        const Cell low = cell_of(a.cwiseMin(b).cwiseMin(c));
        const Cell high = cell_of(a.cwiseMax(b).cwiseMax(c));
        bool small = true;
        for (std::size_t axis = 0; axis < 3; ++axis) small = small && high[axis] - low[axis] <= small_span;
        if (small) {
            for (std::int64_t x = low[0]; x <= high[0]; ++x)
                for (std::int64_t y = low[1]; y <= high[1]; ++y)
                    for (std::int64_t z = low[2]; z <= high[2]; ++z) buckets.push_back(bucket_of({x, y, z}));
            continue;
        }
        const double ab = (b - a).squaredNorm();
        const double bc = (c - b).squaredNorm();
        const double ca = (a - c).squaredNorm();
        const auto halve = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
            const Vec3 middle = (p + q) / 2;
            pieces.push_back({p, middle, r});
            pieces.push_back({middle, q, r});
        };
        if (ab >= bc && ab >= ca)
            halve(a, b, c);
        else if (bc >= ca)
            halve(b, c, a);
        else
            halve(c, a, b);
    }
}

void TriangleGrid::insert(Index triangle, const Corners& corners) {
    if (buckets_.empty()) return;
    Buckets buckets;
    buckets_of(corners, buckets);
    sort_unique(buckets);
    for (const std::size_t bucket : buckets) buckets_[bucket].push_back(triangle);
    if (triangle >= collected_.size()) {
        collected_.resize(2 * std::size_t{triangle} + 1, 0);
        boxes_.resize(collected_.size());
    }
    boxes_[triangle] = box_of(corners);
}

void TriangleGrid::erase(Index triangle, const Corners& corners) {
    if (buckets_.empty()) return;
    Buckets buckets;
    buckets_of(corners, buckets);
    sort_unique(buckets);
    for (const std::size_t bucket : buckets) {
        auto& content = buckets_[bucket];
        *std::ranges::find(content, triangle) = content.back();
        content.pop_back();
    }
}

void TriangleGrid::collect(const Buckets& buckets, const Eigen::AlignedBox3d& box,
                           std::vector<Index>& found) const {
    ++calls_;
    for (const std::size_t bucket : buckets)
        for (const Index triangle : buckets_[bucket])
            if (std::exchange(collected_[triangle], calls_) != calls_ && boxes_[triangle].intersects(box))
                found.push_back(triangle);
}

void TriangleGrid::collect(const Corners& corners, std::vector<Index>& found) const {
    if (buckets_.empty()) return;
    Buckets buckets;
    buckets_of(corners, buckets);
    collect(buckets, box_of(corners), found);
}

void TriangleGrid::collect(const Eigen::AlignedBox3d& box, std::vector<Index>& found) const {
    Buckets buckets;
    const Vec3 cells = box.sizes() / cell_;
    if ((cells.x() + 1) * (cells.y() + 1) * (cells.z() + 1) > static_cast<double>(buckets_.size())) {
        for (std::size_t bucket = 0; bucket < buckets_.size(); ++bucket) buckets.push_back(bucket);
    } else {
        const Cell low = cell_of(box.min());
        const Cell high = cell_of(box.max());
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
            for (std::int64_t y = low[1]; y <= high[1]; ++y)
                for (std::int64_t z = low[2]; z <= high[2]; ++z) buckets.push_back(bucket_of({x, y, z}));
    }
    collect(buckets, box, found);
}

}  // namespace maille::modeler::remeshing
