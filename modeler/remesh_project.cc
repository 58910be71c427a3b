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

bool is_frozen(const Net& net, Index v) {
    return std::ranges::any_of(net.triangles_at(v), [&](Index t) { return net.patch(t).frozen; });
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
    const auto try_move = [&](const Vec3& target) {
        const Change change = move(net, v, target);
        const double before = worst_quality(net, change.removed);
        return try_change(session, change, std::min(before, least_after_projection));
    };
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
    if (net.triangles_at(v).empty() || is_frozen(net, v)) return std::nullopt;
    auto target = place_on_surfaces(session, v, net.point(v));
    // Ten times the tolerance of the moves: projecting again rounds again.
    if (target && (*target - net.point(v)).norm() <= 10 * on_surface * net.size(v)) return std::nullopt;
    return target;
}

/// Draws v onto a neighbour that is where it has to go itself: between them there is nothing but what flat
/// triangles make of surfaces that touch, and curves on either side of that become one.
bool try_closing(Session& session, Index v) {
    Net& net = session.net;
    const auto target = place_to_reach(session, v);
    if (!target || net.kind(v) == VertexKind::corner) return false;
    for (const Index w : net.neighbours(v)) {
        if ((net.point(w) - *target).norm() > same_place * net.size(v) || !are_linked(net, v, w)) continue;
        const Change change = collapse(net, v, w);
        if (!try_change(session, change,
                        std::min(worst_quality(net, change.removed), least_after_projection)))
            continue;
        net.set_kind(w, VertexKind::corner);
        return true;
    }
    return false;
}

/// Whether w, at p, is no farther from where it belongs than `way` once the change is done: drawn together,
/// two vertices may come to lie on surfaces that have no common point there.
bool brings_near(const Session& session, const Change& change, Index w, const Vec3& p, double way) {
    const Net& net = session.net;
    std::vector<std::uint32_t> surfaces;
    for (const Triangle& t : change.added)
        if (contains(t, w)) surfaces.push_back(net.patch(t).surface);
    for (const Index t : net.triangles_at(w))
        if (std::ranges::find(change.removed, t) == change.removed.end())
            surfaces.push_back(net.patch(t).surface);
    std::ranges::sort(surfaces);
    surfaces.erase(std::ranges::unique(surfaces).begin(), surfaces.end());
    const auto place = nearest(session, surfaces, net.kind(w), p, projection_reach * net.size(w));
    return place && (*place - p).norm() <= way;
}

/// Draws a neighbour that is in the way onto v, which goes where it has to; or leaves v out, if nothing ends
/// there; or else draws what is nearer to that place than v onto it, to make room.
bool try_clearing(Session& session, Index v) {
    const Net& net = session.net;
    const auto target = place_to_reach(session, v);
    if (!target) return false;
    std::vector<Index> others = net.neighbours(v);
    std::ranges::stable_sort(others, {}, [&](Index u) { return (net.point(u) - *target).norm(); });
    const double way = (net.point(v) - *target).norm();
    const auto try_drawing = [&](Index from, Index onto, const Vec3& place) {
        if (!keeps_topology(net, from, onto)) return false;
        const Change change = collapse(net, from, onto, place);
        return brings_near(session, change, onto, place, way) &&
               try_change(session, change,
                          std::min(worst_quality(net, change.removed), least_after_projection));
    };
    for (const Index u : others)
        if (try_drawing(u, v, *target)) return true;
    for (const Index w : others)
        if (try_drawing(v, w, net.point(w))) return true;
    for (const Index u : others)
        if ((net.point(u) - *target).norm() < way && try_drawing(u, v, net.point(v))) return true;
    return false;
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

std::size_t clear_ways(Session& session) {
    constexpr int most_sweeps = 20;
    const Net& net = session.net;
    std::size_t done = 0;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        const std::size_t before = done;
        for (Index v = 0; v < net.n_vertices(); ++v)
            if (place_to_reach(session, v) &&
                (try_projection(session, v) || try_closing(session, v) || try_clearing(session, v)))
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
        if (net.triangles_at(v).empty() || is_frozen(net, v)) continue;
        const auto target = place_on_surfaces(session, v, net.point(v));
        // Ten times the tolerance of the moves: projecting again rounds again.
        if (!target || (*target - net.point(v)).norm() > 10 * on_surface * net.size(v)) ++count;
    }
    return count;
}

}  // namespace maille::modeler::remeshing
