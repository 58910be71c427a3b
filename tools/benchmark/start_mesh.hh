#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "volmesh/tet_mesh.hh"

namespace maille::benchmark {

/// Points and cells, as TetMesh::from_cells takes them.
struct CellSoup {
    std::vector<volmesh::Point> points;
    std::vector<std::array<std::uint32_t, 4>> cells;
    volmesh::TetMesh mesh() const { return volmesh::TetMesh::from_cells(points, cells); }
};

/// The unit cube in n^3 bricks of six tetrahedra each along the brick's diagonal (Kuhn), x fastest.
CellSoup kuhn_cube(int n);
/// The same mesh with vertices and cells in random order.
CellSoup renumbered(const CellSoup& soup, unsigned seed);
/// `kuhn:20`, or a mesh file.
CellSoup start_mesh(const std::string& what);

}  // namespace maille::benchmark
