#include "examples/adaptive/poisson.hh"

#include <optional>

#include <Eigen/Geometry>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include "volmesh/error.hh"

namespace adaptive {
namespace {

using maille::volmesh::CellHandle;
using maille::volmesh::EntityKind;
using maille::volmesh::SetHandle;
using Matrix = Eigen::SparseMatrix<double>;

/// Each shape function's integral times the source: four points of Gauss, exact to second degree.
constexpr double near_weight = 0.5854101966249685, far_weight = 0.1381966011250105;

/// By vertex: its value, where a condition gives one.
std::vector<std::optional<double>> given_values(const TetMesh& mesh,
                                                const std::vector<Condition>& conditions) {
    std::vector<std::optional<double>> given(mesh.n_vertices());
    for (const auto& [prefix, value] : conditions) {
        bool is_met = false;
        for (std::uint32_t s = 0; s < mesh.n_sets(); ++s) {
            const auto& info = mesh.set_info(SetHandle(s));
            if (info.kind != EntityKind::face || !info.name.starts_with(prefix)) continue;
            is_met = true;
            for (const auto face : mesh.face_members(SetHandle(s)))
                for (const auto v : mesh.halfface_vertices(face)) given[v.idx()] = value(mesh.point(v));
        }
        if (!is_met) throw maille::InputError("no face set's name begins with \"" + prefix + "\"");
    }
    return given;
}

/// Number of each vertex among the unknowns; -1 where its value is given.
std::vector<int> number_unknowns(const std::vector<std::optional<double>>& given) {
    std::vector<int> numbers;
    int next = 0;
    for (const auto& value : given) numbers.push_back(value ? -1 : next++);
    return numbers;
}

struct Equations {
    Matrix matrix;
    Eigen::VectorXd right;
};

Equations assemble(const TetMesh& mesh, const Problem& problem,
                   const std::vector<std::optional<double>>& given, const std::vector<int>& numbers,
                   Eigen::Index n_unknowns) {
    Equations equations{Matrix(n_unknowns, n_unknowns), Eigen::VectorXd::Zero(n_unknowns)};
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(std::size_t{16} * mesh.n_cells());
    for (const auto c : mesh.cells()) {
        const auto corners = mesh.cell_points(c);
        const Element element(corners);
        const Eigen::Matrix4d stiffness = element.volume * element.gradients.transpose() * element.gradients;
        const Point center = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
        std::array<double, 4> source{};
        for (int q = 0; q < 4; ++q)
            source[q] = problem.source(4 * far_weight * center + (near_weight - far_weight) * corners[q]);
        const auto vertices = mesh.cell_vertices(c);
        for (int i = 0; i < 4; ++i) {
            const int row = numbers[vertices[i].idx()];
            if (row < 0) continue;
            for (int q = 0; q < 4; ++q)
                equations.right[row] += element.volume / 4 * source[q] * (q == i ? near_weight : far_weight);
            for (int j = 0; j < 4; ++j) {
                const int column = numbers[vertices[j].idx()];
                if (column >= 0)
                    entries.emplace_back(row, column, stiffness(i, j));
                else
                    equations.right[row] -= stiffness(i, j) * *given[vertices[j].idx()];
            }
        }
    }
    equations.matrix.setFromTriplets(entries.begin(), entries.end());
    return equations;
}

double energy_of(const TetMesh& mesh, const Eigen::VectorXd& values) {
    double energy = 0;
    for (const auto c : mesh.cells()) {
        const Element element(mesh.cell_points(c));
        Point gradient = Point::Zero();
        for (int i = 0; i < 4; ++i)
            gradient += values[mesh.cell_vertex(c, i).idx()] * element.gradients.col(i);
        energy += element.volume * gradient.squaredNorm();
    }
    return energy;
}

}  // namespace

Element::Element(const std::array<Point, 4>& corners) {
    Eigen::Matrix3d edges;
    for (int i = 0; i < 3; ++i) edges.row(i) = corners[i + 1] - corners[0];
    volume = edges.determinant() / 6;
    gradients.rightCols<3>() = edges.inverse();
    gradients.col(0) = -gradients.rightCols<3>().rowwise().sum();
}

Solution solve(const TetMesh& mesh, const Problem& problem) {
    const auto given = given_values(mesh, problem.conditions);
    const std::vector<int> numbers = number_unknowns(given);
    const Eigen::Index n_unknowns = *std::ranges::max_element(numbers) + 1;
    const Equations equations = assemble(mesh, problem, given, numbers, n_unknowns);

    Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper, Eigen::IncompleteCholesky<double>> solver;
    solver.setTolerance(1e-10);
    solver.compute(equations.matrix);
    const Eigen::VectorXd unknowns = solver.solve(equations.right);
    if (solver.info() != Eigen::Success) throw maille::InputError("the equations could not be solved");

    Solution solution{Eigen::VectorXd(mesh.n_vertices()), n_unknowns, 0};
    for (std::size_t v = 0; v < numbers.size(); ++v)
        solution.values[static_cast<Eigen::Index>(v)] = numbers[v] < 0 ? *given[v] : unknowns[numbers[v]];
    solution.energy = energy_of(mesh, solution.values);
    return solution;
}

double integral(const std::array<Point, 4>& corners, double volume,
                const std::function<double(const Point&)>& function) {
    const Point center = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
    double sum = 0;
    for (const Point& corner : corners)
        sum += function(4 * far_weight * center + (near_weight - far_weight) * corner);
    return volume / 4 * sum;
}

}  // namespace adaptive
