#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "volmesh/column.hh"

/// Arrays of numbers as VTK's XML files hold them: text, base64 or raw bytes, in compressed blocks or in one
/// piece.
namespace maille::volmesh::io::vtk {

/// How a file holds its binary arrays.
struct Encoding {
    bool is_compressed = false;     ///< by zlib
    bool has_64_bit_heads = false;  ///< numbers in the heads of arrays: UInt64 or UInt32
};

using Bytes = Column<char>;

/// The array as an appended one of raw bytes: a head of UInt64 and zlib-compressed blocks, to be written one
/// after another.
std::vector<std::string> compressed(std::span<const char> bytes);

/// The bytes of an array from its encoded form, which begins at the beginning of `text` and may end before
/// its end. Throws InputError, without naming the file, where it is damaged.
Bytes decoded(std::string_view text, bool is_base64, const Encoding& encoding);

/// Numbers of a type by VTK's name ("Float64", "UInt8"...): in bytes, or written as text where `is_text`.
struct Numbers {
    std::string type;
    bool is_text = false;
    std::string_view text{};
    Bytes bytes{};

    bool is_real() const { return type.starts_with("Float"); }
    /// Throws InputError where the type is unknown, a word is no number or a number does not fit.
    std::vector<double> as_reals() const;
    std::vector<std::int64_t> as_integers() const;
    /// Those that fit; others are the greatest.
    std::vector<std::uint32_t> as_indices() const;
    /// 1 for each number that isn't 0.
    std::vector<std::uint8_t> as_flags() const;
};

}  // namespace maille::volmesh::io::vtk
