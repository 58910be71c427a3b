#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/html/grid.hh"
#include "tools/html/quantities.hh"

namespace maille::html {

/// The cells that a page carries.
struct Selection {
    std::vector<std::uint32_t> cells;  ///< ascending
    bool is_whole = false;             ///< whether these are all
    /// Where not: the places along each axis, in steps of the grid, at which the mesh can be cut open.
    std::array<std::vector<std::int32_t>, 3> cuts;
    std::size_t n_worst = 0;  ///< so many cells, at least, of each quantity's worst
};

/// All cells if there are no more than `budget`. Otherwise those that are seen from outside, or where the
/// combination of sets changes, or one of `cuts` is seen; those that are listed; and the worst by each
/// quantity, with a quarter of the budget. The more cells the budget leaves, the more cuts there are, at
/// least one an axis: the budget is passed where the boundary and these are larger than it.
///
/// A cell is below a cut at p where the sum of its four coordinates is at most 4 p.
Selection select_cells(const volmesh::TetMesh& mesh, const Grid& grid, std::span<const Quantity> quantities,
                       std::span<const volmesh::CellHandle> listed, std::size_t budget);

}  // namespace maille::html
