#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Arrays of numbers as VTK's XML files hold them: text, base64 or raw bytes, in compressed blocks or in one
/// piece.
namespace maille::volmesh::io::vtk {

/// How a file holds its binary arrays.
struct Encoding {
    bool is_compressed = false;     ///< by zlib
    bool has_64_bit_heads = false;  ///< numbers in the heads of arrays: UInt64 or UInt32
};

/// The array in zlib-compressed blocks with their head of UInt64, as an appended array of raw bytes.
std::string compressed(std::span<const char> bytes);

/// The bytes of an array from its encoded form, which begins at the beginning of `text` and may end before
/// its end. Throws InputError, without naming the file, where it is damaged.
std::string decoded(std::string_view text, bool is_base64, const Encoding& encoding);

/// Numbers of a type by VTK's name ("Float64", "UInt8"...), or written as text where `is_text`.
struct Numbers {
    std::string type;
    bool is_text = false;
    std::string bytes;

    bool is_real() const { return type.starts_with("Float"); }
    /// Throws InputError where the type is unknown, a word is no number or a number does not fit.
    std::vector<double> as_reals() const;
    std::vector<std::int64_t> as_integers() const;
};

}  // namespace maille::volmesh::io::vtk
