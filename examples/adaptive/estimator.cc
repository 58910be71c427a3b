#include "examples/adaptive/estimator.hh"

#include <algorithm>
#include <cmath>

namespace adaptive {
namespace {

using maille::volmesh::CellHandle;

Point gradient_in(const TetMesh& mesh, CellHandle c, const Element& element, const Eigen::VectorXd& values) {
    Point gradient = Point::Zero();
    for (int i = 0; i < 4; ++i) gradient += values[mesh.cell_vertex(c, i).idx()] * element.gradients.col(i);
    return gradient;
}

double longest_edge(const std::array<Point, 4>& corners) {
    double longest = 0;
    for (const auto& [i, j] : maille::volmesh::tet::edge_vertices)
        longest = std::max(longest, (corners[i] - corners[j]).norm());
    return longest;
}

}  // namespace

std::vector<double> estimate_errors(const TetMesh& mesh, const Eigen::VectorXd& values) {
    std::vector<Point> recovered(mesh.n_vertices(), Point::Zero());
    std::vector<double> weights(mesh.n_vertices());
    for (const auto c : mesh.cells()) {
        const Element element(mesh.cell_points(c));
        const Point gradient = gradient_in(mesh, c, element, values);
        for (const auto v : mesh.cell_vertices(c)) {
            recovered[v.idx()] += element.volume * gradient;
            weights[v.idx()] += element.volume;
        }
    }
    for (std::size_t v = 0; v < recovered.size(); ++v)
        if (weights[v] > 0) recovered[v] /= weights[v];

    std::vector<double> errors;
    for (const auto c : mesh.cells()) {
        const Element element(mesh.cell_points(c));
        const Point gradient = gradient_in(mesh, c, element, values);
        // The integral of the product of two linear functions, by their values at the corners.
        Point sum = Point::Zero();
        double squares = 0;
        for (const auto v : mesh.cell_vertices(c)) {
            const Point difference = recovered[v.idx()] - gradient;
            sum += difference;
            squares += difference.squaredNorm();
        }
        errors.push_back(std::sqrt(element.volume / 20 * (squares + sum.squaredNorm())));
    }
    return errors;
}

std::vector<double> wanted_sizes(const TetMesh& mesh, const std::vector<double>& errors, double growth) {
    const auto cells_at = [&](double even) {
        double sum = 0;
        for (const double error : errors) sum += std::pow(std::max(1.0, error / even), 6.0 / 5);
        return sum;
    };
    const double wanted_cells = growth * static_cast<double>(errors.size());
    double low = 0, high = *std::ranges::max_element(errors);
    for (int step = 0; step < 60; ++step) {
        const double middle = (low + high) / 2;
        (cells_at(middle) > wanted_cells ? low : high) = middle;
    }
    std::vector<double> sizes;
    for (const auto c : mesh.cells())
        sizes.push_back(longest_edge(mesh.cell_points(c)) *
                        std::pow(std::min(1.0, high / errors[c.idx()]), 2.0 / 5));
    return sizes;
}

}  // namespace adaptive
