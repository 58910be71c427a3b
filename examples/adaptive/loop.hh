#pragma once

#include <functional>
#include <optional>

#include "examples/adaptive/problems.hh"
#include "volmesh/projector.hh"

namespace adaptive {

/// What a mesh of the loop has come to.
struct Step {
    std::uint32_t cells;
    Eigen::Index unknowns;
    double energy;
    double estimate;              ///< of the error in the energy norm
    std::optional<double> error;  ///< the error itself, where the exact solution is known
};

struct LoopOptions {
    bool is_uniform = false;  ///< halves all sizes instead of those that the estimator wants smaller
    Eigen::Index most_unknowns = 100'000;
    double growth = 2.5;  ///< of the number of cells from step to step, as wanted
    /// Called with each mesh, its solution, and the estimate by cell.
    std::function<void(const TetMesh&, const Step&, const Eigen::VectorXd&, const std::vector<double>&)>
        see{};
};

/// Solve, estimate, refine to the sizes that the estimate asks for, and so on until the next step would have
/// too many unknowns.
std::vector<Step> run(const Example& example, TetMesh mesh, const maille::volmesh::Projector& projector,
                      const LoopOptions& options);

/// The energy that steps tend to whose energy error falls as the number of unknowns to the power of -2/3:
/// least squares over the last `n`.
double extrapolated_energy(const std::vector<Step>& steps, std::size_t n);

/// The exponent in error ~ unknowns^exponent: least squares of the logarithms over the last `n` steps.
double slope(const std::vector<Step>& steps, std::size_t n);

/// Errors by energy: sqrt(energy - step.energy), as they are where all conditions are u = 0.
void set_errors(std::vector<Step>& steps, double energy);

}  // namespace adaptive
