#include "tools/html/grid.hh"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace maille::html {

Grid grid_of(const volmesh::TetMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const volmesh::VertexHandle v : mesh.vertices()) box.extend(mesh.point(v));
    Grid grid;
    grid.points.resize(mesh.n_vertices());
    if (box.isEmpty()) return grid;
    grid.origin = box.min();
    if (box.sizes().maxCoeff() > 0) grid.step = box.sizes().maxCoeff() / Grid::steps;
    for (const volmesh::VertexHandle v : mesh.vertices())
        for (int k = 0; k < 3; ++k) {
            const double place = (mesh.point(v)[k] - grid.origin[k]) / grid.step;
            grid.points[v.idx()][k] = static_cast<std::int32_t>(std::lround(place));
            grid.extent[k] = std::max(grid.extent[k], grid.points[v.idx()][k]);
        }
    return grid;
}

Grid::GridPoint sum_of_points(const Grid& grid, const volmesh::TetMesh& mesh, volmesh::CellHandle c) {
    Grid::GridPoint sum{};
    for (const volmesh::VertexHandle v : mesh.cell_vertices(c))
        for (int k = 0; k < 3; ++k) sum[k] += grid.points[v.idx()][k];
    return sum;
}

}  // namespace maille::html
