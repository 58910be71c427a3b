#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include <Eigen/Core>
#include <embree3/rtcore.h>

#include "tools/picture/scene.hh"

namespace maille::picture {

/// The scene's triangles, ready for rays.
class Tracer {
  public:
    struct Hit {
        std::uint32_t triangle;
        float distance;
    };

    explicit Tracer(const Scene& scene);
    ~Tracer();
    Tracer(const Tracer&) = delete;
    Tracer& operator=(const Tracer&) = delete;

    /// The first triangle on the ray, at more than a hair's breadth and less than `reach`.
    std::optional<Hit> first(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                             float reach = std::numeric_limits<float>::infinity()) const;
    bool is_free(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;

  private:
    RTCDevice device_;
    RTCScene scene_;
};

}  // namespace maille::picture
