#include "volmesh/io/vtk_arrays.hh"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <numeric>

#include <fmt/core.h>
#include <tbb/parallel_for.h>
#include <zlib.h>

#include "volmesh/error.hh"

namespace maille::volmesh::io::vtk {

namespace {

constexpr std::size_t block_size = 1 << 18;

template <class T>
void append_raw(std::string& out, T value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string deflated(std::span<const char> bytes) {
    uLongf size = compressBound(bytes.size());
    std::string out(size, '\0');
    // Cannot fail: there is room enough.
    compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
              bytes.size(), Z_BEST_SPEED);
    out.resize(size);
    return out;
}

void inflate_to(std::span<char> to, std::string_view block) {
    uLongf size = to.size();
    const int status = uncompress(reinterpret_cast<Bytef*>(to.data()), &size,
                                  reinterpret_cast<const Bytef*>(block.data()), block.size());
    if (status != Z_OK || size != to.size()) throw InputError("a compressed block is damaged");
}

/// Takes bytes from the front of raw or base64 text. Base64 may be in several runs, each with its padding.
class ByteStream {
  public:
    ByteStream(std::string_view text, bool is_base64) : text_(text), is_base64_(is_base64) {}

    std::string take(std::size_t n) {
        if (n > n_left()) throw InputError("the data end too early");
        std::string out;
        if (is_base64_) {
            out.reserve(n);
            while (out.size() < n) {
                if (pending_.empty()) decode_four();
                const std::size_t used = std::min(pending_.size(), n - out.size());
                out.append(pending_, 0, used);
                pending_.erase(0, used);
            }
        } else {
            out = text_.substr(0, n);
            text_.remove_prefix(n);
        }
        return out;
    }

    /// At most that many.
    std::size_t n_left() const { return is_base64_ ? pending_.size() + text_.size() / 4 * 3 : text_.size(); }

  private:
    static int digit(char c) {
        if ('A' <= c && c <= 'Z') return c - 'A';
        if ('a' <= c && c <= 'z') return c - 'a' + 26;
        if ('0' <= c && c <= '9') return c - '0' + 52;
        if (c == '+') return 62;
        if (c == '/') return 63;
        throw InputError("the base64 data are damaged");
    }

    void decode_four() {
        while (!text_.empty() && (text_.front() == ' ' || text_.front() == '\n' || text_.front() == '\r'))
            text_.remove_prefix(1);
        if (text_.size() < 4) throw InputError("the data end too early");
        const std::string_view four = text_.substr(0, 4);
        text_.remove_prefix(4);
        const int n_padding = four[3] != '=' ? 0 : four[2] != '=' ? 1 : 2;
        unsigned bits = 0;
        for (int i = 0; i < 4; ++i)
            bits = bits << 6 | (i < 4 - n_padding ? static_cast<unsigned>(digit(four[i])) : 0U);
        for (int i = 0; i < 3 - n_padding; ++i) pending_ += static_cast<char>(bits >> (16 - 8 * i) & 0xFFU);
    }

    std::string_view text_;
    bool is_base64_;
    std::string pending_;
};

std::uint64_t head_number(ByteStream& stream, const Encoding& encoding) {
    const std::string bytes = stream.take(encoding.has_64_bit_heads ? 8 : 4);
    std::uint64_t number = 0;
    std::memcpy(&number, bytes.data(), bytes.size());
    return number;
}

std::string decompressed(ByteStream& stream, const Encoding& encoding) {
    const std::uint64_t n_blocks = head_number(stream, encoding);
    if (n_blocks == 0) return {};
    const std::uint64_t full_size = head_number(stream, encoding);
    const std::uint64_t last_size = head_number(stream, encoding);
    if (n_blocks > stream.n_left()) throw InputError("the data end too early");
    std::vector<std::size_t> begins(n_blocks + 1, 0);
    for (std::size_t i = 0; i < n_blocks; ++i) {
        begins[i + 1] = begins[i] + head_number(stream, encoding);
        if (begins[i + 1] > stream.n_left()) throw InputError("the data end too early");
    }
    if (full_size >> 32U != 0 || last_size > full_size)
        throw InputError("the sizes of the compressed blocks are impossible");
    const std::uint64_t size = (n_blocks - 1) * full_size + (last_size == 0 ? full_size : last_size);
    constexpr std::uint64_t best_ratio = 1032;  // of zlib
    if (size > best_ratio * begins.back())
        throw InputError("the sizes of the compressed blocks are impossible");
    const std::string data = stream.take(begins.back());
    std::string out(size, '\0');
    tbb::parallel_for(std::size_t{0}, n_blocks, [&](std::size_t i) {
        const std::size_t begin = i * full_size;
        const std::size_t size_here = std::min<std::size_t>(full_size, out.size() - begin);
        inflate_to({out.data() + begin, size_here},
                   std::string_view(data).substr(begins[i], begins[i + 1] - begins[i]));
    });
    return out;
}

template <class To, class From>
To converted(From value) {
    if constexpr (std::is_integral_v<To> && std::is_floating_point_v<From>) {
        if (!(value == static_cast<From>(static_cast<To>(value))))
            throw InputError("a whole number should stand here");
    }
    return static_cast<To>(value);
}

template <class From, class To>
std::vector<To> from_bytes(const std::string& bytes) {
    std::vector<To> values(bytes.size() / sizeof(From));
    for (std::size_t i = 0; i < values.size(); ++i) {
        From value;
        std::memcpy(&value, bytes.data() + i * sizeof(From), sizeof(From));
        values[i] = converted<To>(value);
    }
    return values;
}

template <class To>
std::vector<To> from_text(const std::string& text) {
    constexpr const char* blanks = " \t\r\n";
    std::vector<To> values;
    for (std::size_t at = text.find_first_not_of(blanks); at != std::string::npos;) {
        const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
        To value{};
        const auto [last, error] = std::from_chars(text.data() + at, text.data() + end, value);
        if (error != std::errc{} || last != text.data() + end)
            throw InputError(
                fmt::format("'{}' is no such number", text.substr(at, std::min<std::size_t>(end - at, 40))));
        values.push_back(value);
        at = text.find_first_not_of(blanks, end);
    }
    return values;
}

template <class To>
std::vector<To> values_of(const Numbers& numbers) {
    if (numbers.is_text) return from_text<To>(numbers.bytes);
    const std::string& type = numbers.type;
    if (type == "Float64") return from_bytes<double, To>(numbers.bytes);
    if (type == "Float32") return from_bytes<float, To>(numbers.bytes);
    if (type == "Int8") return from_bytes<std::int8_t, To>(numbers.bytes);
    if (type == "UInt8") return from_bytes<std::uint8_t, To>(numbers.bytes);
    if (type == "Int16") return from_bytes<std::int16_t, To>(numbers.bytes);
    if (type == "UInt16") return from_bytes<std::uint16_t, To>(numbers.bytes);
    if (type == "Int32") return from_bytes<std::int32_t, To>(numbers.bytes);
    if (type == "UInt32") return from_bytes<std::uint32_t, To>(numbers.bytes);
    if (type == "Int64") return from_bytes<std::int64_t, To>(numbers.bytes);
    if (type == "UInt64") return from_bytes<std::uint64_t, To>(numbers.bytes);
    throw InputError(fmt::format("numbers of type '{}' cannot be read", type));
}

}  // namespace

std::string compressed(std::span<const char> bytes) {
    const std::size_t n_blocks = (bytes.size() + block_size - 1) / block_size;
    std::vector<std::string> blocks(n_blocks);
    tbb::parallel_for(std::size_t{0}, n_blocks, [&](std::size_t i) {
        const std::size_t begin = i * block_size;
        blocks[i] = deflated(bytes.subspan(begin, std::min(block_size, bytes.size() - begin)));
    });
    std::string out;
    append_raw<std::uint64_t>(out, n_blocks);
    append_raw<std::uint64_t>(out, block_size);
    append_raw<std::uint64_t>(out, bytes.size() % block_size);
    for (const std::string& block : blocks) append_raw<std::uint64_t>(out, block.size());
    for (const std::string& block : blocks) out += block;
    return out;
}

std::string decoded(std::string_view text, bool is_base64, const Encoding& encoding) {
    ByteStream stream(text, is_base64);
    return encoding.is_compressed ? decompressed(stream, encoding)
                                  : stream.take(head_number(stream, encoding));
}

std::vector<double> Numbers::as_reals() const {
    return values_of<double>(*this);
}
std::vector<std::int64_t> Numbers::as_integers() const {
    return values_of<std::int64_t>(*this);
}

}  // namespace maille::volmesh::io::vtk
