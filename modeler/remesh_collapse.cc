#include <algorithm>
#include <queue>
#include <utility>

#include "modeler/remesh_check.hh"
#include "modeler/remesh_passes.hh"

namespace maille::modeler::remeshing {

namespace {

constexpr double too_short = 0.6;  // of the wanted length
constexpr double too_long = 1.4;
// How far, in wanted lengths, a curve that nothing but its vertices define may be straightened; less among
// planes, where areas depend on it.
constexpr double straightening = 0.02;
constexpr double straightening_planar = 1e-9;

struct Edge {
    double length;
    Index a;
    Index b;
    auto operator<=>(const Edge&) const = default;
};

/// Whether a tangent curve stays where it is without its vertex u.
bool keeps_course(const Net& net, Index u, Index w) {
    const bool planar =
        std::ranges::all_of(net.triangles_at(u), [&](Index t) { return net.patch(t).planar; });
    const double tolerance = (planar ? straightening_planar : straightening) * net.size(u);
    return std::ranges::all_of(net.feature_neighbours(u), [&](Index end) {
        return end == w || distance_to_segment(net.point(u), net.point(end), net.point(w)) <= tolerance;
    });
}

/// Whether the complex keeps its topology when u is drawn onto w (the link condition, and that of the
/// curves).
bool keeps_topology(const Net& net, Index u, Index w) {
    switch (net.kind(u)) {
        case VertexKind::face:
            break;
        case VertexKind::curve:
            if (net.kind(w) == VertexKind::face || !net.is_feature(u, w)) return false;
            break;
        case VertexKind::tangent:
            if (net.kind(w) == VertexKind::face || !net.is_feature(u, w) || !keeps_course(net, u, w))
                return false;
            break;
        case VertexKind::corner:
            return false;
    }
    std::vector<Index> apexes;
    for (const Index t : net.triangles_at(u, w)) apexes.push_back(apex(net.triangle(t), u, w));
    std::ranges::sort(apexes);
    std::vector<Index> common;
    std::ranges::set_intersection(net.neighbours(u), net.neighbours(w), std::back_inserter(common));
    if (common != apexes) return false;
    return std::ranges::none_of(apexes,
                                [&](Index x) { return net.is_feature(u, x) && net.is_feature(w, x); });
}

Change collapse(const Net& net, Index u, Index w) {
    Change change;
    for (const Index t : net.triangles_at(u)) {
        change.removed.push_back(t);
        if (contains(net.triangle(t), w)) continue;
        change.added.push_back(replaced(net.triangle(t), u, w));
        const auto [a, b, c] = net.corners(t);
        change.swept.push_back({a, b, c, net.point(w)});
    }
    return change;
}

/// Whether no edge of w becomes longer than is wanted, or than one of u was.
bool keeps_lengths(const Net& net, Index u, Index w) {
    const auto ends = net.neighbours(u);
    double longest = 0;
    for (const Index x : ends) longest = std::max(longest, net.length(u, x));
    return std::ranges::all_of(ends, [&](Index x) {
        return x == w || net.length(w, x) <= std::max(longest, too_long * net.wanted_length(w, x));
    });
}

/// Draws u onto w if that may be. A short edge goes when its triangles do not become bad, or worse; any other
/// one only when they become better.
bool try_collapse(Session& session, Index u, Index w, bool is_short) {
    const Net& net = session.net;
    if (!keeps_topology(net, u, w) || !keeps_lengths(net, u, w)) return false;
    const Change change = collapse(net, u, w);
    const double before = worst_quality(net, change.removed);
    const double least =
        is_short ? std::min(before, session.tolerated) : std::min(before + 0.01, session.good);
    return try_change(session, change, least);
}

/// The edge, if it is too short or a side of a bad triangle.
std::optional<Edge> candidate(const Session& session, Index a, Index b) {
    const Net& net = session.net;
    const Edge edge{net.length(a, b), std::min(a, b), std::max(a, b)};
    if (edge.length < too_short * net.wanted_length(a, b)) return edge;
    if (edge.length < net.wanted_length(a, b) && worst_quality(net, net.triangles_at(a, b)) < session.good)
        return edge;
    return std::nullopt;
}

}  // namespace

std::size_t collapse_edges(Session& session) {
    const Net& net = session.net;
    std::priority_queue<Edge, std::vector<Edge>, std::greater<>> queue;
    const auto consider = [&](Index a, Index b) {
        if (const auto edge = candidate(session, a, b)) queue.push(*edge);
    };
    const std::uint64_t since = std::exchange(session.collapsed, net.now());
    for (const auto& [a, b] : net.edges())
        if (net.touched(a) >= since || net.touched(b) >= since) consider(a, b);

    std::size_t done = 0;
    while (!queue.empty()) {
        const auto [length, a, b] = queue.top();
        queue.pop();
        if (!net.has_edge(a, b)) continue;
        const bool is_short = length < too_short * net.wanted_length(a, b);
        const bool forward = net.kind(a) <= net.kind(b);
        const auto [u, w] = forward ? std::pair(a, b) : std::pair(b, a);
        Index kept = none;
        if (try_collapse(session, u, w, is_short))
            kept = w;
        else if (net.kind(u) == net.kind(w) && try_collapse(session, w, u, is_short))
            kept = u;
        if (kept == none) continue;
        ++done;
        for (const Index x : net.neighbours(kept)) consider(kept, x);
    }
    session.report.collapses += done;
    return done;
}

}  // namespace maille::modeler::remeshing
