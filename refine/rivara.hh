#pragma once

#include <vector>

#include "refine/bisector.hh"

namespace maille::refine {

/// Rivara's refinement: bisects the cells at their longest edges, and as often as need be every cell in the
/// way at its own longest edge, so that the mesh conforms and each cell is only ever bisected at its own
/// longest edge. Returns the cells that are still as they were, as rounding would invert a flat child of
/// theirs or of one in their way.
///
/// The cells in the way lie on the longest edge propagation path (M.-C. Rivara, "New longest-edge algorithms
/// for the refinement and/or improvement of unstructured triangulations", 1997), whose edges grow strictly.
/// An edge that is the longest of all cells round it can be split at once with all of these, and no two such
/// edges have a cell in common: so many are found and split together. Vertices and cells are numbered in the
/// order of the cells given, whatever the number of threads.
std::vector<CellHandle> bisect_conforming(Bisector& bisector, const std::vector<CellHandle>& cells);

}  // namespace maille::refine
