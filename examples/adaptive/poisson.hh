#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "volmesh/tet_mesh.hh"

/// Poisson's equation with linear tetrahedra.
namespace adaptive {

using maille::volmesh::Point;
using maille::volmesh::TetMesh;

/// What holds on the faces of the sets whose names begin so: u is this function.
struct Condition {
    std::string set_prefix;
    std::function<double(const Point&)> value;
};

/// -div grad u = source, with the conditions given; nothing flows through all other faces. Where two
/// conditions meet, the later one holds.
struct Problem {
    std::function<double(const Point&)> source;
    std::vector<Condition> conditions;
};

/// The gradients of the four linear shape functions, and the volume.
struct Element {
    explicit Element(const std::array<Point, 4>& corners);
    Eigen::Matrix<double, 3, 4> gradients;
    double volume;
};

struct Solution {
    Eigen::VectorXd values;  ///< by vertex
    Eigen::Index unknowns;   ///< vertices without a condition
    double energy;           ///< the integral of |grad u|^2
};

/// Throws InputError where no face set bears a name that a condition gives, or the equations can't be solved.
Solution solve(const TetMesh& mesh, const Problem& problem);

/// The integral of a function over a tetrahedron: exact for polynomials of second degree.
double integral(const std::array<Point, 4>& corners, double volume,
                const std::function<double(const Point&)>& function);

}  // namespace adaptive
