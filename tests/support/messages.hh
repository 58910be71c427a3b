#pragma once

#include <string>

#include "volmesh/error.hh"

namespace maille::test {

/// What the InputError that the action throws says; nothing where it throws none.
inline std::string message(const auto& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

inline bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace maille::test
