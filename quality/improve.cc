#include "quality/improve.hh"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "quality/measures.hh"
#include "quality/support.hh"

namespace maille::quality {
namespace {

using volmesh::CellHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

/// Steps of ascent at one visit, and halvings of one step.
constexpr int max_steps = 10;
constexpr int max_halvings = 8;
/// Cells whose gamma is this near the least one have a say in the direction.
constexpr double active_margin = 0.02;
/// A visit that gains less isn't worth a move: passes come to an end.
constexpr double least_gain = 1e-4;

/// The face of a cell that a moving vertex sees: with the vertex in front it is the cell, positively
/// oriented.
using Base = std::array<Point, 3>;
using Bases = boost::container::small_vector<Base, 48>;

struct GammaAt {
    double value;
    Point gradient;
};

double gamma_at(const Base& f, const Point& p) {
    return gamma(tet_geometry(p, f[0], f[1], f[2]));
}

double sigma_at(const Base& f, const Point& p) {
    return sigma(tet_geometry(p, f[0], f[1], f[2]));
}

/// gamma = 6 sqrt(2) V (S / 6)^(-3/2), S the sum of squared edges; and its gradient in p.
GammaAt gamma_and_gradient(const Base& f, const Point& p) {
    const Point normal = (f[1] - f[0]).cross(f[2] - f[0]);
    const double squares = (f[1] - f[0]).squaredNorm() + (f[2] - f[1]).squaredNorm() +
                           (f[0] - f[2]).squaredNorm() + (p - f[0]).squaredNorm() + (p - f[1]).squaredNorm() +
                           (p - f[2]).squaredNorm();
    const double factor = std::numbers::sqrt2 / std::pow(squares / 6, 1.5);
    const double value = factor * (f[0] - p).dot(normal);
    return {value, -factor * normal - 3 * value / squares * (3 * p - f[0] - f[1] - f[2])};
}

template <class MeasureAt>
double least(const Bases& bases, const Point& p, const MeasureAt& measure) {
    double worst = std::numeric_limits<double>::infinity();
    for (const Base& base : bases) worst = std::min(worst, measure(base, p));
    return worst;
}

/// The point nearest to the origin of the convex hull (Gilbert's algorithm): along it all of the gradients
/// rise.
Point shortest_combination(const std::vector<Point>& gradients) {
    Point nearest = gradients.front();
    for (int round = 0; round < 50; ++round) {
        const auto lowest =
            std::min_element(gradients.begin(), gradients.end(),
                             [&](const Point& a, const Point& b) { return a.dot(nearest) < b.dot(nearest); });
        const Point to = *lowest - nearest;
        const double gap = -to.dot(nearest);
        if (gap <= 1e-3 * nearest.squaredNorm()) break;
        nearest += std::min(1.0, gap / to.squaredNorm()) * to;
    }
    return nearest;
}

/// A way to go, and how far until, by the gradients, another cell becomes the worst.
struct Ascent {
    Point direction;
    double length;
};

std::optional<Ascent> ascent(const std::vector<GammaAt>& cells, double reach) {
    const double worst = std::min_element(cells.begin(), cells.end(), [](auto& a, auto& b) {
                             return a.value < b.value;
                         })->value;
    std::vector<Point> active;
    for (const GammaAt& cell : cells)
        if (cell.value <= worst + active_margin) active.push_back(cell.gradient);
    const Point direction = shortest_combination(active);
    const double rise = direction.squaredNorm();
    if (!(std::sqrt(rise) * reach > least_gain)) return std::nullopt;

    double length = reach / std::sqrt(rise);
    for (const GammaAt& cell : cells) {
        const double slower = rise - cell.gradient.dot(direction);
        if (cell.value > worst + active_margin && slower > 0)
            length = std::min(length, (cell.value - worst) / slower);
    }
    return Ascent{direction, length};
}

/// What binds a vertex: nothing, or surfaces with a projector.
struct Constraint {
    const Surfaces& surfaces;
    const volmesh::Projector* projector;

    std::optional<Point> nearest(const Point& p) const {
        return surfaces.empty() ? p : projector->project({surfaces.data(), surfaces.size()}, p);
    }

    /// The derivative of nearest() at a point that obeys, by differences: takes gradients into the tangent
    /// space. Nothing where the point doesn't obey, or the surfaces have no tangent there.
    std::optional<Eigen::Matrix3d> tangent(const Point& p, double reach) const {
        if (surfaces.empty()) return Eigen::Matrix3d::Identity();
        const double step = 1e-3 * reach;
        const auto at = nearest(p);
        if (!at || (*at - p).norm() > 1e-2 * step) return std::nullopt;
        Eigen::Matrix3d result;
        for (int k = 0; k < 3; ++k) {
            const auto there = nearest(p + step * Point::Unit(k));
            if (!there) return std::nullopt;
            result.col(k) = (*there - *at) / step;
        }
        return result;
    }
};

/// A better place for a vertex whose cells have these bases, if there is one.
std::optional<Point> better_place(const Bases& bases, const Point& start, const Constraint& constraint) {
    double reach = std::numeric_limits<double>::infinity();
    for (const Base& base : bases)
        for (const Point& q : base) reach = std::min(reach, (q - start).norm());
    const auto tangent = constraint.tangent(start, reach);
    if (!tangent) return std::nullopt;

    const double at_start = least(bases, start, gamma_at);
    Point place = start;
    double worst = at_start;
    std::vector<GammaAt> cells;
    for (int step = 0; step < max_steps; ++step) {
        cells.clear();
        for (const Base& base : bases) {
            cells.push_back(gamma_and_gradient(base, place));
            cells.back().gradient = *tangent * cells.back().gradient;
        }
        const auto way = ascent(cells, reach);
        if (!way) break;
        const double before = worst;
        for (double part = 1; part > std::ldexp(1.0, -max_halvings) && worst == before; part /= 2) {
            const auto tried = constraint.nearest(place + part * way->length * way->direction);
            if (!tried) continue;
            if (const double found = least(bases, *tried, gamma_at); found > worst) {
                worst = found;
                place = *tried;
            }
        }
        if (worst - before < least_gain) break;
    }
    if (worst - at_start < least_gain) return std::nullopt;
    if (least(bases, place, sigma_at) < least(bases, start, sigma_at)) return std::nullopt;
    return place;
}

Bases bases_at(const TetMesh& mesh, VertexHandle v, const volmesh::CellList& cells) {
    Bases bases;
    for (CellHandle c : cells) {
        const auto face = mesh.halfface_vertices(TetMesh::halfface(c, mesh.local_vertex(c, v)));
        bases.push_back({mesh.point(face[0]), mesh.point(face[1]), mesh.point(face[2])});
    }
    return bases;
}

double least_gamma(const TetMesh& mesh) {
    double worst = 1;
    for (std::uint32_t i = 0; i < mesh.n_cells(); ++i) {
        if (mesh.is_deleted(CellHandle(i))) continue;
        const auto p = mesh.cell_points(CellHandle(i));
        worst = std::min(worst, gamma(tet_geometry(p[0], p[1], p[2], p[3])));
    }
    return worst;
}

}  // namespace

ImproveResult improve(TetMesh& mesh, const ImproveOptions& options, const volmesh::Projector* projector) {
    ImproveResult result;
    result.worst_before = least_gamma(mesh);
    const std::vector<Freedom> freedom = freedoms(mesh, projector);
    // Vertices to visit: a vertex whose cells haven't changed since its last visit has nowhere better to go.
    std::vector<char> is_due(mesh.n_vertices(), 1);
    for (bool has_moved = true; has_moved && result.passes < options.max_passes; ++result.passes) {
        has_moved = false;
        for (std::uint32_t i = 0; i < mesh.n_vertices(); ++i) {
            const VertexHandle v(i);
            if (freedom[i].is_fixed || !is_due[i]) continue;
            is_due[i] = 0;
            const volmesh::CellList cells = mesh.vc_range(v);
            const Bases bases = bases_at(mesh, v, cells);
            if (bases.empty() || least(bases, mesh.point(v), gamma_at) >= options.good_enough) continue;
            const auto place = better_place(bases, mesh.point(v), {freedom[i].surfaces, projector});
            if (!place) continue;
            mesh.set_point(v, *place);
            has_moved = true;
            ++result.moves;
            for (CellHandle c : cells)
                for (VertexHandle w : mesh.cell_vertices(c)) is_due[w.idx()] = 1;
        }
    }
    result.worst_after = least_gamma(mesh);
    return result;
}

}  // namespace maille::quality
