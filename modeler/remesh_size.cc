#include <algorithm>
#include <map>
#include <queue>

#include <Eigen/Geometry>

#include "modeler/remesh_check.hh"
#include "modeler/remesh_passes.hh"

namespace maille::modeler::remeshing {

namespace {

constexpr double growth = 0.4;        // of the size, over a distance of one
constexpr double sizes_in_gap = 1.5;  // the size, in widths of a gap between sheets
constexpr double sizes_in_strip = 2;  // and of a strip between curves
constexpr double least_facing = 0.5;  // cosine of the angle between a normal and the way across a gap
// Curves are close to each other where the way along them is so many times the one across.
constexpr double least_detour = 5;

/// The point of the triangle that is nearest to p (Ericson, Real-Time Collision Detection, section 5.1.5).
Vec3 nearest_on_triangle(const Corners& corners, const Vec3& p) {
    const auto& [a, b, c] = corners;
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const double d1 = ab.dot(p - a);
    const double d2 = ac.dot(p - a);
    if (d1 <= 0 && d2 <= 0) return a;
    const double d3 = ab.dot(p - b);
    const double d4 = ac.dot(p - b);
    if (d3 >= 0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
    const double d5 = ab.dot(p - c);
    const double d6 = ac.dot(p - c);
    if (d6 >= 0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const double sum = va + vb + vc;
    return a + ab * (vb / sum) + ac * (vc / sum);
}

/// The region on the side of the triangle that the direction points to, if it does so steeply enough.
std::optional<Region> region_towards(const Net& net, Index t, const Vec3& direction) {
    const auto [a, b, c] = net.corners(t);
    const Vec3 normal = (b - a).cross(c - a);
    const double along = normal.dot(direction);
    if (std::abs(along) < least_facing * normal.norm() * direction.norm()) return std::nullopt;
    return along > 0 ? net.patch(t).front : net.patch(t).back;
}

/// Whether v and the triangle face each other across a region that is to be meshed.
bool face_each_other(const Net& net, Index v, Index t, const Vec3& from_v_to_t) {
    const auto region = region_towards(net, t, -from_v_to_t);
    return region && *region != outside && std::ranges::all_of(net.triangles_at(v), [&](Index own) {
               return region_towards(net, own, from_v_to_t) == region;
           });
}

/// The width of the gap between v and other sheets, up to `reach`. Those that meet in a curve beside v make
/// no gap.
double gap_to_sheets(const Net& net, Index v, std::span<const Index> nearby, double reach) {
    const auto next = net.neighbours(v);
    const auto is_next = [&](Index w) { return w == v || std::ranges::binary_search(next, w); };
    double gap = reach;
    for (const Index t : nearby) {
        if (std::ranges::any_of(net.triangle(t).vertices, is_next)) continue;
        const Vec3 to_sheet = nearest_on_triangle(net.corners(t), net.point(v)) - net.point(v);
        const double distance = to_sheet.norm();
        if (distance > 0 && distance < gap && face_each_other(net, v, t, to_sheet)) gap = distance;
    }
    return gap;
}

/// The way from v to other vertices along feature edges, as far as `reach`.
std::map<Index, double> ways_along_curves(const Net& net, Index v, double reach) {
    std::map<Index, double> ways;
    std::priority_queue<std::pair<double, Index>, std::vector<std::pair<double, Index>>, std::greater<>>
        queue;
    queue.push({0, v});
    while (!queue.empty()) {
        const auto [way, w] = queue.top();
        queue.pop();
        if (!ways.try_emplace(w, way).second) continue;
        for (const Index x : net.feature_neighbours(w))
            if (way + net.length(w, x) <= reach) queue.push({way + net.length(w, x), x});
    }
    return ways;
}

/// The width of the strip between v, on a curve, and other curves, or distant parts of its own; up to
/// `reach`.
double gap_to_curves(const Net& net, Index v, std::span<const Index> nearby, double reach) {
    const auto ways = ways_along_curves(net, v, least_detour * reach);
    const auto is_detour = [&](Index w, double distance) {
        const auto found = ways.find(w);
        return found == ways.end() || found->second > least_detour * distance;
    };
    double gap = reach;
    for (const Index t : nearby)
        for (std::size_t i = 0; i < 3; ++i) {
            const Index a = net.triangle(t).vertices[i];
            const Index b = net.triangle(t).vertices[(i + 1) % 3];
            const double distance = distance_to_segment(net.point(v), net.point(a), net.point(b));
            if (distance < gap && is_detour(a, distance) && is_detour(b, distance) && net.is_feature(a, b))
                gap = distance;
        }
    return gap;
}

/// The size that suits the sheets and curves close to v, at most the one wanted.
double size_in_gaps(const Net& net, Index v, double wanted) {
    const double reach = wanted / std::min(sizes_in_gap, sizes_in_strip);
    const Vec3& p = net.point(v);
    std::vector<Index> nearby;
    net.grid().collect(Eigen::AlignedBox3d(p - Vec3::Constant(reach), p + Vec3::Constant(reach)), nearby);
    double size = std::min(wanted, sizes_in_gap * gap_to_sheets(net, v, nearby, reach));
    if (net.kind(v) != VertexKind::face)
        size = std::min(size, sizes_in_strip * gap_to_curves(net, v, nearby, reach));
    return size;
}

double wanted_size(const Session& session, Index v) {
    double size = std::numeric_limits<double>::infinity();
    for (const Index t : session.net.triangles_at(v)) {
        const Patch& patch = session.net.patch(t);
        size = std::min(size, session.geometry.size(session.net.point(v), patch.front, patch.back));
    }
    return size;
}

/// The mean length of the frozen edges at v; 0 where there is none.
double frozen_size(const Net& net, Index v) {
    double sum = 0;
    int count = 0;
    for (const Index t : net.triangles_at(v)) {
        if (!net.patch(t).frozen) continue;
        for (const Index w : net.triangle(t).vertices)
            if (w != v) {
                sum += net.length(v, w);
                ++count;
            }
    }
    return count == 0 ? 0 : sum / count;
}

/// Lets no size be more than the smallest one beside it and the growth over the distance (Dijkstra).
void limit_growth(Net& net) {
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (Index v = 0; v < net.n_vertices(); ++v)
        if (!net.triangles_at(v).empty()) queue.push({net.size(v), v});
    while (!queue.empty()) {
        const auto [size, v] = queue.top();
        queue.pop();
        if (size > net.size(v)) continue;
        for (const Index w : net.neighbours(v)) {
            const double most = size + growth * net.length(v, w);
            if (most >= net.size(w)) continue;
            net.set_size(w, most);
            queue.push({most, w});
        }
    }
}

}  // namespace

void set_sizes(Session& session) {
    Net& net = session.net;
    for (Index v = 0; v < net.n_vertices(); ++v) {
        if (net.triangles_at(v).empty()) continue;
        double size = frozen_size(net, v);
        if (size == 0) {
            const double wanted = wanted_size(session, v);
            size = std::max(session.options.smallest_gap * wanted, size_in_gaps(net, v, wanted));
        }
        net.set_size(v, size);
    }
    limit_growth(net);
}

}  // namespace maille::modeler::remeshing
