#pragma once

#include <functional>
#include <optional>

#include "quality/objective.hh"
#include "quality/support.hh"

namespace maille::quality {

/// Whether a vertex may stand at a place, as far as others than its cells' shapes are concerned.
using IsAllowed = std::function<bool(const Point&)>;

/// A place near `start` that raises the least objective of the cells with these bases, if there is one:
/// steepest ascent of that minimum, as in L. Freitag, C. Ollivier-Gooch, "Tetrahedral mesh improvement using
/// swapping and smoothing", IJNME 40, 1997.
std::optional<Point> better_place(const Bases& bases, const Point& start, const Constraint& constraint,
                                  const IsAllowed& is_allowed);

}  // namespace maille::quality
