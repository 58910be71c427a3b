#include "modeler/arrange_split_edges.hh"

#include "modeler/arrange_box_tree.hh"

namespace maille::modeler::detail {

using Eigen::Vector3d;

EdgeSplitter::EdgeSplitter(Arrangement& result, const Scene& fine, const std::vector<Chain>& chains,
                           double tolerance)
    : result_(result), fine_(fine), tolerance_(tolerance) {
    for (const Facet& f : result.complex.facets)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax(f.vertices[k], f.vertices[(k + 1) % 3]);
            edges_.emplace_back(a, b);
        }
    std::ranges::sort(edges_);
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    split(chains);
}

std::vector<std::uint32_t> EdgeSplitter::between(std::uint32_t a, std::uint32_t b) const {
    const auto found = cuts_.find(std::minmax(a, b));
    if (found == cuts_.end()) return {};
    std::vector<std::uint32_t> points = found->second;
    std::ranges::sort(points, {}, [&](std::uint32_t p) { return (at(p) - at(a)).squaredNorm(); });
    return points;
}

void EdgeSplitter::split(const std::vector<Chain>& chains) {
    std::vector<Eigen::AlignedBox3d> boxes;
    for (const auto& [a, b] : edges_) boxes.push_back(segment_box(at(a), at(b)));
    const BoxTree tree(boxes);
    for (const Chain& chain : chains) {
        std::vector<std::uint32_t> near;
        Eigen::AlignedBox3d reach = segment_box(fine(chain.points.front()), fine(chain.points.back()));
        reach = {reach.min().array() - tolerance_, reach.max().array() + tolerance_};
        tree.visit_box(reach, [&](std::uint32_t e) {
            if (is_along(edges_[e], chain)) near.push_back(e);
            return true;
        });
        std::ranges::sort(near);
        for (std::size_t i = 1; i + 1 < chain.points.size(); ++i) place(chain, i, near);
    }
}

bool EdgeSplitter::is_along(const Edge& edge, const Chain& chain) const {
    const Vector3d &a = fine(chain.points.front()), &b = fine(chain.points.back());
    return distance_to_segment(at(edge.first), a, b) <= tolerance_ &&
           distance_to_segment(at(edge.second), a, b) <= tolerance_;
}

void EdgeSplitter::place(const Chain& chain, std::size_t i, const std::vector<std::uint32_t>& near) {
    const Vector3d& p = fine(chain.points[i]);
    const double clearance = least_clearance * std::min((p - fine(chain.points[i - 1])).norm(),
                                                        (p - fine(chain.points[i + 1])).norm());
    for (const auto e : near) {
        const auto& [a, b] = edges_[e];
        if (distance_to_segment(p, at(a), at(b)) > tolerance_) continue;
        if ((p - at(a)).norm() < clearance || (p - at(b)).norm() < clearance) return;
        // Another primitive's chain may run along the same edge.
        auto& cuts = cuts_[{a, b}];
        for (const auto other : cuts)
            if ((p - at(other)).norm() < clearance) return;
        cuts.push_back(static_cast<std::uint32_t>(result_.complex.points.size()));
        result_.complex.points.push_back(p);
        return;
    }
}

}  // namespace maille::modeler::detail
