#include "tools/picture/image.hh"

#include <system_error>

#include <fmt/format.h>
#include <png.h>

#include "volmesh/error.hh"

namespace maille::picture {

void write_png(const Image& image, const std::filesystem::path& path) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * image.pixels.size());
    for (const Color& pixel : image.pixels)
        for (float component : pixel) bytes.push_back(to_byte(component));

    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = static_cast<png_uint_32>(image.width);
    header.height = static_cast<png_uint_32>(image.height);
    header.format = PNG_FORMAT_RGB;
    std::filesystem::path beside = path;
    beside += ".part";
    std::error_code error;
    if (!png_image_write_to_file(&header, beside.c_str(), 0, bytes.data(), 0, nullptr)) {
        std::filesystem::remove(beside, error);
        throw InputError(fmt::format("{}: can't be written: {}", path.string(), header.message));
    }
    std::filesystem::rename(beside, path, error);
    if (error) {
        std::error_code ignored;
        std::filesystem::remove(beside, ignored);
        throw InputError(fmt::format("{}: can't be written: {}", path.string(), error.message()));
    }
}

}  // namespace maille::picture
