#pragma once

#include <limits>

#include <boost/container/small_vector.hpp>

#include "quality/measures.hh"

namespace maille::quality {

/// What improvement raises, of the worst cell: the least of the sines of the six dihedral angles, those of
/// obtuse ones times `obtuse_weight`, and of beta = 3 r / R times `beta_weight`. The weights are such that
/// angles of 15 and 155 degrees and beta = .3 have the same value, `sine_of_15`. Where the volume isn't
/// positive it is gamma, which is negative or 0.
///
/// Sines as in B. M. Klingner, J. R. Shewchuk, "Aggressive tetrahedral mesh improvement", 2007; beta keeps
/// out cells that are good by angles but spread out, such as needles.
inline constexpr double sine_of_15 = 0.25881904510252074;
inline constexpr double obtuse_weight = sine_of_15 / 0.42261826174069944;  // sin 155
inline constexpr double beta_weight = sine_of_15 / 0.3;

double objective(const Point& a, const Point& b, const Point& c, const Point& d);

/// The objective together with beta.
struct Shape {
    double objective, beta;
};
Shape shape(const Point& a, const Point& b, const Point& c, const Point& d);

/// What deleted cells count as.
inline constexpr Shape perfect_shape{1, 1};

/// The face of a cell that a vertex sees: with the vertex in front it is the cell, positively oriented.
using Base = std::array<Point, 3>;
using Bases = boost::container::small_vector<Base, 48>;

inline double objective(const Point& p, const Base& base) {
    return objective(p, base[0], base[1], base[2]);
}

/// The least objective of the cells with these bases; from the first one on that is at most `enough`, any
/// value that is at most that.
double least_objective(const Point& p, const Bases& bases,
                       double enough = -std::numeric_limits<double>::infinity());

/// One of the functions of which the objective is the least, and its gradient in p.
struct Slope {
    double value;
    Point gradient;
};
using Slopes = boost::container::small_vector<Slope, 32>;

/// Appends those functions of the cell whose values are at most `most`.
void append_slopes(const Point& p, const Base& base, double most, Slopes& slopes);

/// beta of the cell with p in front of the base, and its gradient in p. Precondition: its volume is positive.
Slope beta_slope(const Point& p, const Base& base);

}  // namespace maille::quality
