#include <algorithm>

#include "modeler/remesh_changes.hh"
#include "modeler/remesh_check.hh"
#include "modeler/remesh_features.hh"
#include "modeler/remesh_passes.hh"

namespace maille::modeler::remeshing {

namespace {

constexpr double on_surface = 1e-13;      // of the size
constexpr double projection_reach = 1.0;  // of the size: further away no surface is meant
constexpr double least_after_projection = 1e-3;
constexpr double same_place = 1e-9;  // of the size

/// Whether the vertex is in use, and not frozen.
bool may_move(const Net& net, Index v) {
    const auto triangles = net.triangles_at(v);
    return !triangles.empty() &&
           std::ranges::none_of(triangles, [&](Index t) { return net.patch(t).frozen; });
}

/// Whether v is at the place, but for rounding. Ten times the tolerance of the moves: projecting again rounds
/// again.
bool is_at(const Net& net, Index v, const Vec3& place) {
    return (place - net.point(v)).norm() <= 10 * on_surface * net.size(v);
}

/// Makes the change unless it spoils triangles.
bool try_unspoilt(Session& session, const Change& change) {
    return try_change(session, change,
                      std::min(worst_quality(session.net, change.removed), least_after_projection));
}

/// Where v belongs if it starts from p, or nothing where its surfaces have no common point near that.
std::optional<Vec3> place_on_surfaces(const Session& session, Index v, const Vec3& p) {
    const Net& net = session.net;
    return nearest(session, net.surfaces(net.triangles_at(v)), net.kind(v), p,
                   projection_reach * net.size(v));
}

/// Moves v onto its surfaces where it isn't on them yet: to the nearest place, or to that nearest to the
/// middle of its neighbours where facets are in the way, or that place belongs to another branch of the
/// curve.
bool try_projection(Session& session, Index v) {
    const Net& net = session.net;
    const auto try_move = [&](const Vec3& target) { return try_unspoilt(session, move(net, v, target)); };
    const auto target = place_on_surfaces(session, v, net.point(v));
    if (!target || (*target - net.point(v)).norm() <= on_surface * net.size(v)) return false;
    if (try_move(*target)) return true;
    if (net.kind(v) == VertexKind::corner || net.kind(v) == VertexKind::tangent) return false;
    const auto other = place_on_surfaces(session, v, middle(net, neighbours_alike(net, v)));
    return other && try_move(*other);
}

/// Where v has still to go, if that is known.
std::optional<Vec3> place_to_reach(const Session& session, Index v) {
    const Net& net = session.net;
    if (!may_move(net, v)) return std::nullopt;
    const auto target = place_on_surfaces(session, v, net.point(v));
    return target && !is_at(net, v, *target) ? target : std::nullopt;
}

/// Draws v onto a neighbour that is at its target itself: between them there is nothing but what flat
/// triangles make of surfaces that touch, and curves on either side of that become one.
bool try_closing(Session& session, Index v, const Vec3& target) {
    Net& net = session.net;
    if (net.kind(v) == VertexKind::corner) return false;
    for (const Index w : net.neighbours(v)) {
        if ((net.point(w) - target).norm() > same_place * net.size(v) || !are_linked(net, v, w)) continue;
        if (!try_unspoilt(session, collapse(net, v, w))) continue;
        net.set_kind(w, VertexKind::corner);
        return true;
    }
    return false;
}

/// Whether u and w, drawn together at p, are no farther from where they belong then than `way`: they may come
/// to lie on surfaces that have no common point there.
bool belong_near(const Session& session, Index u, Index w, const Vec3& p, double way) {
    const Net& net = session.net;
    std::vector<Index> left;
    for (const Index t : net.triangles_at(u))
        if (!contains(net.triangle(t), w)) left.push_back(t);
    for (const Index t : net.triangles_at(w))
        if (!contains(net.triangle(t), u)) left.push_back(t);
    const auto place = nearest(session, net.surfaces(left), net.kind(w), p, projection_reach * net.size(w));
    return place && (*place - p).norm() <= way;
}

/// Draws a neighbour that is in the way onto v, which goes where it has to; or leaves v out, if nothing ends
/// there; or else draws what is nearer to that place than v onto it, to make room.
bool try_clearing(Session& session, Index v, const Vec3& target) {
    const Net& net = session.net;
    std::vector<Index> others = net.neighbours(v);
    std::ranges::stable_sort(others, {}, [&](Index u) { return (net.point(u) - target).norm(); });
    const double way = (net.point(v) - target).norm();
    const auto try_drawing = [&](Index from, Index onto, const Vec3& place) {
        return keeps_topology(net, from, onto) && belong_near(session, from, onto, place, way) &&
               try_unspoilt(session, collapse(net, from, onto, place));
    };
    for (const Index u : others)
        if (try_drawing(u, v, target)) return true;
    for (const Index w : others)
        if (try_drawing(v, w, net.point(w))) return true;
    for (const Index u : others)
        if ((net.point(u) - target).norm() < way && try_drawing(u, v, net.point(v))) return true;
    return false;
}

}  // namespace

std::size_t project_vertices(Session& session) {
    const Net& net = session.net;
    std::size_t done = 0;
    for (Index v = 0; v < net.n_vertices(); ++v)
        if (may_move(net, v) && try_projection(session, v)) ++done;
    session.report.projections += done;
    return done;
}

std::size_t clear_ways(Session& session) {
    constexpr int most_sweeps = 20;
    const Net& net = session.net;
    std::size_t done = 0;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        const std::size_t before = done;
        for (Index v = 0; v < net.n_vertices(); ++v)
            if (const auto target = place_to_reach(session, v);
                target && (try_projection(session, v) || try_closing(session, v, *target) ||
                           try_clearing(session, v, *target)))
                ++done;
        if (done == before) break;
    }
    session.report.clearings += done;
    return done;
}

std::size_t count_short_of_surface(const Session& session) {
    const Net& net = session.net;
    std::size_t count = 0;
    for (Index v = 0; v < net.n_vertices(); ++v) {
        if (!may_move(net, v)) continue;
        const auto target = place_on_surfaces(session, v, net.point(v));
        if (!target || !is_at(net, v, *target)) ++count;
    }
    return count;
}

}  // namespace maille::modeler::remeshing
