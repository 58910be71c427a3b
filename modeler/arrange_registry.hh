#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <unordered_map>
#include <vector>

#include "modeler/arrange_kernel.hh"

namespace maille::modeler::detail {

/// More points than a registry may hold.
class RegistryFull : public std::length_error {
  public:
    RegistryFull() : std::length_error("too many points") {}
};

/// Numbers exact points: equal points get one number, whichever way they were computed. The points given at
/// the start keep their places.
class PointRegistry {
  public:
    /// `cell` is about the distance below which points are compared exactly; it is a matter of speed only.
    /// At most `most_new` are added to the points given.
    PointRegistry(std::vector<ExactPoint> points, double cell, std::size_t most_new);

    /// The number of the point; a new one if there is no equal point. Throws RegistryFull.
    std::uint32_t add(const ExactPoint& point);

    const ExactPoint& operator[](std::uint32_t i) const { return points_[i]; }
    std::uint32_t size() const { return static_cast<std::uint32_t>(points_.size()); }

  private:
    using Cell = std::array<std::int64_t, 3>;
    struct Hash {
        std::size_t operator()(const Cell& c) const;
    };

    /// Some place within `slack()` of the point.
    Eigen::Vector3d place(const ExactPoint& point) const { return approximate(point, slack()); }
    double slack() const { return 1e-3 * cell_; }
    Cell cell_of(const Eigen::Array3d& p) const;
    void insert(std::uint32_t i);

    double cell_;
    std::size_t most_;
    std::vector<ExactPoint> points_;
    std::unordered_map<Cell, std::vector<std::uint32_t>, Hash> cells_;
};

}  // namespace maille::modeler::detail
