#pragma once

#include <vector>

#include "quality/support.hh"

namespace maille::quality {

/// The interface faces at a vertex, and the edges at it where they lie on different surfaces, to tell how far
/// they are from the true ones. Only those on surfaces that the projector knows.
class SurfacePieces {
  public:
    SurfacePieces(const volmesh::TetMesh& mesh, volmesh::VertexHandle v, const volmesh::CellList& cells,
                  volmesh::FaceSurfaces& surfaces_of);

    /// Greatest distance of the pieces' middles from their surfaces, with the vertex at p; infinite where the
    /// projector finds none. Pieces that have `without` are left out.
    double error(const Point& p, const volmesh::Projector& projector,
                 volmesh::VertexHandle without = {}) const;

  private:
    struct Piece {
        boost::container::small_vector<volmesh::VertexHandle, 2> others;
        boost::container::small_vector<Point, 2> corners;
        Surfaces surfaces;
    };
    std::vector<Piece> pieces_;
};

/// Distance of p from the surfaces; infinite where the projector finds no point on them.
double distance_to(const Surfaces& surfaces, const Point& p, const volmesh::Projector& projector);

}  // namespace maille::quality
