#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "volmesh/tet_topology.hh"

namespace maille::volmesh::tet {

/// A tetrahedron cut into eight of equal volume at the middles of its edges ("regular" or "red" refinement;
/// Bey, Tetrahedral grid refinement, Computing 55, 1995): one at each corner, and four round a diagonal of
/// the octahedron that is left.
///
/// Its nodes are 0..3, the tetrahedron's vertices, and 4 + e, the middle of edge e. Child i < 4 is the one at
/// vertex i and has the middles of its edges to the others where these were, so its local numbers are the
/// parent's. All children are oriented as the parent.
struct Octasection {
    static constexpr std::uint8_t no_face = 4, no_edge = 6;

    std::array<std::array<std::uint8_t, 4>, 8> nodes{};  ///< by child and local vertex
    std::array<std::array<std::uint8_t, 4>, 8>
        outer{};  ///< by child and local face: the parent's face that it lies on, or `no_face`
    std::array<std::array<std::uint8_t, 4>, 8>
        inner{};  ///< where it lies on none: 4 * child + local face on its other side
    std::array<std::array<std::uint8_t, 6>, 8>
        halved{};  ///< by child and local edge: the parent's edge that it is a half of, or `no_edge`
    std::array<std::uint8_t, 4> middle{};  ///< by face of the parent: 4 * child + local face in its middle

    /// The cut whose diagonal joins the middles of the edges `diagonal` (0, 1 or 2) and 5 - `diagonal`.
    explicit constexpr Octasection(int diagonal) {
        for (std::uint8_t child = 0; child < 4; ++child)
            for (std::uint8_t i = 0; i < 4; ++i)
                nodes[child][i] = i == child ? child : static_cast<std::uint8_t>(4 + edge_between[child][i]);
        const auto p = static_cast<std::uint8_t>(4 + diagonal);
        const auto q = static_cast<std::uint8_t>(4 + opposite_edge(diagonal));
        const int one = diagonal == 0 ? 1 : 0;
        const int other = diagonal == 2 ? 1 : 2;
        const std::array round{4 + one, 4 + other, 4 + opposite_edge(one), 4 + opposite_edge(other)};
        for (int i = 0; i < 4; ++i) {
            auto& child = nodes[4 + i];
            child = {p, q, static_cast<std::uint8_t>(round[i]),
                     static_cast<std::uint8_t>(round[(i + 1) % 4])};
            if (six_volumes(child) < 0) std::swap(child[0], child[1]);
        }
        for (auto& edges : halved) edges.fill(no_edge);
        for (int child = 0; child < 4; ++child)
            for (int i = 0; i < 4; ++i)
                if (i != child) halved[child][edge_between[child][i]] = edge_between[child][i];
        find_sides();
    }

  private:
    using Nodes = std::uint16_t;  ///< a bit each

    constexpr Nodes face_nodes(int child, int face) const {
        Nodes all = 0;
        for (int i = 0; i < 4; ++i)
            if (i != face) all = static_cast<Nodes>(all | 1U << nodes[child][i]);
        return all;
    }

    static constexpr Nodes nodes_on(int parent_face) {
        Nodes all = 0;
        for (int i = 0; i < 4; ++i)
            if (i != parent_face) all = static_cast<Nodes>(all | 1U << i);
        for (int e : face_edges[parent_face]) all = static_cast<Nodes>(all | 1U << (4 + e));
        return all;
    }

    constexpr void find_sides() {
        for (int side = 0; side < 32; ++side) {
            const Nodes here = face_nodes(side / 4, side % 4);
            outer[side / 4][side % 4] = no_face;
            for (std::uint8_t face = 0; face < 4; ++face)
                if ((here & ~nodes_on(face)) == 0) {
                    outer[side / 4][side % 4] = face;
                    if (side >= 16) middle[face] = static_cast<std::uint8_t>(side);
                }
            for (int other = 0; other < 32; ++other)
                if (other != side && face_nodes(other / 4, other % 4) == here)
                    inner[side / 4][side % 4] = static_cast<std::uint8_t>(other);
        }
    }

    /// In the tetrahedron with edges of length 2 along the axes.
    static constexpr int six_volumes(const std::array<std::uint8_t, 4>& child) {
        std::array<std::array<int, 3>, 4> p{};
        for (int i = 0; i < 4; ++i)
            for (int axis = 0; axis < 3; ++axis) p[i][axis] = coordinate(child[i], axis);
        std::array<std::array<int, 3>, 3> u{};
        for (int i = 0; i < 3; ++i)
            for (int axis = 0; axis < 3; ++axis) u[i][axis] = p[i + 1][axis] - p[0][axis];
        return u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1]) -
               u[0][1] * (u[1][0] * u[2][2] - u[1][2] * u[2][0]) +
               u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0]);
    }
    static constexpr int coordinate(int node, int axis) {
        if (node < 4) return node == axis + 1 ? 2 : 0;
        const auto [a, b] = edge_vertices[node - 4];
        return (coordinate(a, axis) + coordinate(b, axis)) / 2;
    }
};

/// The three ways, by diagonal.
inline constexpr std::array octasections{Octasection(0), Octasection(1), Octasection(2)};

}  // namespace maille::volmesh::tet
