#pragma once

#include <array>
#include <cstdint>

/// Local numbering in a tetrahedron: vertices 0..3, face f opposite vertex f, edges 01 02 03 12 13 23.
namespace maille::volmesh::tet {

/// The ends of each local edge.
inline constexpr std::array<std::array<std::uint8_t, 2>, 6> edge_vertices{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// The vertices of each local face; they turn counter-clockwise seen from outside a positively oriented cell.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> face_vertices{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// The local edge between two different local vertices.
inline constexpr std::array<std::array<std::uint8_t, 4>, 4> edge_between{
    {{6, 0, 1, 2}, {0, 6, 3, 4}, {1, 3, 6, 5}, {2, 4, 5, 6}}};

/// The edges of each local face.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> face_edges{
    {{3, 4, 5}, {1, 2, 5}, {0, 2, 4}, {0, 1, 3}}};

/// The edge that shares no vertex with the given one.
constexpr int opposite_edge(int edge) {
    return 5 - edge;
}

}  // namespace maille::volmesh::tet
