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

Place place(const Vec3& p) {
    return {p.x(), p.y(), p.z()};
}

Box to_box(const Eigen::AlignedBox3d& box) {
    return {place(box.min()), place(box.max())};
}

Eigen::AlignedBox3d box_of(const Corners& corners) {
    return Eigen::AlignedBox3d(corners[0]).extend(corners[1]).extend(corners[2]);
}

Value value(const TriangleTree::Entry& entry) {
    return {to_box(box_of(entry.corners)), entry.triangle};
}

std::vector<Value> values(std::span<const TriangleTree::Entry> entries) {
    std::vector<Value> all;
    all.reserve(entries.size());
    for (const TriangleTree::Entry& entry : entries) all.push_back(value(entry));
    return all;
}

}  // namespace

struct TriangleTree::Tree : geometry::index::rtree<Value, geometry::index::quadratic<most_children>> {
    using rtree::rtree;
};

TriangleTree::TriangleTree() : tree_(std::make_unique<Tree>()) {}
TriangleTree::TriangleTree(std::span<const Entry> entries) : tree_(std::make_unique<Tree>(values(entries))) {}
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;
TriangleTree::~TriangleTree() = default;

void TriangleTree::insert(const Entry& entry) {
    tree_->insert(value(entry));
}

void TriangleTree::erase(const Entry& entry) {
    tree_->remove(value(entry));
}

void TriangleTree::collect(const Corners& corners, std::vector<Index>& found) const {
    collect(box_of(corners), found);
}

void TriangleTree::collect(const Eigen::AlignedBox3d& box, std::vector<Index>& found) const {
    tree_->query(
        geometry::index::intersects(to_box(box)),
        boost::make_function_output_iterator([&](const Value& near) { found.push_back(near.second); }));
}

}  // namespace maille::modeler::remeshing
