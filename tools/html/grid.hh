#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "volmesh/tet_mesh.hh"

namespace maille::html {

/// The points of a mesh as whole steps along its box: the page works with these, and so does what chooses its
/// cells, so that both agree to the last bit on which side of a plane a cell is.
struct Grid {
    static constexpr std::int32_t steps = (1 << 20) - 1;  ///< along the longest side

    using GridPoint = std::array<std::int32_t, 3>;

    volmesh::Point origin = volmesh::Point::Zero();
    double step = 1;
    std::vector<GridPoint> points;         ///< by vertex
    std::array<std::int32_t, 3> extent{};  ///< the greatest coordinates
};

Grid grid_of(const volmesh::TetMesh& mesh);

/// Four times the centroid.
Grid::GridPoint sum_of_points(const Grid& grid, const volmesh::TetMesh& mesh, volmesh::CellHandle c);

}  // namespace maille::html
