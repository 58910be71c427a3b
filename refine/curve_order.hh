#pragma once

#include <vector>

#include "volmesh/tet_mesh.hh"

namespace maille::refine {

using volmesh::CellHandle;
using volmesh::TetMesh;

/// Sorts cells along a space-filling curve through the bounding box that a mesh has when this is made, by the
/// first vertex of each; those of one place stay as they are. Cells that are near to each other are then
/// taken one after another, and what is made of them lies near to them in memory.
///
/// The curve is Morton's ("A computer oriented geodetic data base", 1966): the bits of the coordinates,
/// interleaved. Cost: linear.
class CurveOrder {
  public:
    explicit CurveOrder(const TetMesh& mesh);
    void sort(std::vector<CellHandle>& cells, const TetMesh& mesh) const;

  private:
    std::uint32_t key(const volmesh::Point& p) const;

    volmesh::Point origin_;
    double scale_;  ///< from the mesh's lengths to steps of the curve's grid
};

}  // namespace maille::refine
