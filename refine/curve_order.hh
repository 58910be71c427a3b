#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "volmesh/column.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::refine {

using volmesh::CellHandle;
using volmesh::TetMesh;

/// Sorts cells along a space-filling curve through the bounding box that a mesh has when this is made. Cells
/// that are near to each other are then taken one after another, and what is made of them lies near to them
/// in memory.
///
/// The curve is Morton's ("A computer oriented geodetic data base", 1966): the bits of the coordinates,
/// interleaved. Cost: linear.
class CurveOrder {
  public:
    using Place = std::uint32_t;
    static constexpr Place nowhere = std::numeric_limits<Place>::max();

    explicit CurveOrder(const TetMesh& mesh);

    /// How far along the curve a point is.
    Place place(const volmesh::Point& p) const;
    /// Room for the places of so many cells, to be filled before `sorted`.
    std::span<Place> places(std::size_t n_cells);
    /// The cells whose place isn't `nowhere`, by their places; those of one place as they were.
    std::vector<CellHandle> sorted(std::span<const CellHandle> cells);

  private:
    struct Keyed {
        Place place;
        CellHandle cell;
    };
    using KeyedCells = volmesh::Column<Keyed>;

    static void sort_by_bits(const KeyedCells& from, KeyedCells& to, int shift);

    volmesh::Point origin_;
    double scale_;  ///< from the mesh's lengths to steps of the curve's grid
    // Kept from one sort to the next, as fresh memory takes time.
    volmesh::Column<Place> places_;
    KeyedCells keyed_, other_;
};

}  // namespace maille::refine
