#include "modeler/remesh_tree.hh"

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>

namespace maille::modeler::remeshing {
namespace {

namespace geometry = boost::geometry;
using Place = geometry::model::point<double, 3, geometry::cs::cartesian>;
using Box = geometry::model::box<Place>;
using Value = std::pair<Box, Index>;
constexpr std::size_t most_children = 16;
constexpr double margin_in_diagonals = 0.1;
constexpr double far_too_large = 3;  // diagonals

Place place(const Vec3& p) {
    return {p.x(), p.y(), p.z()};
}

Box to_box(const Eigen::AlignedBox3d& box) {
    return {place(box.min()), place(box.max())};
}

Eigen::AlignedBox3d grown(const Eigen::AlignedBox3d& box) {
    const Vec3 margin = Vec3::Constant(margin_in_diagonals * box.diagonal().norm());
    return {box.min() - margin, box.max() + margin};
}

}  // namespace

Eigen::AlignedBox3d box_of(const Corners& corners) {
    return Eigen::AlignedBox3d(corners[0]).extend(corners[1]).extend(corners[2]);
}

struct TriangleTree::Tree : geometry::index::rtree<Value, geometry::index::quadratic<most_children>> {
    using rtree::rtree;
};

TriangleTree::TriangleTree() = default;
TriangleTree::TriangleTree(std::span<const Entry> entries) {
    std::vector<Value> values;
    for (const auto& [triangle, corners] : entries) {
        make_room(triangle);
        boxes_[triangle] = box_of(corners);
        tree_boxes_[triangle] = grown(boxes_[triangle]);
        values.emplace_back(to_box(tree_boxes_[triangle]), triangle);
    }
    tree_ = std::make_unique<Tree>(values);
}
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;
TriangleTree::~TriangleTree() = default;

void TriangleTree::make_room(Index triangle) {
    if (triangle < boxes_.size()) return;
    boxes_.resize(2 * std::size_t{triangle} + 1);
    tree_boxes_.resize(boxes_.size());
}

void TriangleTree::insert(const Entry& entry) {
    if (!tree_) return;
    make_room(entry.triangle);
    Eigen::AlignedBox3d& box = boxes_[entry.triangle];
    Eigen::AlignedBox3d& tree_box = tree_boxes_[entry.triangle];
    box = box_of(entry.corners);
    if (tree_box.contains(box) && tree_box.diagonal().norm() <= far_too_large * box.diagonal().norm()) return;
    if (!tree_box.isEmpty()) tree_->remove({to_box(tree_box), entry.triangle});
    tree_box = grown(box);
    tree_->insert({to_box(tree_box), entry.triangle});
}

void TriangleTree::erase(Index triangle) {
    if (tree_) boxes_[triangle].setEmpty();
}

void TriangleTree::collect(const Corners& corners, std::vector<Index>& found) const {
    collect(box_of(corners), found);
}

void TriangleTree::collect(const Eigen::AlignedBox3d& box, std::vector<Index>& found) const {
    if (!tree_) return;
    tree_->query(geometry::index::intersects(to_box(box)),
                 boost::make_function_output_iterator([&](const Value& near) {
                     if (boxes_[near.second].intersects(box)) found.push_back(near.second);
                 }));
}

}  // namespace maille::modeler::remeshing
