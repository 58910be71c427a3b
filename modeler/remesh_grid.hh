#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <boost/container/small_vector.hpp>

namespace maille::modeler::remeshing {

using Index = std::uint32_t;
using Vec3 = Eigen::Vector3d;
using Corners = std::array<Vec3, 3>;

/// Finds the triangles near a place: a hashed grid of cells that follows every change. A triangle is in all
/// cells that it may touch, so that two triangles that meet share one. Until its first reset it stays empty.
/// For one thread.
class TriangleGrid {
  public:
    /// Empties the grid. `cell` is the width of a cell, about the length of an edge; `expected` the number of
    /// triangles to come.
    void reset(double cell, std::size_t expected);

    void insert(Index triangle, const Corners& corners);
    /// Takes out what was inserted with the same corners.
    void erase(Index triangle, const Corners& corners);

    /// Appends the triangles whose boxes meet the corners', or this one, each once.
    void collect(const Corners& corners, std::vector<Index>& found) const;
    void collect(const Eigen::AlignedBox3d& box, std::vector<Index>& found) const;

  private:
    using Buckets = boost::container::small_vector<std::size_t, 64>;
    using Cell = std::array<std::int64_t, 3>;

    Cell cell_of(const Vec3& p) const;
    std::size_t bucket_of(const Cell& cell) const;
    /// The buckets that the triangle falls into, some several times.
    void buckets_of(const Corners& corners, Buckets& buckets) const;
    void collect(const Buckets& buckets, const Eigen::AlignedBox3d& box, std::vector<Index>& found) const;

    double cell_ = 1;
    std::vector<std::vector<Index>> buckets_;
    std::vector<Eigen::AlignedBox3d> boxes_;  ///< by triangle
    mutable std::vector<std::uint64_t>
        collected_;  ///< by triangle: the number of the last call that found it
    mutable std::uint64_t calls_ = 0;
};

}  // namespace maille::modeler::remeshing
