#pragma once

#include <array>
#include <memory>
#include <span>

#include "modeler/primitive.hh"

namespace maille::modeler {

/// Distance from a closed surface of triangles, negative inside; its sign is exact. Thread-safe.
class SignedDistance {
  public:
    SignedDistance(std::span<const Point> points, std::span<const std::array<std::uint32_t, 3>> triangles);
    ~SignedDistance();

    double operator()(const Point& p) const;

  private:
    struct Tree;
    std::unique_ptr<const Tree> tree_;
};

}  // namespace maille::modeler
