#include "modeler/extrude_ridge.hh"

#include <algorithm>
#include <array>
#include <cmath>

#include "modeler/close_values.hh"

namespace maille::modeler {

Ridge::Ridge(std::vector<Point>& points, std::uint32_t first, Eigen::Index axis) : first_(first) {
    std::vector<double*> values;
    double scale = 0;
    for (std::size_t c = first; c < points.size(); ++c) {
        values.push_back(&points[c][axis]);
        scale = std::max(scale, std::abs(points[c][axis]));
    }
    merge_close_values(values, 1e-14 * scale);
    for (std::size_t c = first; c < points.size(); ++c) {
        place_of_.push_back(points[c][axis]);
        places_.emplace_back(points[c][axis], static_cast<std::uint32_t>(c));
    }
    std::ranges::sort(places_);
    const auto rest = std::ranges::unique(places_, {}, &std::pair<double, std::uint32_t>::first);
    places_.erase(rest.begin(), rest.end());
}

void Ridge::add(std::uint32_t foot, std::uint32_t from, std::uint32_t to, const std::string& name) {
    const double start = place_of_[from - first_], end = place_of_[to - first_];
    Fan fan{.foot = foot, .corners = {}, .name = name};
    for (const auto& [place, corner] : places_)
        if (place >= std::min(start, end) && place <= std::max(start, end)) fan.corners.push_back(corner);
    if (start > end) std::ranges::reverse(fan.corners);
    for (std::size_t i = 0; i + 1 < fan.corners.size(); ++i)
        parts_.insert({foot, fan.corners[i], fan.corners[i + 1]});
    fans_.push_back(std::move(fan));
}

std::vector<PolyhedronFace> Ridge::faces() const {
    std::vector<PolyhedronFace> faces;
    for (const Fan& fan : fans_) {
        bool goes_on = false;
        for (std::size_t i = 0; i + 1 < fan.corners.size(); ++i) {
            const std::uint32_t from = fan.corners[i], to = fan.corners[i + 1];
            const bool is_folded = parts_.contains({fan.foot, to, from});
            if (!is_folded && !goes_on) faces.push_back({{{fan.foot, from}}, fan.name});
            if (!is_folded) faces.back().loops.front().push_back(to);
            goes_on = !is_folded;
        }
    }
    return faces;
}

}  // namespace maille::modeler
