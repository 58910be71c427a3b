#pragma once

#include "modeler/outline.hh"

namespace maille::modeler {

/// The same shape with loops that come to no place twice: one that does is cut in two there. Loops still may
/// have corners in common with each other.
Outline split_where_touching(const Outline& shape);

}  // namespace maille::modeler
