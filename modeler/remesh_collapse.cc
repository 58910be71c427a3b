#include <algorithm>
#include <queue>
#include <utility>

#include "modeler/remesh_changes.hh"
#include "modeler/remesh_check.hh"
#include "modeler/remesh_passes.hh"

namespace maille::modeler::remeshing {

namespace {

constexpr double too_short = 0.6;  // of the wanted length
constexpr double too_long = 1.4;

struct Edge {
    double length;
    Index a;
    Index b;
    auto operator<=>(const Edge&) const = default;
};

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
