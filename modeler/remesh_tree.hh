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

/// Finds the triangles near a place: a tree of boxes that follows every change, whatever the lengths of the
/// edges.
class TriangleTree {
  public:
    struct Entry {
        Index triangle;
        Corners corners;
    };

    TriangleTree();
    /// Packs the triangles, which makes better boxes than one after another does.
    explicit TriangleTree(std::span<const Entry> entries);
    TriangleTree(TriangleTree&&) noexcept;
    TriangleTree& operator=(TriangleTree&&) noexcept;
    ~TriangleTree();

    void insert(const Entry& entry);
    /// Takes out what was put in with the same corners.
    void erase(const Entry& entry);

    /// Appends the triangles whose boxes meet the corners', or this one.
    void collect(const Corners& corners, std::vector<Index>& found) const;
    void collect(const Eigen::AlignedBox3d& box, std::vector<Index>& found) const;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace maille::modeler::remeshing
