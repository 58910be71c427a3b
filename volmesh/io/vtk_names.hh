#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "volmesh/named_sets.hh"

/// VTK's words for things.
namespace maille::volmesh::io::vtk {

enum CellType : std::uint8_t { vertex = 1, line = 3, triangle = 5, tetra = 10 };

/// 0 for other types than those above.
constexpr int n_vertices(std::uint8_t type) {
    switch (type) {
        case vertex:
            return 1;
        case line:
            return 2;
        case triangle:
            return 3;
        case tetra:
            return 4;
        default:
            return 0;
    }
}

template <class T>
inline constexpr const char* type_name = nullptr;
template <>
inline constexpr const char* type_name<double> = "Float64";
template <>
inline constexpr const char* type_name<float> = "Float32";
template <>
inline constexpr const char* type_name<std::uint8_t> = "UInt8";
template <>
inline constexpr const char* type_name<std::int32_t> = "Int32";
template <>
inline constexpr const char* type_name<std::int64_t> = "Int64";

/// The words of our attribute `kinds`.
inline constexpr std::array kind_names{"vertex", "edge", "face", "cell"};
constexpr const char* kind_name(EntityKind kind) {
    return kind_names[static_cast<std::size_t>(kind)];
}

/// Our attribute that tells the rule of the set of that kind: "vertex_rule".
inline std::string rule_attribute(EntityKind kind) {
    return std::string(kind_name(kind)) + "_rule";
}

}  // namespace maille::volmesh::io::vtk
