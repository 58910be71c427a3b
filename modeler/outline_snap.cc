#include "modeler/outline_snap.hh"

#include <algorithm>
#include <numeric>
#include <utility>

#include "modeler/point_grid.hh"

namespace maille::modeler {
namespace {

/// The corners of shapes, one where several are near each other.
class Corners {
  public:
    Corners(std::span<const Outline> shapes, double distance) : distance_(distance) {
        for (const Outline& shape : shapes)
            for (const PlaneRegion& region : shape)
                for (const PlaneLoop& loop : region)
                    for (const Point2& p : loop) points_.emplace_back(p.x(), p.y(), 0);
        PointGrid grid(distance);
        for (std::uint32_t i = 0; i < points_.size(); ++i) {
            const auto known = grid.find(points_[i]);
            first_.push_back(known.value_or(i));
            if (known) continue;
            grid.add(points_[i], i);
            by_x_.push_back(i);
        }
        std::ranges::stable_sort(by_x_, {}, [&](std::uint32_t i) { return points_[i].x(); });
    }

    /// That of the i-th point of the shapes.
    std::uint32_t of(std::size_t i) const { return first_[i]; }
    Point2 place(std::uint32_t corner) const { return points_[corner].head<2>(); }

    /// Those near the inside of an edge, from its beginning to its end.
    std::vector<std::uint32_t> along(std::uint32_t a, std::uint32_t b) const {
        const Point2 from = place(a), way = (place(b) - from).normalized();
        const double length = (place(b) - from).norm();
        const auto [low, high] = std::minmax({place(a).x(), place(b).x()});
        const auto x = [&](std::uint32_t i) { return points_[i].x(); };
        std::vector<std::pair<double, std::uint32_t>> found;
        for (auto i = std::ranges::lower_bound(by_x_, low - distance_, {}, x);
             i != by_x_.end() && x(*i) <= high + distance_; ++i) {
            const Point2 p = place(*i) - from;
            const double ahead = way.dot(p), aside = way.x() * p.y() - way.y() * p.x();
            if (*i != a && *i != b && ahead > 0 && ahead < length && std::abs(aside) <= distance_)
                found.emplace_back(ahead, *i);
        }
        std::ranges::sort(found);
        std::vector<std::uint32_t> corners;
        for (const auto& entry : found) corners.push_back(entry.second);
        return corners;
    }

  private:
    double distance_;
    std::vector<Eigen::Vector3d> points_;
    std::vector<std::uint32_t> first_, by_x_;
};

/// Takes out corners that repeat the one before, and ways that lead back along themselves at once.
void prune(std::vector<std::uint32_t>& loop) {
    std::vector<std::uint32_t> kept;
    for (const std::uint32_t corner : loop) {
        kept.push_back(corner);
        while (kept.size() > 1 && kept.back() == kept[kept.size() - 2]) kept.pop_back();
        if (kept.size() > 2 && kept.back() == kept[kept.size() - 3]) kept.resize(kept.size() - 2);
    }
    std::size_t first = 0;
    while (kept.size() > first + 1 && kept.back() == kept[first]) kept.pop_back();
    while (kept.size() > first + 2) {
        const std::size_t n = kept.size();
        if (kept[n - 2] == kept[first])
            kept.resize(n - 2);
        else if (kept[n - 1] == kept[first + 1])
            ++first, kept.pop_back();
        else
            break;
    }
    loop.assign(kept.begin() + static_cast<std::ptrdiff_t>(first), kept.end());
}

}  // namespace

std::vector<Outline> snapped(std::span<const Outline> shapes, double distance) {
    const Corners corners(shapes, distance);
    std::vector<Outline> result;
    std::size_t next = 0;
    for (const Outline& shape : shapes) {
        Outline& outline = result.emplace_back();
        for (const PlaneRegion& region : shape) {
            PlaneRegion kept;
            for (const PlaneLoop& loop : region) {
                std::vector<std::uint32_t> way;
                for (std::size_t k = 0; k < loop.size(); ++k) {
                    const std::uint32_t a = corners.of(next + k),
                                        b = corners.of(next + (k + 1) % loop.size());
                    way.push_back(a);
                    if (a != b) std::ranges::copy(corners.along(a, b), std::back_inserter(way));
                }
                next += loop.size();
                prune(way);
                if (way.size() < 3) continue;
                PlaneLoop& places = kept.emplace_back();
                for (const std::uint32_t corner : way) places.push_back(corners.place(corner));
            }
            if (!kept.empty()) outline.push_back(std::move(kept));
        }
    }
    return result;
}

}  // namespace maille::modeler
