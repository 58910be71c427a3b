#include "modeler/remesh_features.hh"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

namespace maille::modeler::remeshing {

namespace {

// Surfaces that meet at a smaller angle than this (its sine) define no curve.
constexpr double least_crossing = 0.01;
// Normals of planes that are the same, but for rounding.
constexpr double same_plane = 1e-9;
// A smooth surface turns far less than this over a step of so many times the size.
constexpr double apex_step = 1e-5;
constexpr double apex_turn = 1e-2;

/// Frozen facets stay as they are; the others are turned so that like ones are alike.
Facet normalised(Facet facet) {
    if (!facet.frozen && facet.front > facet.back) {
        std::swap(facet.front, facet.back);
        std::swap(facet.vertices[1], facet.vertices[2]);
    }
    return facet;
}

/// The bare net. All triangles of like attributes are one patch yet, whether they hang together or not.
Net net_of(const FacetComplex& complex, const RemeshGeometry& geometry) {
    Net net;
    for (const Vec3& p : complex.points) net.add_vertex(p, VertexKind::corner, 0);
    std::map<std::tuple<std::uint32_t, Region, Region, bool>, Index> numbers;
    std::vector<Patch> patches;
    std::vector<Index> patch_of;
    for (const Facet& given : complex.facets) {
        const Facet facet = normalised(given);
        const auto [entry, is_new] = numbers.try_emplace(
            {facet.surface, facet.front, facet.back, facet.frozen}, static_cast<Index>(patches.size()));
        if (is_new)
            patches.push_back(
                {facet.surface, facet.front, facet.back, facet.frozen, geometry.planar(facet.surface), 1.0});
        net.add_triangle({facet.vertices, entry->second});
        patch_of.push_back(entry->second);
    }
    net.set_patches(std::move(patches), patch_of);
    return net;
}

/// Which way a patch looks, by the vote of its area.
double sense_of(const Net& net, const RemeshGeometry& geometry, std::span<const Index> triangles) {
    double agreement = 0;
    for (const Index t : triangles) {
        const auto [a, b, c] = net.corners(t);
        agreement += (b - a).cross(c - a).dot(geometry.normal(net.patch(t).surface, (a + b + c) / 3));
    }
    return agreement < 0 ? -1 : 1;
}

/// Gives every connected piece a patch of its own.
void split_patches(Net& net, const RemeshGeometry& geometry) {
    std::vector<Patch> pieces;
    std::vector<Index> piece_of(net.n_triangles(), none);
    for (Index seed = 0; seed < net.n_triangles(); ++seed) {
        if (piece_of[seed] != none) continue;
        const auto number = static_cast<Index>(pieces.size());
        std::vector<Index> piece{seed};
        piece_of[seed] = number;
        for (std::size_t i = 0; i < piece.size(); ++i) {
            const auto& v = net.triangle(piece[i]).vertices;
            for (std::size_t k = 0; k < 3; ++k) {
                if (net.is_feature(v[k], v[(k + 1) % 3])) continue;
                for (const Index t : net.triangles_at(v[k], v[(k + 1) % 3]))
                    if (std::exchange(piece_of[t], number) == none) piece.push_back(t);
            }
        }
        pieces.push_back(net.patch(seed));
        pieces.back().sense = sense_of(net, geometry, piece);
    }
    net.set_patches(std::move(pieces), piece_of);
}

/// The fans of triangles around v between feature edges: the number of feature edges at each; a closed fan
/// has none.
std::vector<int> fans(const Net& net, Index v) {
    const auto around = net.triangles_at(v);
    std::vector<bool> seen(around.size(), false);
    std::vector<int> ends;
    for (std::size_t seed = 0; seed < around.size(); ++seed) {
        if (seen[seed]) continue;
        seen[seed] = true;
        std::vector<Index> fan{around[seed]};
        int open_edges = 0;
        for (std::size_t i = 0; i < fan.size(); ++i)
            for (const Index w : net.triangle(fan[i]).vertices) {
                if (w == v) continue;
                if (net.is_feature(v, w)) {
                    ++open_edges;
                    continue;
                }
                for (const Index t : net.triangles_at(v, w)) {
                    const auto place =
                        static_cast<std::size_t>(std::ranges::find(around, t) - around.begin());
                    if (!seen[place]) fan.push_back(t);
                    seen[place] = true;
                }
            }
        ends.push_back(open_edges);
    }
    return ends;
}

/// Whether both edges of a curve at v have the same patches on all sides.
bool continues(const Net& net, Index v, Index before, Index after) {
    const auto patches = [&](Index end) {
        std::vector<Index> found;
        for (const Index t : net.triangles_at(v, end)) found.push_back(net.triangle(t).patch);
        std::ranges::sort(found);
        return found;
    };
    return patches(before) == patches(after);
}

/// Whether the surface has no one normal at p: the apex of a cone.
bool has_apex(const RemeshGeometry& geometry, std::uint32_t surface, const Vec3& p, double size) {
    if (geometry.planar(surface)) return false;
    const Vec3 normal = geometry.normal(surface, p);
    for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(-1, -1, -1)})
        if ((geometry.normal(surface, p + apex_step * size * direction) - normal).norm() > apex_turn)
            return true;
    return false;
}

VertexKind find_kind(const Net& net, const RemeshGeometry& geometry, Index v) {
    const auto around = net.triangles_at(v);
    if (std::ranges::any_of(around, [&](Index t) { return net.patch(t).frozen; })) return VertexKind::corner;
    const auto surfaces = net.surfaces(around);
    for (const std::uint32_t surface : surfaces)
        if (has_apex(geometry, surface, net.point(v), net.size(v))) return VertexKind::corner;

    const auto ends = net.feature_neighbours(v);
    const auto sectors = fans(net, v);
    if (ends.empty()) return sectors.size() == 1 ? VertexKind::face : VertexKind::corner;
    const bool on_one_curve = ends.size() == 2 && continues(net, v, ends[0], ends[1]) &&
                              std::ranges::all_of(sectors, [](int open_edges) { return open_edges == 2; });
    return on_one_curve ? curve_kind(geometry, surfaces, net.point(v)) : VertexKind::corner;
}

double wanted_size(const Net& net, const RemeshGeometry& geometry, Index v) {
    double size = std::numeric_limits<double>::infinity();
    for (const Index t : net.triangles_at(v))
        size = std::min(size, geometry.size(net.point(v), net.patch(t).front, net.patch(t).back));
    return size;
}

/// The two surfaces that cross most steeply at p, and the sine of their angle.
std::pair<std::array<std::uint32_t, 2>, double> steepest_pair(const RemeshGeometry& geometry,
                                                              std::span<const std::uint32_t> surfaces,
                                                              const Vec3& p) {
    std::pair<std::array<std::uint32_t, 2>, double> best{{surfaces[0], surfaces[0]}, 0};
    for (std::size_t i = 0; i < surfaces.size(); ++i)
        for (std::size_t j = i + 1; j < surfaces.size(); ++j) {
            const double sine = geometry.normal(surfaces[i], p).cross(geometry.normal(surfaces[j], p)).norm();
            if (sine > best.second) best = {{surfaces[i], surfaces[j]}, sine};
        }
    return best;
}

/// The surfaces less those planes that are another one again.
std::vector<std::uint32_t> without_coplanar(const RemeshGeometry& geometry,
                                            std::span<const std::uint32_t> surfaces, const Vec3& p) {
    std::vector<std::uint32_t> kept;
    for (const std::uint32_t surface : surfaces) {
        const auto is_same = [&](std::uint32_t other) {
            return geometry.planar(surface) && geometry.planar(other) &&
                   geometry.normal(surface, p).cross(geometry.normal(other, p)).norm() < same_plane;
        };
        if (std::ranges::none_of(kept, is_same)) kept.push_back(surface);
    }
    return kept;
}

}  // namespace

VertexKind curve_kind(const RemeshGeometry& geometry, std::span<const std::uint32_t> surfaces,
                      const Vec3& p) {
    return steepest_pair(geometry, surfaces, p).second < least_crossing ? VertexKind::tangent
                                                                        : VertexKind::curve;
}

std::optional<Vec3> nearest(const Session& session, std::span<const std::uint32_t> surfaces, VertexKind kind,
                            const Vec3& p, double reach) {
    std::vector<std::uint32_t> targets;
    if (kind == VertexKind::curve) {
        const auto pair = steepest_pair(session.geometry, surfaces, p).first;
        targets.assign(pair.begin(), pair.end());
        std::ranges::sort(targets);
    } else {
        targets = without_coplanar(session.geometry, surfaces, p);
    }
    const auto in_reach = [&](const std::optional<Vec3>& found) {
        return found && found->allFinite() && (*found - p).norm() <= reach;
    };
    // Two smooth surfaces have no other corners than where they touch.
    if (kind == VertexKind::corner && targets.size() == 2)
        if (const auto found = session.geometry.touch(targets[0], targets[1], p); in_reach(found))
            return found;
    const std::optional<Vec3> found = session.geometry.project(targets, p);
    return in_reach(found) ? found : std::nullopt;
}

Net make_net(const FacetComplex& complex, const RemeshGeometry& geometry) {
    Net net = net_of(complex, geometry);
    split_patches(net, geometry);
    net.pack_tree();
    for (Index v = 0; v < net.n_vertices(); ++v) {
        if (net.triangles_at(v).empty()) continue;
        net.set_size(v, wanted_size(net, geometry, v));
        net.set_kind(v, find_kind(net, geometry, v));
    }
    return net;
}

FacetComplex make_complex(const Net& net) {
    FacetComplex complex;
    std::vector<Index> numbers(net.n_vertices(), none);
    for (Index v = 0; v < net.n_vertices(); ++v) {
        if (net.triangles_at(v).empty()) continue;
        numbers[v] = static_cast<Index>(complex.points.size());
        complex.points.push_back(net.point(v));
    }
    for (Index t = 0; t < net.n_triangles(); ++t) {
        if (!net.is_alive(t)) continue;
        const auto& [a, b, c] = net.triangle(t).vertices;
        const Patch& patch = net.patch(t);
        complex.facets.push_back(
            {{numbers[a], numbers[b], numbers[c]}, patch.surface, patch.front, patch.back, patch.frozen});
    }
    return complex;
}

}  // namespace maille::modeler::remeshing
