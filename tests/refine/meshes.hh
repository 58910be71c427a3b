#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include <Eigen/Geometry>

#include "volmesh/tet_mesh.hh"

/// Meshes for the tests of refinement.
namespace test {

using maille::volmesh::CellHandle;
using maille::volmesh::Point;
using maille::volmesh::TetMesh;
using maille::volmesh::VertexHandle;
using Tet = std::array<std::uint32_t, 4>;

/// The six tetrahedra of a brick along its diagonal (Kuhn), corners as bits x + 2y + 4z, positively oriented.
inline constexpr std::array<std::array<int, 4>, 6> kuhn_tets{
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

inline void orient(const std::vector<Point>& points, Tet& t) {
    const Point a = points[t[0]];
    if ((points[t[1]] - a).cross(points[t[2]] - a).dot(points[t[3]] - a) < 0) std::swap(t[2], t[3]);
}

struct Soup {
    std::vector<Point> points;
    std::vector<Tet> tets;
    TetMesh mesh() const { return TetMesh::from_cells(points, tets); }
};

/// [0,1]^3 in n^3 Kuhn bricks.
inline Soup kuhn_cube(int n) {
    Soup soup;
    const auto node = [n](int x, int y, int z) {
        return static_cast<std::uint32_t>(x + (n + 1) * (y + (n + 1) * z));
    };
    for (int z = 0; z <= n; ++z)
        for (int y = 0; y <= n; ++y)
            for (int x = 0; x <= n; ++x) soup.points.push_back(Point(x, y, z) / n);
    for (int z = 0; z < n; ++z)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                for (const auto& kuhn : kuhn_tets) {
                    Tet t{};
                    for (int i = 0; i < 4; ++i)
                        t[i] = node(x + (kuhn[i] & 1), y + ((kuhn[i] >> 1) & 1), z + ((kuhn[i] >> 2) & 1));
                    orient(soup.points, t);
                    soup.tets.push_back(t);
                }
    return soup;
}

/// The Kuhn cube with its inner nodes moved at random, cells and nodes in random order.
inline Soup random_cube(int n, unsigned seed, double shake) {
    Soup soup = kuhn_cube(n);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shift(-shake / n, shake / n);
    for (Point& p : soup.points)
        for (int i = 0; i < 3; ++i)
            if (p[i] > 1e-9 && p[i] < 1 - 1e-9) p[i] += shift(random);
    std::vector<std::uint32_t> order(soup.points.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::shuffle(order, random);
    std::vector<Point> points(soup.points.size());
    for (std::size_t i = 0; i < points.size(); ++i) points[order[i]] = soup.points[i];
    soup.points = points;
    for (Tet& t : soup.tets) {
        for (auto& v : t) v = order[v];
        orient(soup.points, t);
    }
    std::ranges::shuffle(soup.tets, random);
    return soup;
}

/// The cells by their corners' places alone: equal for meshes that differ in numbering only.
using Places = std::array<std::array<double, 3>, 4>;
inline Places places(const std::array<Point, 4>& corners) {
    Places p;
    for (int i = 0; i < 4; ++i) p[i] = {corners[i].x(), corners[i].y(), corners[i].z()};
    std::ranges::sort(p);
    return p;
}
inline std::vector<Places> places(const TetMesh& mesh) {
    std::vector<Places> all;
    for (const auto c : mesh.cells()) all.push_back(places(mesh.cell_points(c)));
    std::ranges::sort(all);
    return all;
}

}  // namespace test
