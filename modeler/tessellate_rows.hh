#pragma once

#include <array>

#include "modeler/tessellate_seed.hh"

namespace maille::modeler {

inline bool is_mirror(const Eigen::Affine3d& map) {
    return map.linear().determinant() < 0;
}

/// A row of points around an axis. All round: `count` points, the first `offset` half steps on. From a start
/// to an end: `count` + 1 points, at least 3. A count of 1 is a single point on the axis.
struct Row {
    std::uint32_t first = 0;
    int count = 0;
    int offset = 0;
    bool closed = true;

    int edges() const { return count > 1 ? count : 0; }
    double share(int k) const { return (2 * k + offset) / (2.0 * count); }
    std::uint32_t at(int k) const { return first + static_cast<std::uint32_t>(closed ? k % count : k); }
};

/// The band between two rows: always the shorter of the two possible next edges.
void stitch(SurfaceSeed& seed, const Row& lower, const Row& upper, std::uint32_t surface, bool mirrored);

/// Points and offset of the row k of n, of which the first and the last are rims of so many edges. Where other
/// surfaces touch at a rim, the rows next to it are alike on all: else facets would cross there. A rim of one
/// point is none.
struct RowPoints {
    int count, offset;
};
RowPoints row_between(int first_rim, int last_rim, std::size_t k, std::size_t n, int wanted);

/// How points are spread around the axis: evenly on a circle, or on what is nearly one, by the wanted sizes
/// on an ellipse.
class Circumference {
  public:
    /// Of the image of the circle of that radius about the z axis.
    Circumference(const Eigen::Affine3d& map, const Sizing& sizing, double radius);

    double length() const { return length_.back(); }
    /// Number of edges that the sizes ask for.
    double edges() const { return steps_.back(); }

    /// Direction of the point k of n, in the reference plane.
    Eigen::Vector2d direction(int k, int n) const;

  private:
    static constexpr int samples = 720;
    Point x_, y_;
    bool is_circle_;
    std::array<double, samples + 1> length_{}, steps_{};
};

/// Number of edges of a sharp curve: a multiple of four, for symmetry's sake; more of them around a thin
/// disc, whose height is `slant`.
int rim_count(const Circumference& rim, double slant);

}  // namespace maille::modeler
