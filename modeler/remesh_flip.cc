#include <algorithm>
#include <utility>

#include "modeler/remesh_check.hh"
#include "modeler/remesh_passes.hh"

namespace maille::modeler::remeshing {

namespace {

constexpr int most_sweeps = 6;
constexpr double least_gain = 1e-6;

/// The edge a-b turned within its two triangles.
Change flip(const Net& net, Index a, Index b) {
    Change change;
    change.removed = net.triangles_at(a, b);
    const Triangle& first = net.triangle(change.removed[0]);
    const Triangle& second = net.triangle(change.removed[1]);
    const Index c = apex(first, a, b);
    const Index d = apex(second, a, b);
    change.added = {replaced(first, a, d), replaced(first, b, d)};
    change.swept.push_back({net.point(a), net.point(b), net.point(c), net.point(d)});
    return change;
}

bool try_flip(Session& session, Index a, Index b) {
    const Net& net = session.net;
    const auto sides = net.triangles_at(a, b);
    if (sides.size() != 2 || worst_quality(net, sides) > 0.8 || net.is_feature(a, b)) return false;
    if (net.has_edge(apex(net.triangle(sides[0]), a, b), apex(net.triangle(sides[1]), a, b))) return false;
    return try_change(session, flip(net, a, b), worst_quality(net, sides) + least_gain);
}

}  // namespace

std::size_t flip_edges(Session& session) {
    std::size_t done = 0;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        const std::uint64_t since = std::exchange(session.flipped, session.net.now());
        std::size_t flips = 0;
        for (const auto& [a, b] : session.net.edges())
            if (session.net.touched(a) >= since && session.net.touched(b) >= since && try_flip(session, a, b))
                ++flips;
        done += flips;
        if (flips == 0) break;
    }
    session.report.flips += done;
    return done;
}

}  // namespace maille::modeler::remeshing
