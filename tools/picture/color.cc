#include "tools/picture/color.hh"

#include <algorithm>
#include <array>
#include <cmath>

namespace maille::picture {
namespace {

constexpr std::array<std::uint32_t, 10> web_colors{0x4e79a7, 0xf28e2b, 0x59a14f, 0xe15759, 0x76b7b2,
                                                   0xedc948, 0xb07aa1, 0xff9da7, 0x9c755f, 0x8c8c94};

float to_linear(std::uint32_t byte) {
    const float x = static_cast<float>(byte & 0xff) / 255;
    return x <= 0.04045F ? x / 12.92F : std::pow((x + 0.055F) / 1.055F, 2.4F);
}

}  // namespace

Color from_web(std::uint32_t rrggbb) {
    return {to_linear(rrggbb >> 16), to_linear(rrggbb >> 8), to_linear(rrggbb)};
}

std::uint8_t to_byte(float linear) {
    const float x = std::clamp(linear, 0.0F, 1.0F);
    const float encoded = x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1 / 2.4F) - 0.055F;
    return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

Color region_color(std::size_t i) {
    const Color base = mix(from_web(web_colors[i % web_colors.size()]), Color::Ones(), 0.12F);
    // Each time round, the colours come lighter and then darker than the first time.
    const std::size_t round = i / web_colors.size();
    if (round == 0) return base;
    const float part = 1 - 1 / (1 + 0.4F * static_cast<float>((round + 1) / 2));
    return mix(base, round % 2 == 1 ? Color::Ones() : Color::Zero(), part);
}

Color skin_color(const Color& region, std::size_t surface) {
    const Color own = from_web(web_colors[(3 * surface + 4) % web_colors.size()]);
    return mix(mix(region, Color::Ones(), 0.35F), own, 0.28F);
}

}  // namespace maille::picture
