#include "refine/paper.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <limits>
#include <map>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "quality/measures.hh"
#include "volmesh/error.hh"

namespace maille::refine {
namespace {

/// The tetrahedra of a brick, corners as bits x + 2y + 4z: two at corners, two along the diagonal, two
/// slanted. This mix gives Table 1 to the printed digit.
constexpr std::array<std::array<int, 4>, 6> brick_tets{
    {{2, 4, 6, 7}, {0, 2, 4, 5}, {0, 1, 3, 5}, {0, 2, 3, 5}, {2, 4, 5, 7}, {2, 3, 5, 7}}};

using Brick = std::array<int, 3>;

/// A mesh of unit bricks scaled by `edge`, numbered x fastest, then y, then z.
volmesh::TetMesh brick_mesh(const std::vector<Brick>& bricks, double edge) {
    std::map<std::array<int, 3>, std::uint32_t> nodes;  // by z, y, x
    const auto corner = [](const Brick& b, int bits) {
        return std::array<int, 3>{b[2] + ((bits >> 2) & 1), b[1] + ((bits >> 1) & 1), b[0] + (bits & 1)};
    };
    for (const Brick& brick : bricks)
        for (int bits = 0; bits < 8; ++bits) nodes.emplace(corner(brick, bits), 0);
    std::vector<Point> points;
    for (auto& [zyx, index] : nodes) {
        index = static_cast<std::uint32_t>(points.size());
        points.push_back(edge * Point(zyx[2], zyx[1], zyx[0]));
    }
    std::vector<std::array<std::uint32_t, 4>> cells;
    for (const Brick& brick : bricks) {
        for (const auto& tet : brick_tets) {
            std::array<std::uint32_t, 4> cell{};
            for (int i = 0; i < 4; ++i) cell[i] = nodes.at(corner(brick, tet[i]));
            const Point a = points[cell[0]];
            if ((points[cell[1]] - a).cross(points[cell[2]] - a).dot(points[cell[3]] - a) < 0)
                std::swap(cell[2], cell[3]);
            cells.push_back(cell);
        }
    }
    return volmesh::TetMesh::from_cells(std::move(points), std::move(cells));
}

/// Collects the values of one measure.
class Statistic {
  public:
    void add(double value) {
        spread_.min = n_ == 0 ? value : std::min(spread_.min, value);
        spread_.max = n_ == 0 ? value : std::max(spread_.max, value);
        sum_ += value;
        ++n_;
    }
    Spread spread() const { return {spread_.min, sum_ / static_cast<double>(n_), spread_.max}; }

  private:
    Spread spread_;
    double sum_ = 0;
    std::size_t n_ = 0;
};

quality::TetGeometry geometry(const volmesh::TetMesh& mesh, volmesh::CellHandle c) {
    const auto p = mesh.cell_points(c);
    return quality::tet_geometry(p[0], p[1], p[2], p[3]);
}

PaperStart measure_start(const volmesh::TetMesh& mesh) {
    Statistic radius_ratio, sigma, alpha, tau;
    for (const auto c : mesh.cells()) {
        const auto t = geometry(mesh, c);
        radius_ratio.add(std::sqrt(6.0) * quality::radius_ratio(t));
        sigma.add(quality::sigma(t));
        alpha.add(quality::alpha(t));
        tau.add(quality::tau(t));
    }
    return {mesh.n_cells(), mesh.n_vertices(), radius_ratio.spread(),
            sigma.spread(), alpha.spread(),    tau.spread()};
}

void measure(const volmesh::TetMesh& mesh, const SizeField& size, PaperRun& run) {
    Statistic sigma, tau, phi;
    std::array<std::size_t, 4> counts{};
    for (const auto c : mesh.cells()) {
        const auto t = geometry(mesh, c);
        const auto p = mesh.cell_points(c);
        const double s = quality::sigma(t), e = quality::tau(t);
        const double f = quality::phi(t, size(0.25 * (p[0] + p[1] + p[2] + p[3])));
        sigma.add(s);
        tau.add(e);
        phi.add(f);
        counts[0] += s < 0.4;
        counts[1] += s < 0.2;
        counts[2] += e < 0.3;
        counts[3] += f > 2.0 / 3 && f < 1.5;
    }
    run.cells = mesh.n_cells();
    run.vertices = mesh.n_vertices();
    run.sigma = sigma.spread();
    run.tau = tau.spread();
    run.phi = phi.spread();
    const auto percent = [&](std::size_t n) { return 100.0 * static_cast<double>(n) / mesh.n_cells(); };
    run.sigma_below_0_4_percent = percent(counts[0]);
    run.sigma_below_0_2_percent = percent(counts[1]);
    run.tau_below_0_3_percent = percent(counts[2]);
    run.phi_within_percent = percent(counts[3]);
}

PaperRun run_once(int example, Method method, Order order) {
    volmesh::TetMesh mesh = paper_mesh(example);
    const SizeField size = paper_size(example);
    PaperRun run;
    run.method = method;
    run.order = order;
    const std::clock_t start = std::clock();
    const RefineResult result = refine(
        mesh, size,
        {.method = method, .order = order, .ties = Ties::fewest, .max_iterations = 50, .max_cells = 1000000});
    run.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    run.iterations = result.iterations;
    run.ended = result.ended;
    measure(mesh, size, run);
    return run;
}

PaperStart printed_start(int example) {
    const double sigma = example == 1 ? 0.608834 : 0.604382;
    return {0,
            0,
            {0.508666, example == 1 ? 0.564057 : 0.568254, 0.597717},
            {0.508666, sigma, 0.732051},
            {0.601921, example == 1 ? 0.703934 : 0.704405, 0.803509},
            {0.577350, example == 1 ? 0.620602 : 0.612247, 0.707107}};
}

std::vector<PaperRun> printed_runs(int example) {
    using enum Method;
    using enum Order;
    if (example == 1)
        return {{bisection,
                 none,
                 7,
                 true,
                 3936,
                 933,
                 {0.0499186, 0.572655, 1},
                 {0.188982, 0.535242, 1},
                 {0.873464, 1.22086, 1.46158},
                 8.86,
                 1.57,
                 3.88,
                 100,
                 140},
                {bisection,
                 longest,
                 7,
                 true,
                 3515,
                 842,
                 {0.313694, 0.601893, 1},
                 {0.288675, 0.564946, 1},
                 {0.956832, 1.24317, 1.35316},
                 0.28,
                 0,
                 0.08,
                 100,
                 131},
                {rivara,
                 none,
                 7,
                 true,
                 3517,
                 841,
                 {0.400783, 0.60431, 1},
                 {0.408248, 0.564194, 1},
                 {1.10485, 1.24097, 1.35316},
                 0,
                 0,
                 0,
                 100,
                 145},
                {rivara,
                 longest,
                 7,
                 true,
                 3519,
                 841,
                 {0.400783, 0.604619, 1},
                 {0.408248, 0.564023, 1},
                 {1.10485, 1.24052, 1.35316},
                 0,
                 0,
                 0,
                 100,
                 150}};
    return {{bisection,
             none,
             15,
             true,
             11640,
             2805,
             {0.0555519, 0.545894, 1},
             {0.0762493, 0.514044, 1},
             {0.50402, 1.20205, 1.49821},
             12.6,
             0.9,
             3.89,
             99.63,
             687},
            {bisection,
             longest,
             15,
             true,
             9917,
             2435,
             {0.293179, 0.584374, 1},
             {0.25, 0.554054, 1},
             {0.717876, 1.24002, 1.49821},
             1.62,
             0,
             0.18,
             100,
             600},
            {rivara,
             none,
             15,
             true,
             10117,
             2473,
             {0.359681, 0.5842, 1},
             {0.353553, 0.556644, 1},
             {0.800021, 1.23506, 1.49821},
             1.12,
             0,
             0,
             100,
             733},
            {rivara,
             longest,
             15,
             true,
             10168,
             2482,
             {0.339459, 0.583953, 1},
             {0.288675, 0.557701, 1},
             {0.615981, 1.23271, 1.49821},
             1.27,
             0,
             0,
             99.99,
             747}};
}

void require_example(int example) {
    if (example != 1 && example != 2)
        throw InputError(fmt::format("the paper has examples 1 and 2, but no example {}", example));
}

}  // namespace

volmesh::TetMesh paper_mesh(int example) {
    require_example(example);
    const int n = example == 1 ? 2 : 5;
    std::vector<Brick> bricks;
    for (int z = 0; z < n; ++z)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const auto is_inner = [n](int i) { return i > 0 && i < n - 1; };
                const int inner = is_inner(x) + is_inner(y) + is_inner(z);
                if (inner < 2) bricks.push_back({x, y, z});
            }
    return brick_mesh(bricks, example == 1 ? 0.5 : 1.0);
}

SizeField paper_size(int example) {
    require_example(example);
    if (example == 1) return SizeField(1 / 6.25);
    constexpr double h0 = 0.04, h = 0.75, tau = 4.5;
    return SizeField([](const Point& p) { return h0 + h * (1 - std::exp(-p.norm() / tau)); },
                     "the size of example 2");
}

PaperExample paper_example(int example) {
    require_example(example);
    PaperExample result;
    result.title = example == 1 ? "Example 1: uniform refinement of a cube" : "Example 2: a hollow cube";
    result.start = measure_start(paper_mesh(example));
    result.printed_start = printed_start(example);
    for (const Method method : {Method::bisection, Method::rivara})
        for (const Order order : {Order::none, Order::longest})
            result.runs.push_back(run_once(example, method, order));
    result.printed_runs = printed_runs(example);
    return result;
}

}  // namespace maille::refine
