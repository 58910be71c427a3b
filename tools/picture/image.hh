#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/picture/color.hh"

namespace maille::picture {

/// Linear colours, row by row from the top.
struct Image {
    Image(int w, int h) : width(w), height(h), pixels(static_cast<std::size_t>(w) * h, Color::Ones()) {}
    Color& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }

    int width, height;
    std::vector<Color> pixels;
};

/// Writes an 8-bit sRGB file beside its place and renames it. Throws InputError where it can't.
void write_png(const Image& image, const std::filesystem::path& path);

}  // namespace maille::picture
