#include "modeler/remesh_changes.hh"

#include <algorithm>
#include <iterator>

#include "modeler/remesh_check.hh"

namespace maille::modeler::remeshing {

namespace {

// How far, in wanted lengths, a curve that nothing but its vertices define may be straightened; less among
// planes, where areas depend on it.
constexpr double straightening = 0.02;
constexpr double straightening_planar = 1e-9;

/// Whether a tangent curve stays where it is without its vertex u.
bool keeps_course(const Net& net, Index u, Index w) {
    const bool planar =
        std::ranges::all_of(net.triangles_at(u), [&](Index t) { return net.patch(t).planar; });
    const double tolerance = (planar ? straightening_planar : straightening) * net.size(u);
    return std::ranges::all_of(net.feature_neighbours(u), [&](Index end) {
        return end == w || distance_to_segment(net.point(u), net.point(end), net.point(w)) <= tolerance;
    });
}

/// The vertices across from the edge, rising.
std::vector<Index> apexes(const Net& net, Index u, Index w) {
    std::vector<Index> found;
    for (const Index t : net.triangles_at(u, w)) found.push_back(apex(net.triangle(t), u, w));
    std::ranges::sort(found);
    return found;
}

/// Draws u onto w, wherever that comes to be, within the triangles of both that are given.
Change drawn(const Net& net, Index u, Index w, std::vector<Index> triangles, const Vec3& to) {
    Change change;
    change.removed = std::move(triangles);
    for (const Index t : change.removed) {
        const bool vanishes = contains(net.triangle(t), u) && contains(net.triangle(t), w);
        if (!vanishes) change.added.push_back(replaced(net.triangle(t), u, w));
        const auto [a, b, c] = net.corners(t);
        if (!vanishes || to != net.point(w)) change.swept.push_back({a, b, c, to});
    }
    return change;
}

}  // namespace

std::vector<Index> neighbours_alike(const Net& net, Index v) {
    return net.kind(v) == VertexKind::curve ? net.feature_neighbours(v) : net.neighbours(v);
}

Vec3 middle(const Net& net, std::span<const Index> vertices) {
    Vec3 sum = Vec3::Zero();
    for (const Index w : vertices) sum += net.point(w);
    return sum / static_cast<double>(vertices.size());
}

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

bool are_linked(const Net& net, Index u, Index w) {
    std::vector<Index> common;
    std::ranges::set_intersection(net.neighbours(u), net.neighbours(w), std::back_inserter(common));
    return common == apexes(net, u, w);
}

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
    return are_linked(net, u, w) && std::ranges::none_of(apexes(net, u, w), [&](Index x) {
               return net.is_feature(u, x) && net.is_feature(w, x);
           });
}

Change collapse(const Net& net, Index u, Index w) {
    const auto at_u = net.triangles_at(u);
    return drawn(net, u, w, {at_u.begin(), at_u.end()}, net.point(w));
}

Change collapse(const Net& net, Index u, Index w, const Vec3& to) {
    const auto at_u = net.triangles_at(u), at_w = net.triangles_at(w);
    std::vector<Index> triangles(at_u.begin(), at_u.end());
    std::ranges::copy_if(at_w, std::back_inserter(triangles),
                         [&](Index t) { return !contains(net.triangle(t), u); });
    Change change = drawn(net, u, w, std::move(triangles), to);
    change.moved = w;
    change.position = to;
    return change;
}

}  // namespace maille::modeler::remeshing
