#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "modeler/remesh_check.hh"
#include "modeler/remesh_features.hh"
#include "modeler/remesh_passes.hh"

namespace maille::modeler::remeshing {

namespace {

constexpr double on_surface = 1e-13;      // of the size
constexpr double projection_reach = 1.0;  // of the size: further away no surface is meant
constexpr double least_after_projection = 1e-3;
constexpr double smoothed = 0.6;  // triangles of this quality, an angle of 37 degrees, are left alone
constexpr double least_gain = 0.005;

/// The change that moves v, its triangles the same.
Change move(const Net& net, Index v, const Vec3& to) {
    Change change;
    change.moved = v;
    change.position = to;
    for (const Index t : net.triangles_at(v)) {
        change.removed.push_back(t);
        change.added.push_back(net.triangle(t));
        const auto [a, b, c] = net.corners(t);
        change.swept.push_back({a, b, c, to});
    }
    return change;
}

bool is_frozen(const Net& net, Index v) {
    return std::ranges::any_of(net.triangles_at(v), [&](Index t) { return net.patch(t).frozen; });
}

/// Where v belongs if it starts from p, or nothing where its surfaces have no common point near that.
std::optional<Vec3> place_on_surfaces(const Session& session, Index v, const Vec3& p) {
    const Net& net = session.net;
    return nearest(session, net.surfaces(net.triangles_at(v)), net.kind(v), p,
                   projection_reach * net.size(v));
}

Vec3 middle_of_neighbours(const Net& net, std::span<const Index> neighbours) {
    Vec3 sum = Vec3::Zero();
    for (const Index w : neighbours) sum += net.point(w);
    return sum / static_cast<double>(neighbours.size());
}

/// The neighbours of v; on a curve those along it.
std::vector<Index> neighbours_alike(const Net& net, Index v) {
    return net.kind(v) == VertexKind::curve ? net.feature_neighbours(v) : net.neighbours(v);
}

/// Moves v onto its surfaces where it isn't on them yet: to the nearest place, or to that nearest to the
/// middle of its neighbours where facets are in the way, or that place belongs to another branch of the
/// curve.
bool try_projection(Session& session, Index v) {
    const Net& net = session.net;
    const auto try_move = [&](const Vec3& target) {
        const Change change = move(net, v, target);
        const double before = worst_quality(net, change.removed);
        return try_change(session, change, std::min(before, least_after_projection));
    };
    const auto target = place_on_surfaces(session, v, net.point(v));
    if (!target || (*target - net.point(v)).norm() <= on_surface * net.size(v)) return false;
    if (try_move(*target)) return true;
    if (net.kind(v) == VertexKind::corner || net.kind(v) == VertexKind::tangent) return false;
    const auto other = place_on_surfaces(session, v, middle_of_neighbours(net, neighbours_alike(net, v)));
    return other && try_move(*other);
}

/// The mean of the places where v would make each of its triangles isosceles and as high as an equilateral
/// one.
Vec3 mean_of_ideal_apexes(const Net& net, Index v) {
    Vec3 sum = Vec3::Zero();
    const auto around = net.triangles_at(v);
    for (const Index t : around) {
        std::array<Vec3, 2> base;
        std::size_t n = 0;
        for (const Index w : net.triangle(t).vertices)
            if (w != v) base[n++] = net.point(w);
        const Vec3 along = base[1] - base[0];
        const Vec3 middle = (base[0] + base[1]) / 2;
        const Vec3 up =
            (net.point(v) - middle) - along * (along.dot(net.point(v) - middle) / along.squaredNorm());
        sum += middle + up.normalized() * along.norm() * std::sqrt(0.75);
    }
    return sum / static_cast<double>(around.size());
}

/// The worst quality of the triangles at v if that were there.
double worst_quality_at(const Net& net, Index v, const Vec3& to) {
    double worst = 1;
    for (const Index t : net.triangles_at(v)) {
        Corners corners = net.corners(t);
        for (std::size_t k = 0; k < 3; ++k)
            if (net.triangle(t).vertices[k] == v) corners[k] = to;
        worst = std::min(worst, quality(corners));
    }
    return worst;
}

bool try_smoothing(Session& session, Index v) {
    const Net& net = session.net;
    const VertexKind kind = net.kind(v);
    if (kind != VertexKind::face && kind != VertexKind::curve) return false;
    const double before = worst_quality(net, net.triangles_at(v));
    if (before > smoothed) return false;

    const auto surfaces = net.surfaces(net.triangles_at(v));
    const auto ends = neighbours_alike(net, v);
    std::optional<Vec3> best;
    double best_quality = before + least_gain;
    for (const Vec3& aim : {middle_of_neighbours(net, ends), mean_of_ideal_apexes(net, v)})
        for (const double step : {1.0, 0.5, 0.25}) {
            const Vec3 wanted = net.point(v) + step * (aim - net.point(v));
            // The projection is the dearest part, and changes the shapes little.
            if (worst_quality_at(net, v, wanted) <= best_quality) continue;
            const auto target = nearest(session, surfaces, kind, wanted, net.size(v));
            if (!target) continue;
            const double after = worst_quality_at(net, v, *target);
            if (after <= best_quality) continue;
            best_quality = after;
            best = target;
        }
    return best && try_change(session, move(net, v, *best), before);
}

}  // namespace

std::size_t project_vertices(Session& session) {
    const Net& net = session.net;
    std::size_t done = 0;
    for (Index v = 0; v < net.n_vertices(); ++v) {
        if (net.triangles_at(v).empty() || is_frozen(net, v)) continue;
        if (try_projection(session, v)) ++done;
    }
    session.report.projections += done;
    return done;
}

std::size_t smooth_vertices(Session& session) {
    const std::uint64_t since = std::exchange(session.smoothed, session.net.now());
    std::size_t done = 0;
    for (Index v = 0; v < session.net.n_vertices(); ++v)
        if (session.net.touched(v) >= since && !session.net.triangles_at(v).empty() &&
            try_smoothing(session, v))
            ++done;
    session.report.smoothings += done;
    return done;
}

std::size_t count_short_of_surface(const Session& session) {
    const Net& net = session.net;
    std::size_t count = 0;
    for (Index v = 0; v < net.n_vertices(); ++v) {
        if (net.triangles_at(v).empty() || is_frozen(net, v)) continue;
        const auto target = place_on_surfaces(session, v, net.point(v));
        // Ten times the tolerance of the moves: projecting again rounds again.
        if (!target || (*target - net.point(v)).norm() > 10 * on_surface * net.size(v)) ++count;
    }
    return count;
}

}  // namespace maille::modeler::remeshing
