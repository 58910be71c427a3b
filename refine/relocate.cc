#include "refine/relocate.hh"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace maille::refine {

double certain_shape(const Point& a, const Point& b, const Point& c, const Point& d) {
    const Point ad = a - d, bd = b - d, cd = c - d;
    const double bc = bd.x() * cd.y(), cb = cd.x() * bd.y();
    const double ca = cd.x() * ad.y(), ac = ad.x() * cd.y();
    const double ab = ad.x() * bd.y(), ba = bd.x() * ad.y();
    const double det = -(ad.z() * (bc - cb) + bd.z() * (ca - ac) + cd.z() * (ab - ba));
    const double bound = (std::abs(bc) + std::abs(cb)) * std::abs(ad.z()) +
                         (std::abs(ca) + std::abs(ac)) * std::abs(bd.z()) +
                         (std::abs(ab) + std::abs(ba)) * std::abs(cd.z());
    // J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997:
    // the error of this determinant is at most (7 + 56 e) e times the bound, e = 2^-53.
    constexpr double error = 7.7715611723761027e-16;
    if (!(det > error * bound)) return 0;
    const double mean_square = (ad.squaredNorm() + bd.squaredNorm() + cd.squaredNorm() + (a - b).squaredNorm() +
                                (a - c).squaredNorm() + (b - c).squaredNorm()) /
                               6;
    return std::sqrt(2.0) * det / (mean_square * std::sqrt(mean_square));
}

double worst_shape(const TetMesh& mesh, const CellList& cells, VertexHandle v, const Point& at) {
    double worst = 1;
    for (const CellHandle c : cells) {
        auto p = mesh.cell_points(c);
        p[mesh.local_vertex(c, v)] = at;
        worst = std::min(worst, certain_shape(p[0], p[1], p[2], p[3]));
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

bool relax(TetMesh& mesh, VertexHandle v, const CellList& cells) {
    const Point from = mesh.point(v), to = polyhedron_centroid(mesh, cells);
    const double before = worst_shape(mesh, cells, v, from);
    for (double part = 1; part > 0.1; part /= 2) {
        const Point at = from + part * (to - from);
        if (worst_shape(mesh, cells, v, at) > before) {
            mesh.set_point(v, at);
            return true;
        }
    }
    return false;
}

}  // namespace maille::refine
