#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace maille::picture {

/// Linear red, green, blue, each 0 to 1.
using Color = Eigen::Array3f;

/// The colour 0xRRGGBB of the web.
Color from_web(std::uint32_t rrggbb);
/// A byte of an image for one linear component.
std::uint8_t to_byte(float linear);
inline Color mix(const Color& a, const Color& b, float part_of_b) {
    return a + part_of_b * (b - a);
}

/// Colours of cell sets: distinct and calm, with no end.
Color region_color(std::size_t i);
/// The tint of a boundary face: the colour of its cell, lighter, and a little its own.
Color skin_color(const Color& region, std::size_t surface);

}  // namespace maille::picture
