#pragma once

#include <cstddef>

#include "modeler/tetgen_protocol.hh"

namespace maille::modeler::tetgen {

/// Renumbers the points but for the first `n_fixed` in the order in which Hilbert's curve comes to them, and
/// the tetrahedra in the order in which it comes to the first of their points: what is near in space is then
/// near in memory, whereas TetGen numbers as it happens to make and to delete.
void order_along_curve(Answer& answer, std::size_t n_fixed);

}  // namespace maille::modeler::tetgen
