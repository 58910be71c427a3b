#include "examples/adaptive/loop.hh"

#include <cmath>

#include "examples/adaptive/estimator.hh"
#include "refine/refine.hh"

namespace adaptive {
namespace {

using namespace maille;

double norm(const std::vector<double>& errors) {
    double squares = 0;
    for (const double error : errors) squares += error * error;
    return std::sqrt(squares);
}

double true_error(const TetMesh& mesh, const Eigen::VectorXd& values, const Exact& exact) {
    double squares = 0;
    for (const auto c : mesh.cells()) {
        const auto corners = mesh.cell_points(c);
        const Element element(corners);
        Point gradient = Point::Zero();
        for (int i = 0; i < 4; ++i)
            gradient += values[mesh.cell_vertex(c, i).idx()] * element.gradients.col(i);
        squares += integral(corners, element.volume,
                            [&](const Point& p) { return (exact.gradient(p) - gradient).squaredNorm(); });
    }
    return std::sqrt(squares);
}

/// A least-squares line through (x, y): its value at 0 and its slope.
std::pair<double, double> line(const std::vector<Eigen::Vector2d>& points) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const auto& p : points) mean += p / static_cast<double>(points.size());
    double xx = 0, xy = 0;
    for (const auto& p : points) {
        xx += (p.x() - mean.x()) * (p.x() - mean.x());
        xy += (p.x() - mean.x()) * (p.y() - mean.y());
    }
    return {mean.y() - xy / xx * mean.x(), xy / xx};
}

/// The estimator's sizes are cell values; refinement takes them averaged at the vertices.
refine::SizeField sizes(const TetMesh& mesh, const std::vector<double>& by_cell) {
    TetMesh carrier = mesh;
    volmesh::CPropHandleT<double> size;
    carrier.add_property(size, "wanted size");
    for (const auto c : mesh.cells()) carrier.property(size, volmesh::CellHandle(c)) = by_cell[c.idx()];
    return refine::mesh_size(carrier, "wanted size", refine::CellValues::averaged);
}

std::vector<double> halved_sizes(const TetMesh& mesh) {
    double longest = 0;
    for (const auto c : mesh.cells()) {
        const auto p = mesh.cell_points(c);
        for (const auto& [i, j] : volmesh::tet::edge_vertices)
            longest = std::max(longest, (p[i] - p[j]).norm());
    }
    return std::vector<double>(mesh.n_cells(), longest / 2);
}

}  // namespace

std::vector<Step> run(const Example& example, TetMesh mesh, const volmesh::Projector& projector,
                      const LoopOptions& options) {
    std::vector<Step> steps;
    while (true) {
        const Solution solution = solve(mesh, example.problem);
        const std::vector<double> errors = estimate_errors(mesh, solution.values);
        Step step{mesh.n_cells(), solution.unknowns, solution.energy, norm(errors), {}};
        if (example.exact) step.error = true_error(mesh, solution.values, *example.exact);
        steps.push_back(step);
        if (options.see) options.see(mesh, step, solution.values, errors);

        const double growth = options.is_uniform ? 8 : options.growth;
        if (growth * static_cast<double>(step.unknowns) > static_cast<double>(options.most_unknowns))
            return steps;
        // Halved edges are wanted, not edges of up to 1.5 times a half.
        const auto wanted = options.is_uniform ? halved_sizes(mesh) : wanted_sizes(mesh, errors, growth);
        const double ratio = options.is_uniform ? 1.0 : 1.1;
        refine::refine(mesh, sizes(mesh, wanted), {.ratio = ratio}, &projector);
    }
}

double extrapolated_energy(const std::vector<Step>& steps, std::size_t n) {
    std::vector<Eigen::Vector2d> points;
    for (std::size_t i = steps.size() - std::min(n, steps.size()); i < steps.size(); ++i)
        points.emplace_back(std::pow(static_cast<double>(steps[i].unknowns), -2.0 / 3), steps[i].energy);
    return line(points).first;
}

double slope(const std::vector<Step>& steps, std::size_t n) {
    std::vector<Eigen::Vector2d> points;
    for (std::size_t i = steps.size() - std::min(n, steps.size()); i < steps.size(); ++i)
        if (steps[i].error)
            points.emplace_back(std::log(static_cast<double>(steps[i].unknowns)), std::log(*steps[i].error));
    return line(points).second;
}

void set_errors(std::vector<Step>& steps, double energy) {
    for (Step& step : steps) step.error = std::sqrt(std::max(energy - step.energy, 0.0));
}

}  // namespace adaptive
