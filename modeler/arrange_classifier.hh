#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "modeler/arrange.hh"

namespace maille::modeler {

/// The primitives that a point lies in, in rising order.
struct Containment {
    std::vector<std::uint32_t> inside;
    std::vector<std::uint32_t> boundary;  ///< those with the point exactly on their surface
};

/// Tells for many points which primitives they lie in. Exact for the points and triangles as given;
/// thread-safe.
class SolidClassifier {
  public:
    explicit SolidClassifier(std::span<const ClosedSurface> primitives);
    ~SolidClassifier();
    SolidClassifier(SolidClassifier&&) noexcept;
    SolidClassifier& operator=(SolidClassifier&&) noexcept;

    Containment locate(const Eigen::Vector3d& point) const;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace maille::modeler
