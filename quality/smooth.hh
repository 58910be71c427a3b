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

using Shapes = boost::container::small_vector<Shape, 48>;

/// A place for a vertex, and the shapes that its cells have with it there.
struct Place {
    Point point;
    Shapes shapes;
};

/// A place near `start` that raises the sum of beta over the cells with these bases and leaves all of them an
/// objective above `floor`, if there is one: up the slope of the sum, about as far as it rises.
std::optional<Place> higher_place(const Bases& bases, const Point& start, double floor,
                                  const Constraint& constraint, const IsAllowed& is_allowed);

}  // namespace maille::quality
