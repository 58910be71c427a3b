#pragma once

#include <array>
#include <charconv>
#include <concepts>
#include <ostream>
#include <sstream>
#include <string>
#include <type_traits>

namespace maille::volmesh {

/// A value in words: numbers in the fewest digits that read back as the same, `(1, 2, 3)` for what has
/// several parts, whatever the type's `<<` prints, or `?` where it has none.
template <class T>
std::string text_of(const T& value) {
    if constexpr (std::is_same_v<T, bool>) {
        return value ? "true" : "false";
    } else if constexpr (std::is_arithmetic_v<T>) {
        std::array<char, 64> buffer;
        return {buffer.data(), std::to_chars(buffer.begin(), buffer.end(), value).ptr};
    } else if constexpr (std::convertible_to<const T&, std::string>) {
        return value;
    } else if constexpr (requires { value.begin() != value.end(); }) {
        std::string text = "(";
        for (const auto& part : value) text += (text.size() > 1 ? ", " : "") + text_of(part);
        return text + ")";
    } else if constexpr (requires(std::ostream & out) { out << value; }) {
        std::ostringstream out;
        out << value;
        return out.str();
    } else {
        return "?";
    }
}

}  // namespace maille::volmesh
