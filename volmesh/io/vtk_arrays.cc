#include "volmesh/io/vtk_arrays.hh"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include "volmesh/error.hh"
#include "volmesh/io/deflate.hh"

namespace maille::volmesh::io::vtk {

namespace {

constexpr std::size_t block_size = 1 << 18;

template <class T>
void append_raw(std::string& out, T value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// For each block the first of those before it that are equal to it one after another: few blocks of a mesh
/// that are equal at all are not neighbours, and most flags of a set are.
template <class AreEqual>
std::vector<std::size_t> first_of_equals(std::size_t n_blocks, const AreEqual& are_equal) {
    std::vector<std::size_t> first(n_blocks);
    for (std::size_t i = 0; i < n_blocks; ++i) first[i] = i > 0 && are_equal(i - 1, i) ? first[i - 1] : i;
    return first;
}

/// Takes bytes from the front of raw or base64 text. Base64 may be in several runs, each with its padding.
class ByteStream {
  public:
    ByteStream(std::string_view text, bool is_base64) : text_(text), is_base64_(is_base64) {}

    /// Valid until the next call.
    std::string_view take(std::size_t n) {
        if (n > n_left()) throw InputError("the data end too early");
        if (!is_base64_) {
            const std::string_view out = text_.substr(0, n);
            text_.remove_prefix(n);
            return out;
        }
        taken_.clear();
        taken_.reserve(n);
        while (taken_.size() < n) {
            if (pending_.empty()) decode_four();
            const std::size_t used = std::min(pending_.size(), n - taken_.size());
            taken_.append(pending_, 0, used);
            pending_.erase(0, used);
        }
        return taken_;
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
    std::string pending_, taken_;
};

std::uint64_t head_number(ByteStream& stream, const Encoding& encoding) {
    const std::string_view bytes = stream.take(encoding.has_64_bit_heads ? 8 : 4);
    std::uint64_t number = 0;
    std::memcpy(&number, bytes.data(), bytes.size());
    return number;
}

Bytes decompressed(ByteStream& stream, const Encoding& encoding) {
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
    if (size > best_deflation * begins.back())
        throw InputError("the sizes of the compressed blocks are impossible");
    const std::string_view data = stream.take(begins.back());
    Bytes out;
    out.grow(size);
    const auto packed = [&](std::size_t i) { return data.substr(begins[i], begins[i + 1] - begins[i]); };
    const auto unpacked = [&](std::size_t i) {
        const std::size_t begin = i * full_size;
        return std::span(out.data() + begin, std::min<std::size_t>(full_size, size - begin));
    };
    const auto first = first_of_equals(n_blocks, [&](std::size_t i, std::size_t j) {
        return unpacked(i).size() == unpacked(j).size() && packed(i) == packed(j);
    });
    tbb::parallel_for(std::size_t{0}, n_blocks, [&](std::size_t i) {
        if (first[i] == i) inflate_to(unpacked(i), packed(i));
    });
    tbb::parallel_for(std::size_t{0}, n_blocks, [&](std::size_t i) {
        if (first[i] != i) std::ranges::copy(unpacked(first[i]), unpacked(i).begin());
    });
    return out;
}

struct ToReal {
    using Value = double;
    static double convert(auto value) { return static_cast<double>(value); }
};
struct ToInteger {
    using Value = std::int64_t;
    static std::int64_t convert(auto value) {
        if constexpr (std::is_floating_point_v<decltype(value)>)
            if (!(value >= -0x1p63 && value < 0x1p63 && value == std::trunc(value)))
                throw InputError("a whole number should stand here");
        return static_cast<std::int64_t>(value);
    }
};
struct ToIndex {
    using Value = std::uint32_t;
    static std::uint32_t convert(auto value) {
        constexpr auto greatest = std::numeric_limits<std::uint32_t>::max();
        if constexpr (std::is_floating_point_v<decltype(value)>) {
            return convert(ToInteger::convert(value));
        } else {
            return std::in_range<std::uint32_t>(value) ? static_cast<std::uint32_t>(value) : greatest;
        }
    }
};
struct ToFlag {
    using Value = std::uint8_t;
    static std::uint8_t convert(auto value) { return value != 0 ? 1 : 0; }
};

template <class From, class To>
std::vector<typename To::Value> from_bytes(const Bytes& bytes) {
    const std::span values(reinterpret_cast<const From*>(bytes.data()), bytes.size() / sizeof(From));
    std::vector<typename To::Value> out(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) out[i] = To::convert(values[i]);
    return out;
}

template <class From, class To>
std::vector<typename To::Value> from_text(std::string_view text) {
    constexpr const char* blanks = " \t\r\n";
    std::vector<typename To::Value> values;
    for (std::size_t at = text.find_first_not_of(blanks); at != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
        From value{};
        const auto [last, error] = std::from_chars(text.data() + at, text.data() + end, value);
        if (error != std::errc{} || last != text.data() + end)
            throw InputError(
                fmt::format("'{}' is no such number", text.substr(at, std::min<std::size_t>(end - at, 40))));
        values.push_back(To::convert(value));
        at = text.find_first_not_of(blanks, end);
    }
    return values;
}

template <class To>
std::vector<typename To::Value> values_of(const Numbers& numbers) {
    using FromText = std::conditional_t<std::is_same_v<To, ToReal>, double, std::int64_t>;
    if (numbers.is_text) return from_text<FromText, To>(numbers.text);
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

std::vector<std::string> compressed(std::span<const char> bytes) {
    const std::size_t n_blocks = (bytes.size() + block_size - 1) / block_size;
    const auto block = [&](std::size_t i) {
        const std::size_t begin = i * block_size;
        return bytes.subspan(begin, std::min(block_size, bytes.size() - begin));
    };
    const auto first = first_of_equals(
        n_blocks, [&](std::size_t i, std::size_t j) { return std::ranges::equal(block(i), block(j)); });
    std::vector<std::string> parts(1 + n_blocks);
    tbb::parallel_for(std::size_t{0}, n_blocks, [&](std::size_t i) {
        if (first[i] == i) parts[1 + i] = deflated(block(i));
    });
    for (std::size_t i = 0; i < n_blocks; ++i)
        if (first[i] != i) parts[1 + i] = parts[1 + first[i]];
    std::string& head = parts.front();
    append_raw<std::uint64_t>(head, n_blocks);
    append_raw<std::uint64_t>(head, block_size);
    append_raw<std::uint64_t>(head, bytes.size() % block_size);
    for (std::size_t i = 0; i < n_blocks; ++i) append_raw<std::uint64_t>(head, parts[1 + i].size());
    return parts;
}

Bytes decoded(std::string_view text, bool is_base64, const Encoding& encoding) {
    ByteStream stream(text, is_base64);
    if (encoding.is_compressed) return decompressed(stream, encoding);
    Bytes bytes;
    bytes.assign(stream.take(head_number(stream, encoding)));
    return bytes;
}

std::vector<double> Numbers::as_reals() const {
    return values_of<ToReal>(*this);
}
std::vector<std::int64_t> Numbers::as_integers() const {
    return values_of<ToInteger>(*this);
}
std::vector<std::uint32_t> Numbers::as_indices() const {
    return values_of<ToIndex>(*this);
}
std::vector<std::uint8_t> Numbers::as_flags() const {
    return values_of<ToFlag>(*this);
}

}  // namespace maille::volmesh::io::vtk
