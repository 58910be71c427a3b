#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "volmesh/tet_mesh.hh"

namespace maille::test {

/// The unit cube as n^3 bricks of six Kuhn tets each: one for each order in which x, y and z are walked from
/// the brick's lowest corner to its highest. Vertices are numbered x fastest.
inline volmesh::TetMesh kuhn_cube(int n) {
    using Index = volmesh::TetMesh::Index;
    std::vector<volmesh::Point> points;
    for (int z = 0; z <= n; ++z)
        for (int y = 0; y <= n; ++y)
            for (int x = 0; x <= n; ++x) points.push_back(volmesh::Point(x, y, z) / n);
    const std::array<int, 3> stride{1, n + 1, (n + 1) * (n + 1)};
    std::vector<std::array<Index, 4>> cells;
    for (int z = 0; z < n; ++z)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                std::array<int, 3> axes{0, 1, 2};
                do {
                    std::array<Index, 4> cell;
                    int at = x * stride[0] + y * stride[1] + z * stride[2];
                    cell[0] = static_cast<Index>(at);
                    for (int i = 0; i < 3; ++i) cell[i + 1] = static_cast<Index>(at += stride[axes[i]]);
                    const bool is_even = axes[1] == (axes[0] + 1) % 3;
                    if (!is_even) std::swap(cell[2], cell[3]);
                    cells.push_back(cell);
                } while (std::ranges::next_permutation(axes).found);
            }
    return volmesh::TetMesh::from_cells(std::move(points), std::move(cells));
}

}  // namespace maille::test
