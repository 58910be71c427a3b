#include "tools/benchmark/start_mesh.hh"

#include <algorithm>
#include <numeric>
#include <random>

#include "volmesh/error.hh"
#include "volmesh/io/mesh_io.hh"

namespace maille::benchmark {
namespace {

using volmesh::Point;

/// Corners of a brick as bits x + 2y + 4z; positively oriented.
constexpr std::array<std::array<int, 4>, 6> kuhn_tets{
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

std::vector<std::uint32_t> random_order(std::size_t n, std::mt19937& random) {
    std::vector<std::uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::shuffle(order, random);
    return order;
}

}  // namespace

CellSoup kuhn_cube(int n) {
    CellSoup soup;
    for (int z = 0; z <= n; ++z)
        for (int y = 0; y <= n; ++y)
            for (int x = 0; x <= n; ++x) soup.points.push_back(Point(x, y, z) / n);
    const auto node = [n](int x, int y, int z) {
        return static_cast<std::uint32_t>(x + (n + 1) * (y + (n + 1) * z));
    };
    for (int z = 0; z < n; ++z)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                for (const auto& tet : kuhn_tets) {
                    auto& cell = soup.cells.emplace_back();
                    for (int i = 0; i < 4; ++i)
                        cell[i] = node(x + (tet[i] & 1), y + ((tet[i] >> 1) & 1), z + ((tet[i] >> 2) & 1));
                }
    return soup;
}

CellSoup renumbered(const CellSoup& soup, unsigned seed) {
    std::mt19937 random(seed);
    const auto vertices = random_order(soup.points.size(), random);
    const auto cells = random_order(soup.cells.size(), random);
    CellSoup result{std::vector<Point>(soup.points.size()), {}};
    result.cells.resize(soup.cells.size());
    for (std::size_t v = 0; v < vertices.size(); ++v) result.points[vertices[v]] = soup.points[v];
    for (std::size_t c = 0; c < cells.size(); ++c)
        for (int i = 0; i < 4; ++i) result.cells[cells[c]][i] = vertices[soup.cells[c][i]];
    return result;
}

CellSoup start_mesh(const std::string& what) {
    const std::string kuhn = "kuhn:";
    if (what.starts_with(kuhn)) {
        const int n = std::atoi(what.c_str() + kuhn.size());
        if (n < 1 || n > 400) throw InputError("write kuhn:N with N from 1 to 400, not " + what);
        return kuhn_cube(n);
    }
    const volmesh::TetMesh mesh = volmesh::read_mesh(what);
    const auto cells = mesh.cell_vertex_indices();
    return {{mesh.points().begin(), mesh.points().end()}, {cells.begin(), cells.end()}};
}

}  // namespace maille::benchmark
