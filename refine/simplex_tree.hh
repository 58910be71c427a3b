#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Core>

namespace maille::refine {

using Point = Eigen::Vector3d;

/// A point, a segment, a triangle or a tetrahedron: its first `n_corners` corners.
struct Simplex {
    std::array<Point, 4> corners;
    int n_corners = 0;
};

/// The point of a simplex nearest to another point: its barycentric coordinates (those of the corners), 0 for
/// the corners that the simplex doesn't have, and how far it is.
struct NearestOnSimplex {
    Eigen::Vector4d weights = Eigen::Vector4d::Zero();
    double squared_distance = std::numeric_limits<double>::infinity();

    Point of(const Simplex& simplex) const;
};

/// Exact but for rounding. Tetrahedra are solid: inside, the distance is 0; a flat one is its faces.
NearestOnSimplex nearest_on(const Simplex& simplex, const Point& p);

/// Simplices in a hierarchy of boxes, to find the nearest to a point. A cheap value: copies share the
/// tree. Thread-safe.
class SimplexTree {
  public:
    struct Nearest : NearestOnSimplex {
        std::uint32_t simplex = 0;
    };

    explicit SimplexTree(std::vector<Simplex> simplices);

    /// The nearest simplex; precondition: there is one. Of several equally near it may be any, always the
    /// same. Where none is nearer than `limit`, the squared distance may be infinite. Cost: logarithmic, as a
    /// rule.
    Nearest nearest(const Point& p, double limit = std::numeric_limits<double>::infinity()) const;

    /// The least value of a simplex. `bound` tells what none at that distance from p, or farther, is below.
    double least(const Point& p, const std::function<double(double distance)>& bound,
                 const std::function<double(std::uint32_t simplex)>& value) const;

    const Simplex& operator[](std::uint32_t i) const;
    std::size_t size() const;

  private:
    struct Boxes;
    std::shared_ptr<const Boxes> boxes_;
};

}  // namespace maille::refine
