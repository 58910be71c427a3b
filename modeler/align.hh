#pragma once

#include "modeler/model.hh"

namespace maille::modeler {

/// The model with faces of different polyhedra that touch, and lie in one plane to within `tolerance` (a
/// length), in one plane to rounding: that of one whose normal is an axis, or else of the largest. Numbers
/// written with a few digits leave solids that are meant to be flush a little askew, and what is between them
/// would be filled with cells as thin as that. Where a polyhedron's corners cannot be moved so without
/// bending another of its faces, or by more than ten times the tolerance, it stays as it is.
Model aligned(const Model& model, double tolerance);

}  // namespace maille::modeler
