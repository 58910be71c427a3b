#pragma once

#include <vector>

#include "examples/adaptive/poisson.hh"

namespace adaptive {

/// The error of each cell in the energy norm, as O. C. Zienkiewicz and J. Z. Zhu estimate it ("A simple error
/// estimator and adaptive procedure for practical engineering analysis", IJNME 24, 1987): the difference
/// between the gradient, constant in the cell, and its average at the nodes, weighted by volume and
/// interpolated.
std::vector<double> estimate_errors(const TetMesh& mesh, const Eigen::VectorXd& values);

/// The element sizes that spread the error evenly, by cell: an element's error goes as h^(5/2) (h from the
/// gradient, h^(3/2) from the volume), so it gets h (e / error)^(2/5), where e is chosen for `growth` times
/// as many cells as there are. No size is larger than it was. h is the longest edge.
std::vector<double> wanted_sizes(const TetMesh& mesh, const std::vector<double>& errors, double growth);

}  // namespace adaptive
