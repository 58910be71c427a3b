#include "quality/relocate.hh"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "volmesh/orientation.hh"

namespace maille::quality {

double exact_gamma(const Point& a, const Point& b, const Point& c, const Point& d) {
    if (volmesh::orientation(a, b, c, d) <= 0) return 0;
    const Point u = b - a, v = c - a, w = d - a;
    const double squares = u.squaredNorm() + v.squaredNorm() + w.squaredNorm() + (v - u).squaredNorm() +
                           (w - u).squaredNorm() + (w - v).squaredNorm();
    const double mean_square = squares / 6;
    return std::max(std::numbers::sqrt2 * u.cross(v).dot(w) / (mean_square * std::sqrt(mean_square)), 0.0);
}

double worst_shape(const TetMesh& mesh, const CellList& cells, VertexHandle v, const Point& at) {
    double worst = 1;
    for (const CellHandle c : cells) {
        auto p = mesh.cell_points(c);
        p[mesh.local_vertex(c, v)] = at;
        worst = std::min(worst, exact_gamma(p[0], p[1], p[2], p[3]));
    }
    return worst;
}

bool is_free(const TetMesh& mesh, VertexHandle v, const CellList& cells) {
    if (mesh.combination(v) != 0) return false;
    for (const CellHandle c : cells) {
        if (mesh.combination(c) != mesh.combination(cells.front())) return false;
        const int local = mesh.local_vertex(c, v);
        for (int other = 0; other < 4; ++other) {
            if (other == local) continue;
            const auto face = TetMesh::halfface(c, other);
            if (mesh.is_boundary(face) || mesh.combination(face) != 0) return false;
            if (mesh.combination(c, volmesh::tet::edge_between[local][other]) != 0) return false;
        }
    }
    return true;
}

Point polyhedron_centroid(const TetMesh& mesh, const CellList& cells) {
    Point sum = Point::Zero();
    double total = 0;
    for (const CellHandle c : cells) {
        const auto p = mesh.cell_points(c);
        const double volume = (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
        sum += volume * (p[0] + p[1] + p[2] + p[3]);
        total += volume;
    }
    return sum / (4 * total);
}

bool relocate(TetMesh& mesh, VertexHandle v, const CellList& cells, std::span<const Point> targets) {
    const Point from = mesh.point(v);
    Point best = from;
    double best_shape = worst_shape(mesh, cells, v, from);
    for (const Point& target : targets) {
        for (const double part : {1.0, 0.5, 0.25}) {
            const Point at = from + part * (target - from);
            const double worst = worst_shape(mesh, cells, v, at);
            if (worst <= best_shape) continue;
            best = at;
            best_shape = worst;
        }
    }
    mesh.set_point(v, best);
    return best != from;
}

bool relax(TetMesh& mesh, VertexHandle v, const CellList& cells) {
    const Point centroid = polyhedron_centroid(mesh, cells);
    return relocate(mesh, v, cells, {&centroid, 1});
}

}  // namespace maille::quality
