#include "tools/html/blob.hh"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include <zlib.h>

namespace maille::html {
namespace {

std::string compressed(std::string_view bytes) {
    uLongf size = compressBound(bytes.size());
    std::string out(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                  bytes.size(), Z_DEFAULT_COMPRESSION) != Z_OK)
        throw std::bad_alloc();
    out.resize(size);
    return out;
}

std::string base64(std::string_view bytes) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (int shift = 18; shift >= 0; shift -= 6) text += digits[bits >> shift & 63U];
    }
    for (std::size_t k = bytes.size() % 3; k != 0 && k < 3; ++k) text[text.size() - 3 + k] = '=';
    return text;
}

}  // namespace

void Blob::append(const std::string& name, const std::vector<std::uint32_t>& numbers, const char* by,
                  std::size_t stride) {
    const std::uint32_t greatest = numbers.empty() ? 0 : *std::ranges::max_element(numbers);
    const int width = std::max(1, (static_cast<int>(std::bit_width(greatest)) + 7) / 8);
    contents_[name] = {{"count", numbers.size()}, {"width", width}, {"by", by}, {"stride", stride}};
    for (int k = 0; k < width; ++k)
        for (std::uint32_t number : numbers) bytes_ += static_cast<char>(number >> (8 * k) & 255U);
}

void Blob::add(const std::string& name, const std::vector<std::uint32_t>& numbers) {
    append(name, numbers, "value", 0);
}

void Blob::add_differences(const std::string& name, const std::vector<std::uint32_t>& numbers,
                           std::size_t stride) {
    std::vector<std::uint32_t> folded(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::uint32_t difference = numbers[i] - (i < stride ? 0 : numbers[i - stride]);
        folded[i] = difference >> 31 ? ~(difference << 1) : difference << 1;
    }
    append(name, folded, "difference", stride);
}

void Blob::add_by_first_use(const std::string& name, const std::vector<std::uint32_t>& numbers) {
    std::vector<std::uint32_t> below(numbers.size());
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        below[i] = next - numbers[i];
        if (below[i] == 0) ++next;
    }
    append(name, below, "first_use", 0);
}

std::string compressed_base64(std::string_view bytes) {
    return base64(compressed(bytes));
}

}  // namespace maille::html
