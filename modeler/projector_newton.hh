#pragma once

#include <optional>
#include <span>

#include "modeler/primitive.hh"

namespace maille::modeler {

/// A face of a shape.
struct ShapeFace {
    const Shape* shape;
    std::uint32_t face;

    friend auto operator<=>(const ShapeFace&, const ShapeFace&) = default;
};

/// The point near p that lies on all the faces' unbounded surfaces, and of those the nearest; p itself if it
/// does. Nothing where they have no common point within `size` of p, or none that an iteration from p finds.
/// The result is within 1e-12 `size` of each surface. Surfaces may be redundant: parallel there, or more than
/// three.
std::optional<Point> nearest_common_point(std::span<const ShapeFace> faces, const Point& p, double size);

}  // namespace maille::modeler
