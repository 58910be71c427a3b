#include "modeler/arrange_box_tree.hh"

#include <algorithm>
#include <numeric>

namespace maille::modeler::detail {

BoxTree::BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes) : order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    if (boxes.empty()) return;
    nodes_.reserve(boxes.size());
    nodes_.emplace_back();
    build(0, 0, static_cast<std::uint32_t>(boxes.size()), boxes);
}

void BoxTree::build(std::uint32_t node, std::uint32_t first, std::uint32_t end,
                    const std::vector<Eigen::AlignedBox3d>& boxes) {
    constexpr std::uint32_t leaf_size = 4;
    Eigen::AlignedBox3d all;
    for (auto i = first; i < end; ++i) all.extend(boxes[order_[i]]);
    nodes_[node] = {all, first, end - first};
    if (end - first <= leaf_size) return;

    Eigen::Index axis = 0;
    all.sizes().maxCoeff(&axis);
    const auto middle = first + (end - first) / 2;
    const auto key = [&](std::uint32_t i) {
        return std::pair(boxes[i].min()[axis] + boxes[i].max()[axis], i);
    };
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t i, std::uint32_t j) { return key(i) < key(j); });
    const auto children = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    nodes_.emplace_back();
    nodes_[node].first = children;
    nodes_[node].count = 0;
    build(children, first, middle, boxes);
    build(children + 1, middle, end, boxes);
}

}  // namespace maille::modeler::detail
