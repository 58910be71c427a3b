#include "modeler/remesh_check.hh"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <boost/container/small_vector.hpp>

#include "modeler/remesh_exact.hh"

namespace maille::modeler::remeshing {

namespace {

// Cosines between a triangle's normal and that of its surface.
constexpr double least_agreement_curved = 0.6;
constexpr double least_agreement_planar = 0.9;

PlacedTriangle placed(const Net& net, Index t) {
    return {net.triangle(t).vertices, net.corners(t)};
}

PlacedTriangle placed(const Net& net, const Change& change, const Triangle& triangle) {
    PlacedTriangle result{triangle.vertices, {}};
    for (std::size_t i = 0; i < 3; ++i) {
        const Index v = triangle.vertices[i];
        result.corners[i] = v == change.moved ? change.position : net.point(v);
    }
    return result;
}

/// The area of the triangle if it points another way than its surface, else 0.
double wrong_area(const Session& session, const Patch& patch, const Corners& corners) {
    const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double twice_area = normal.norm();
    const Vec3 centroid = (corners[0] + corners[1] + corners[2]) / 3;
    const double along = patch.sense * normal.dot(session.geometry.normal(patch.surface, centroid));
    const double least = patch.planar ? least_agreement_planar : least_agreement_curved;
    return along < least * twice_area ? twice_area / 2 : 0;
}

double wrong_area(const Session& session, const std::vector<PlacedTriangle>& added, const Change& change) {
    double sum = 0;
    for (std::size_t i = 0; i < added.size(); ++i)
        sum += wrong_area(session, session.net.patch(change.added[i]), added[i].corners);
    return sum;
}

double wrong_area_before(const Session& session, const Change& change) {
    double sum = 0;
    for (const Index t : change.removed)
        sum += wrong_area(session, session.net.patch(t), session.net.corners(t));
    return sum;
}

using Rim = boost::container::small_vector<std::array<Index, 2>, 48>;

/// The edges of the triangles that have no other one on their other side, as the triangles run.
template <class Triangles>
Rim rim_of(const Triangles& triangles) {
    Rim rim;
    for (const Triangle& t : triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::array<Index, 2> edge{t.vertices[i], t.vertices[(i + 1) % 3]};
            const auto back = std::ranges::find(rim, std::array{edge[1], edge[0]});
            if (back == rim.end())
                rim.push_back(edge);
            else
                rim.erase(back);
        }
    std::ranges::sort(rim);
    return rim;
}

/// Whether all is within one planar patch and the rim stays. Where the new triangles all point the right way,
/// they then cover what the old ones did, each place once, and meet nothing that these didn't.
bool keeps_its_rim(const Net& net, const Change& change) {
    const Index patch = net.triangle(change.removed.front()).patch;
    if (!net.patch(change.removed.front()).planar) return false;
    const auto is_elsewhere = [&](const Triangle& t) { return t.patch != patch; };
    boost::container::small_vector<Triangle, 16> removed;
    for (const Index t : change.removed) removed.push_back(net.triangle(t));
    if (std::ranges::any_of(removed, is_elsewhere) || std::ranges::any_of(change.added, is_elsewhere))
        return false;
    const Rim rim = rim_of(removed);
    const auto is_moved = [&](const auto& edge) { return edge[0] == change.moved; };
    return std::ranges::none_of(rim, is_moved) && rim == rim_of(change.added);
}

/// Triangles that all point the way of their plane fill it like a map: while their common rim stays they
/// cannot overlap, and the exact tests, slow within a plane, are not needed.
bool in_one_plane(const Patch& a, const Patch& b) {
    return a.planar && a.surface == b.surface;
}

bool meets_a_neighbour(const Net& net, const std::vector<PlacedTriangle>& added, const Change& change) {
    std::vector<Index> nearby;
    for (std::size_t i = 0; i < added.size(); ++i) {
        nearby.clear();
        net.tree().collect(added[i].corners, nearby);
        for (const Index t : nearby) {
            if (in_one_plane(net.patch(change.added[i]), net.patch(t)) ||
                std::ranges::find(change.removed, t) != change.removed.end())
                continue;
            if (collide(added[i], placed(net, t))) return true;
        }
    }
    return false;
}

bool meet_each_other(const Net& net, const std::vector<PlacedTriangle>& added, const Change& change) {
    for (std::size_t i = 0; i < added.size(); ++i)
        for (std::size_t j = i + 1; j < added.size(); ++j) {
            if (in_one_plane(net.patch(change.added[i]), net.patch(change.added[j]))) continue;
            if (collide(added[i], added[j])) return true;
        }
    return false;
}

bool is_flat(const std::array<Vec3, 4>& t) {
    const Vec3 a = t[1] - t[0];
    const Vec3 b = t[2] - t[0];
    const Vec3 c = t[3] - t[0];
    return std::abs(a.dot(b.cross(c))) <= 1e-12 * a.norm() * b.norm() * c.norm();
}

/// A loose piece of surface could lie wholly in what the sheets sweep over; then it has a vertex there.
bool sweeps_over_a_vertex(const Net& net, const Change& change) {
    const auto takes_part = [&](Index v) {
        return v == change.moved ||
               std::ranges::any_of(change.removed, [&](Index t) { return contains(net.triangle(t), v); });
    };
    std::vector<Index> nearby;
    for (const auto& tetrahedron : change.swept) {
        if (is_flat(tetrahedron)) continue;
        Eigen::AlignedBox3d box;
        for (const Vec3& p : tetrahedron) box.extend(p);
        nearby.clear();
        net.tree().collect(box, nearby);
        for (const Index t : nearby)
            for (const Index v : net.triangle(t).vertices)
                if (box.contains(net.point(v)) && !takes_part(v) && is_inside(tetrahedron, net.point(v)))
                    return true;
    }
    return false;
}

/// Triangles with the same vertices are one sheet twice. In a plane no other test tells.
bool doubles_a_triangle(const Net& net, const Change& change) {
    const auto sorted = [](std::array<Index, 3> v) {
        std::ranges::sort(v);
        return v;
    };
    // Where a vertex only moves, its triangles are the same.
    if (std::ranges::equal(change.added, change.removed, {}, &Triangle::vertices,
                           [&](Index t) { return net.triangle(t).vertices; }))
        return false;
    std::vector<std::array<Index, 3>> seen;
    for (const Triangle& triangle : change.added) {
        const auto key = sorted(triangle.vertices);
        if (std::ranges::find(seen, key) != seen.end()) return true;
        seen.push_back(key);
        for (const Index t : net.triangles_at(triangle.vertices[0]))
            if (sorted(net.triangle(t).vertices) == key &&
                std::ranges::find(change.removed, t) == change.removed.end())
                return true;
    }
    return false;
}

}  // namespace

double quality(const Corners& corners) {
    const auto& [a, b, c] = corners;
    const double ab = (b - a).squaredNorm();
    const double bc = (c - b).squaredNorm();
    const double ca = (a - c).squaredNorm();
    const double shortest = std::min({ab, bc, ca});
    // The smallest angle lies between the two longer edges.
    const double product = shortest == ab ? bc * ca : shortest == bc ? ab * ca : ab * bc;
    return product == 0 ? 0 : (b - a).cross(c - a).norm() / std::sqrt(product);
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double t = std::clamp(along.dot(p - a) / along.squaredNorm(), 0.0, 1.0);
    return (a + t * along - p).norm();
}

double worst_quality(const Net& net, std::span<const Index> triangles) {
    double worst = 1;
    for (const Index t : triangles) worst = std::min(worst, quality(net.corners(t)));
    return worst;
}

double worst_quality(const Net& net, const Change& change) {
    double worst = 1;
    for (const Triangle& triangle : change.added)
        worst = std::min(worst, quality(placed(net, change, triangle).corners));
    return worst;
}

bool try_change(Session& session, const Change& change, double least_quality) {
    Net& net = session.net;
    if (std::ranges::any_of(change.removed, [&](Index t) { return net.patch(t).frozen; })) return false;
    std::vector<PlacedTriangle> added;
    added.reserve(change.added.size());
    for (const Triangle& triangle : change.added) {
        added.push_back(placed(net, change, triangle));
        if (quality(added.back().corners) < least_quality) return false;
    }
    // What comes in wrong may stay so for a while.
    const double wrong = wrong_area(session, added, change);
    if (wrong > 0 && wrong > wrong_area_before(session, change)) return false;
    if (doubles_a_triangle(net, change)) return false;
    for (const PlacedTriangle& triangle : added)
        if (quality(triangle.corners) < 1e-12 && has_no_area(triangle.corners)) return false;
    if (wrong == 0 && keeps_its_rim(net, change)) {
        net.apply(change);
        return true;
    }
    if (meets_a_neighbour(net, added, change) || meet_each_other(net, added, change)) return false;
    if (sweeps_over_a_vertex(net, change)) return false;
    net.apply(change);
    return true;
}

}  // namespace maille::modeler::remeshing
