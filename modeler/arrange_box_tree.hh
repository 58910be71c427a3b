#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

namespace maille::modeler::detail {

/// A hierarchy of boxes, to find those near a segment or a box.
class BoxTree {
  public:
    explicit BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes);

    /// Calls f(i) for each box i that comes nearer than `margin` to the segment (and for some others) until f
    /// says false. Returns whether it never did.
    template <class F>
    bool visit(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double margin, const F& f) const {
        const Eigen::Array3d inverse = (to - from).array().inverse();
        return visit_where(
            [&](const Eigen::AlignedBox3d& box) { return is_near(box, from.array(), inverse, margin); }, f);
    }

    /// The same for the boxes that meet another.
    template <class F>
    bool visit_box(const Eigen::AlignedBox3d& box, const F& f) const {
        return visit_where([&](const Eigen::AlignedBox3d& other) { return other.intersects(box); }, f);
    }

    /// The box of all.
    Eigen::AlignedBox3d bounds() const { return nodes_.empty() ? Eigen::AlignedBox3d() : nodes_[0].box; }

  private:
    struct Node {
        Eigen::AlignedBox3d box;
        std::uint32_t first;  ///< of its boxes in the order; for an inner node, of its two children
        std::uint32_t count;  ///< of its boxes; 0 for an inner node
    };

    /// Goes down to the leaves whose boxes, and all those around them, meet what is looked for.
    template <class Meets, class F>
    bool visit_where(const Meets& meets, const F& f) const {
        if (nodes_.empty()) return true;
        std::vector<std::uint32_t> stack{0};
        while (!stack.empty()) {
            const Node& node = nodes_[stack.back()];
            stack.pop_back();
            if (!meets(node.box)) continue;
            if (node.count > 0) {
                for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
                    if (!f(order_[i])) return false;
            } else {
                stack.push_back(node.first + 1);
                stack.push_back(node.first);
            }
        }
        return true;
    }

    void build(std::uint32_t node, std::uint32_t first, std::uint32_t end,
               const std::vector<Eigen::AlignedBox3d>& boxes);

    static bool is_near(const Eigen::AlignedBox3d& box, const Eigen::Array3d& from,
                        const Eigen::Array3d& inverse, double margin) {
        const Eigen::Array3d low = (box.min().array() - margin - from) * inverse;
        const Eigen::Array3d high = (box.max().array() + margin - from) * inverse;
        const double enter = low.min(high).maxCoeff(), leave = low.max(high).minCoeff();
        return enter <= leave && leave >= 0 && enter <= 1;
    }

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;
};

}  // namespace maille::modeler::detail
