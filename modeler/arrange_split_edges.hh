#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "modeler/arrange_coarsen.hh"
#include "modeler/arrange_scene.hh"

namespace maille::modeler::detail {

/// A point that is nearer to a line than this, as a part of the edges around it, stays out.
inline constexpr double least_clearance = 0.25;

template <class Point>
double distance_to_segment(const Point& p, const Point& a, const Point& b) {
    const Point d = b - a;
    const double length = d.squaredNorm();
    const double t = length > 0 ? std::clamp((p - a).dot(d) / length, 0.0, 1.0) : 0;
    return (p - a - t * d).norm();
}

inline Eigen::AlignedBox3d segment_box(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    Eigen::AlignedBox3d box(a);
    box.extend(b);
    return box;
}

/// The edges of an arrangement that are straight parts of chains, cut at the chains' points.
class EdgeSplitter {
  public:
    /// Adds the points to the arrangement. Those that would lie too near to the end of an edge stay out.
    EdgeSplitter(Arrangement& result, const Scene& fine, const std::vector<Chain>& chains, double tolerance);

    /// The points on the edge on the way from a to b.
    std::vector<std::uint32_t> between(std::uint32_t a, std::uint32_t b) const;
    bool is_cut(std::uint32_t a, std::uint32_t b) const { return cuts_.contains(std::minmax(a, b)); }

  private:
    using Edge = std::pair<std::uint32_t, std::uint32_t>;

    const Eigen::Vector3d& at(std::uint32_t v) const { return result_.complex.points[v]; }
    const Eigen::Vector3d& fine(std::uint32_t v) const { return fine_.complex.points[v]; }
    void split(const std::vector<Chain>& chains);
    bool is_along(const Edge& edge, const Chain& chain) const;
    void place(const Chain& chain, std::size_t i, const std::vector<std::uint32_t>& near);

    Arrangement& result_;
    const Scene& fine_;
    double tolerance_;
    std::vector<Edge> edges_;
    std::map<Edge, std::vector<std::uint32_t>> cuts_;
};

}  // namespace maille::modeler::detail
