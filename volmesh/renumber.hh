#pragma once

#include <cstdint>
#include <vector>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// How far along Hilbert's curve through the unit cube a place is, the cube being cut into 2^21 cells each
/// way. Coordinates outside 0 to 1 are taken for the nearest inside. (Skilling, Programming the Hilbert
/// curve, 2004.)
std::uint64_t hilbert_index(const Point& place);

/// Renumbers cells and vertices in the order in which Hilbert's curve through the mesh's box comes to their
/// centroids and places, so that what is near in space is near in memory: walks over a mesh whose numbers are
/// at random become many times faster. Sets, properties and all else stay as they were; deleted entities are
/// dropped; edges and faces, if they are numbered, get new numbers. Returns where each old index went. Cost:
/// that of sorting, and of building the mesh once more.
IndexMaps renumber(TetMesh& mesh);

}  // namespace maille::volmesh
