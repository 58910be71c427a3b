#include <algorithm>
#include <queue>
#include <utility>

#include <Eigen/Geometry>

#include "modeler/remesh_check.hh"
#include "modeler/remesh_features.hh"
#include "modeler/remesh_passes.hh"

namespace maille::modeler::remeshing {

namespace {

constexpr double too_long = 1.4;        // of the wanted length
constexpr double chord_reach = 0.5;     // of the edge's length: no surface is further from its middle
constexpr double least_distance = 0.2;  // of the wanted length: of a new vertex from those across
constexpr double worth_halving = 0.05;  // quality: halves of worse triangles are worse still
constexpr double flat_triangle = 0.35;  // height over longest edge

/// Both halves of every triangle at the edge, with v in the middle.
void halve(const Net& net, Index a, Index b, Index v, Change& change) {
    for (const Index t : net.triangles_at(a, b)) {
        change.removed.push_back(t);
        change.added.push_back(replaced(net.triangle(t), a, v));
        change.added.push_back(replaced(net.triangle(t), b, v));
    }
}

double wanted_size(const Session& session, std::span<const Index> triangles, const Vec3& p) {
    double size = std::numeric_limits<double>::infinity();
    for (const Index t : triangles)
        size =
            std::min(size, session.geometry.size(p, session.net.patch(t).front, session.net.patch(t).back));
    return size;
}

VertexKind kind_on_edge(const Session& session, Index a, Index b, std::span<const std::uint32_t> surfaces,
                        const Vec3& p) {
    return session.net.is_feature(a, b) ? curve_kind(session.geometry, surfaces, p) : VertexKind::face;
}

/// Whether a vertex there comes too close to one across the edge. Halving such flat triangles makes ever more
/// of them.
bool crowds_an_apex(const Net& net, Index a, Index b, const Vec3& p) {
    const double least = least_distance * std::min(net.length(a, b), net.wanted_length(a, b));
    return std::ranges::any_of(net.triangles_at(a, b), [&](Index t) {
        return (net.point(apex(net.triangle(t), a, b)) - p).norm() < least;
    });
}

bool try_split(Session& session, Index a, Index b) {
    Net& net = session.net;
    const auto sides = net.triangles_at(a, b);
    const auto surfaces = net.surfaces(sides);
    const Vec3 middle = (net.point(a) + net.point(b)) / 2;
    const VertexKind kind = kind_on_edge(session, a, b, surfaces, middle);
    const auto target = nearest(session, surfaces, kind, middle, chord_reach * net.length(a, b));
    if (!target || crowds_an_apex(net, a, b, *target)) return false;

    const double size = std::min(wanted_size(session, sides, *target), net.wanted_length(a, b));
    Change change;
    change.moved = net.add_vertex(middle, kind, size);
    change.position = *target;
    halve(net, a, b, change.moved, change);
    for (const Index t : sides) {
        const auto [p, q, r] = net.corners(t);
        change.swept.push_back({p, q, r, *target});
    }
    if (try_change(session, change, 0)) return true;
    net.drop_last_vertex();
    return false;
}

/// The triangle's longest edge, and the vertex across.
std::array<Index, 3> longest_edge(const Net& net, const Triangle& triangle) {
    std::array<Index, 3> best{};
    double longest = -1;
    for (std::size_t i = 0; i < 3; ++i) {
        const Index a = triangle.vertices[i];
        const Index b = triangle.vertices[(i + 1) % 3];
        if (net.length(a, b) <= longest) continue;
        longest = net.length(a, b);
        best = {a, b, triangle.vertices[(i + 2) % 3]};
    }
    return best;
}

bool try_snap(Session& session, Index t) {
    Net& net = session.net;
    const auto [a, b, u] = longest_edge(net, net.triangle(t));
    if (net.kind(u) != VertexKind::face || !net.is_feature(a, b)) return false;
    const Vec3 along = net.point(b) - net.point(a);
    const Vec3 foot = net.point(a) + along * along.dot(net.point(u) - net.point(a)) / along.squaredNorm();
    if ((foot - net.point(u)).norm() > flat_triangle * along.norm()) return false;

    const auto sheets = net.triangles_at(a, b);
    for (const Index sheet : sheets)
        if (sheet != t && net.has_edge(u, apex(net.triangle(sheet), a, b))) return false;
    const auto surfaces = net.surfaces(sheets);
    const VertexKind kind = kind_on_edge(session, a, b, surfaces, foot);
    const auto target = nearest(session, surfaces, kind, foot, chord_reach * along.norm());
    if (!target) return false;

    Change change;
    change.moved = u;
    change.position = *target;
    halve(net, a, b, u, change);
    for (const Index other : net.triangles_at(u))
        if (other != t) {
            change.removed.push_back(other);
            change.added.push_back(net.triangle(other));
        }
    for (const Index old : change.removed) {
        const auto [p, q, r] = net.corners(old);
        change.swept.push_back({p, q, r, *target});
    }
    // The flat triangle itself has no halves.
    std::erase_if(change.added, [](const Triangle& triangle) {
        const auto& [p, q, r] = triangle.vertices;
        return p == q || q == r || r == p;
    });
    if (!try_change(session, change, std::min(worst_quality(net, change.removed) + 0.01, session.good)))
        return false;
    net.set_kind(u, kind);
    return true;
}

}  // namespace

std::size_t split_edges(Session& session) {
    // Curves first: their new vertices need room to move off the chord.
    struct Edge {
        bool is_feature;
        double excess;
        Index a;
        Index b;
        auto operator<=>(const Edge&) const = default;
    };
    const Net& net = session.net;
    std::priority_queue<Edge> queue;
    const auto consider = [&](Index a, Index b) {
        const double excess = net.length(a, b) / net.wanted_length(a, b);
        if (excess > too_long) queue.push({net.is_feature(a, b), excess, std::min(a, b), std::max(a, b)});
    };
    for (const auto& [a, b] : net.edges()) consider(a, b);

    std::size_t done = 0;
    while (!queue.empty()) {
        const auto [is_feature, excess, a, b] = queue.top();
        queue.pop();
        if (!net.has_edge(a, b) ||
            (!is_feature && worst_quality(net, net.triangles_at(a, b)) < worth_halving))
            continue;
        if (!try_split(session, a, b)) continue;
        ++done;
        const Index middle = net.n_vertices() - 1;
        for (const Index x : net.neighbours(middle)) consider(middle, x);
    }
    session.report.splits += done;
    return done;
}

std::size_t snap_to_curves(Session& session) {
    const Net& net = session.net;
    const std::uint64_t since = std::exchange(session.snapped, net.now());
    const auto is_touched = [&](Index v) { return net.touched(v) >= since; };
    std::size_t done = 0;
    for (Index t = 0; t < net.n_triangles(); ++t)
        if (net.is_alive(t) && std::ranges::any_of(net.triangle(t).vertices, is_touched) &&
            quality(net.corners(t)) < session.good && try_snap(session, t))
            ++done;
    session.report.snaps += done;
    return done;
}

}  // namespace maille::modeler::remeshing
