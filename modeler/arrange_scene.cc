#include "modeler/arrange_scene.hh"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "modeler/point_grid.hh"
#include "volmesh/error.hh"

namespace maille::modeler::detail {

namespace {

/// Every edge must be used as often in one direction as in the other.
void check_closed(const ClosedSurface& surface, std::size_t primitive) {
    std::vector<std::pair<std::uint64_t, int>> uses;
    uses.reserve(3 * surface.triangles.size());
    for (const auto& t : surface.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto a = t[k], b = t[(k + 1) % 3];
            if (a != b) uses.emplace_back(edge_key(a, b), a < b ? 1 : -1);
        }
    std::ranges::sort(uses);
    for (std::size_t i = 0; i < uses.size();) {
        int balance = 0;
        const auto key = uses[i].first;
        for (; i < uses.size() && uses[i].first == key; ++i) balance += uses[i].second;
        if (balance != 0)
            throw InputError(
                fmt::format("the surface of primitive {} is not closed: its edge between points {} and {} "
                            "borders facets that "
                            "do not match; close the surface and orient its facets alike",
                            primitive, key >> 32, key & 0xffffffffU));
    }
}

void check(const ClosedSurface& surface, std::size_t primitive) {
    for (std::size_t i = 0; i < surface.points.size(); ++i)
        if (!surface.points[i].allFinite())
            throw InputError(fmt::format("point {} of primitive {} is not finite", i, primitive));
    for (std::size_t i = 0; i < surface.triangles.size(); ++i)
        for (const auto v : surface.triangles[i])
            if (v >= surface.points.size())
                throw InputError(
                    fmt::format("triangle {} of primitive {} uses point {}, but there are only {}", i,
                                primitive, v, surface.points.size()));
    if (surface.surfaces.size() != surface.triangles.size())
        throw InputError(fmt::format("primitive {} has {} triangles but {} surface numbers", primitive,
                                     surface.triangles.size(), surface.surfaces.size()));
    check_closed(surface, primitive);
}

Eigen::AlignedBox3d bounding_box(const FacetComplex& complex) {
    Eigen::AlignedBox3d box;
    for (const auto& p : complex.points) box.extend(p);
    return box;
}

std::vector<std::uint32_t> primitives_of(const FacetComplex& complex, std::span<const std::uint32_t> facets) {
    std::vector<std::uint32_t> primitives;
    for (const auto f : facets)
        for (const Region r : {complex.facets[f].front, complex.facets[f].back})
            if (r != outside) primitives.push_back(static_cast<std::uint32_t>(r));
    std::ranges::sort(primitives);
    primitives.erase(std::unique(primitives.begin(), primitives.end()), primitives.end());
    return primitives;
}

const Eigen::Vector3d& place_of(const FacetComplex& complex, std::span<const std::uint32_t> facets) {
    return complex.points[complex.facets[facets[0]].vertices[0]];
}

}  // namespace

void fail(const FacetComplex& complex, std::span<const std::uint32_t> facets, const std::string& problem) {
    const auto first_line = problem.substr(0, problem.find('\n'));
    throw ArrangeError(first_line, primitives_of(complex, facets), place_of(complex, facets));
}

void fail_for_work(const FacetComplex& complex, std::span<const std::uint32_t> facets) {
    throw ArrangeLimitError(
        "are among so many that meet each other in so many places that it would hardly end; use fewer or "
        "simpler solids, or larger facets",
        primitives_of(complex, facets), place_of(complex, facets));
}

Scene gather(std::span<const ClosedSurface> primitives) {
    Scene scene;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const ClosedSurface& surface = primitives[i];
        check(surface, i);
        const auto first = static_cast<std::uint32_t>(scene.complex.points.size());
        scene.complex.points.insert(scene.complex.points.end(), surface.points.begin(), surface.points.end());
        for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
            const auto& v = surface.triangles[t];
            scene.complex.facets.push_back({{first + v[0], first + v[1], first + v[2]},
                                            surface.surfaces[t],
                                            outside,
                                            static_cast<Region>(i)});
            scene.parents.push_back({static_cast<std::uint32_t>(i), t, false});
        }
    }
    return scene;
}

void weld(Scene& scene, double distance) {
    const auto& points = scene.complex.points;
    PointGrid grid(distance);
    std::vector<std::uint32_t> new_index(points.size());
    std::vector<Eigen::Vector3d> kept;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const auto same = grid.find(points[i]);
        new_index[i] = same.value_or(static_cast<std::uint32_t>(kept.size()));
        if (same) continue;
        grid.add(points[i], new_index[i]);
        kept.push_back(points[i]);
    }
    scene.complex.points = std::move(kept);

    std::size_t n = 0;
    for (std::size_t i = 0; i < scene.complex.facets.size(); ++i) {
        Facet facet = scene.complex.facets[i];
        for (auto& v : facet.vertices) v = new_index[v];
        const auto& [a, b, c] = facet.vertices;
        if (a == b || b == c || c == a) continue;
        scene.complex.facets[n] = facet;
        scene.parents[n++] = scene.parents[i];
    }
    scene.complex.facets.resize(n);
    scene.parents.resize(n);
}

double diagonal(const FacetComplex& complex) {
    return complex.points.empty() ? 0 : bounding_box(complex).diagonal().norm();
}

double tolerance(const FacetComplex& complex, double relative) {
    if (complex.points.empty()) return 0;
    const Eigen::AlignedBox3d box = bounding_box(complex);
    const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
    const double resolution = 8 * std::numeric_limits<double>::epsilon() * largest;
    return std::max({relative * box.diagonal().norm(), resolution, std::numeric_limits<double>::min()});
}

}  // namespace maille::modeler::detail
