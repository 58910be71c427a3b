#pragma once

#include <optional>
#include <string>

#include "examples/adaptive/poisson.hh"

namespace adaptive {

struct Exact {
    std::function<Point(const Point&)> gradient;
};

/// A problem on a model. Its error is measured against the exact solution, or else against the energy of it.
struct Example {
    std::string name, model;
    Problem problem;
    std::optional<Exact> exact;
    double exact_energy = 0;  ///< where there is no exact solution
};

/// A source of 1 in the cube without a corner; u = 0 on the three faces of the notch. At its edges, of angle
/// 3/2 pi, grad u goes as the distance to the power of -1/3.
Example fichera();

/// Im w^(2/3), w = -(s + i z), s = (R^2 - a^2) / 2a, R being the distance from the axis and a the hole's
/// radius: u = 0 on the hole's bottom and side, and of the same kind at the circle between them as at the
/// notch's edges.
Example blind_hole();

/// By name; throws InputError for any other.
Example example(const std::string& name);

}  // namespace adaptive
