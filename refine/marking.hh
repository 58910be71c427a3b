#pragma once

#include <span>
#include <vector>

#include "refine/bisector.hh"
#include "refine/curve_order.hh"
#include "refine/size_field.hh"

namespace maille::refine {

/// In which order a pass takes the elements that are to be refined.
enum class Order : std::uint8_t {
    longest,  ///< the longest edge first
    shape,    ///< the worst shape first, by inscribed radius over longest edge: for start meshes of poor
              ///< quality
    none      ///< as they were made; by Rivara along a curve through space, which is faster
};

/// Those of the cells whose longest edge is longer than `ratio` times the size at their centroid, in the
/// order given. Throws InputError, naming the place, where the size is so small that doubles can't hold such
/// elements' points.
std::vector<CellHandle> cells_to_refine(const Bisector& bisector, std::span<const CellHandle> cells,
                                        const SizeField& size, double ratio);
/// The same, by their centroids' places on a curve.
std::vector<CellHandle> cells_to_refine(const Bisector& bisector, std::span<const CellHandle> cells,
                                        const SizeField& size, double ratio, CurveOrder& curve);

/// Sorts the cells; equals stay in ascending order. (The paper, section 3.3, "Sorting of elements".)
void sort_cells(std::vector<CellHandle>& cells, const Bisector& bisector, Order order);

}  // namespace maille::refine
