#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace maille::modeler::remeshing {

using Index = std::uint32_t;
using Vec3 = Eigen::Vector3d;
using Corners = std::array<Vec3, 3>;

/// The box around a triangle.
Eigen::AlignedBox3d box_of(const Corners& corners);

/// Finds the triangles near a place: a tree of boxes that follows every change, whatever the lengths of the
/// edges. Its boxes are somewhat larger than the triangles', so that most small moves leave it as it is.
class TriangleTree {
  public:
    struct Entry {
        Index triangle;
        Corners corners;
    };

    /// Stays empty, whatever is put in.
    TriangleTree();
    /// Packs the triangles, which makes better boxes than one after another does.
    explicit TriangleTree(std::span<const Entry> entries);
    TriangleTree(TriangleTree&&) noexcept;
    TriangleTree& operator=(TriangleTree&&) noexcept;
    ~TriangleTree();

    void insert(const Entry& entry);
    void erase(Index triangle);

    /// Appends the triangles whose boxes meet the corners', or this one.
    void collect(const Corners& corners, std::vector<Index>& found) const;
    void collect(const Eigen::AlignedBox3d& box, std::vector<Index>& found) const;

  private:
    struct Tree;
    void make_room(Index triangle);

    std::unique_ptr<Tree> tree_;
    std::vector<Eigen::AlignedBox3d> boxes_;       ///< by triangle; empty where there is none
    std::vector<Eigen::AlignedBox3d> tree_boxes_;  ///< by triangle: that in the tree, if any
};

}  // namespace maille::modeler::remeshing
