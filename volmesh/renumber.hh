#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Geometry>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// How far along Hilbert's curve through the unit cube a place is, the cube being cut into 2^21 cells each
/// way. Coordinates outside 0 to 1 are taken for the nearest inside. (Skilling, Programming the Hilbert
/// curve, 2004.)
std::uint64_t hilbert_index(const Point& place);

/// The numbers 0 to n - 1 in the order in which Hilbert's curve through the cube about the box comes to their
/// places, those at one place in ascending order. Cost: that of sorting.
std::vector<TetMesh::Index> order_along_curve(std::size_t n, const Eigen::AlignedBox3d& box,
                                              const std::function<Point(TetMesh::Index)>& place_of);

/// Renumbers cells and vertices in the order in which Hilbert's curve through the mesh's box comes to their
/// centroids and places, so that what is near in space is near in memory: walks over a mesh whose numbers are
/// at random become many times faster. Sets, properties and all else stay as they were; deleted entities are
/// dropped; edges and faces, if they are numbered, get new numbers. Returns where each old index went. Cost:
/// that of sorting, and of building the mesh once more.
IndexMaps renumber(TetMesh& mesh);

}  // namespace maille::volmesh
