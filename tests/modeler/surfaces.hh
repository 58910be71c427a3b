#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "modeler/arrange.hh"

/// Simple closed surfaces to arrange, and measures of what comes out.
namespace maille::modeler::test {

using Eigen::Vector3d;

inline ClosedSurface box(const Vector3d& low, const Vector3d& high, std::uint32_t first_surface = 0) {
    ClosedSurface s;
    for (int i = 0; i < 8; ++i)
        s.points.emplace_back((i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z());
    constexpr std::array<std::array<std::uint32_t, 4>, 6> quads{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (std::uint32_t q = 0; q < 6; ++q) {
        const auto& [a, b, c, d] = quads[q];
        s.triangles.push_back({a, b, c});
        s.triangles.push_back({a, c, d});
        s.surfaces.insert(s.surfaces.end(), 2, first_surface + q);
    }
    return s;
}

/// A box with its faces cut along the given coordinates, which rise.
inline ClosedSurface grid_box(const std::array<std::vector<double>, 3>& lines,
                              std::uint32_t first_surface = 0) {
    ClosedSurface s;
    std::map<std::array<std::size_t, 3>, std::uint32_t> numbers;
    const auto point = [&](std::array<std::size_t, 3> at) {
        const auto [entry, is_new] = numbers.try_emplace(at, std::uint32_t(s.points.size()));
        if (is_new) s.points.emplace_back(lines[0][at[0]], lines[1][at[1]], lines[2][at[2]]);
        return entry->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const bool high : {false, true}) {
            const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
            for (std::size_t i = 0; i + 1 < lines[u].size(); ++i)
                for (std::size_t j = 0; j + 1 < lines[v].size(); ++j) {
                    std::array<std::array<std::size_t, 3>, 4> corners{};
                    for (std::size_t k = 0; k < 4; ++k) {
                        corners[k][axis] = high ? lines[axis].size() - 1 : 0;
                        corners[k][u] = i + (k == 1 || k == 2);
                        corners[k][v] = j + (k > 1);
                    }
                    if (!high) std::swap(corners[1], corners[3]);
                    const auto a = point(corners[0]), b = point(corners[1]), c = point(corners[2]),
                               d = point(corners[3]);
                    s.triangles.push_back({a, b, c});
                    s.triangles.push_back({a, c, d});
                    s.surfaces.insert(s.surfaces.end(), 2, first_surface + std::uint32_t(2 * axis + high));
                }
        }
    return s;
}

inline ClosedSurface sphere(const Vector3d& center, double radius, int subdivisions,
                            std::uint32_t surface = 0) {
    ClosedSurface s;
    const double t = std::numbers::phi;
    for (const double a : {-1.0, 1.0})
        for (const double b : {-t, t}) {
            s.points.emplace_back(a, b, 0);
            s.points.emplace_back(0, a, b);
            s.points.emplace_back(b, 0, a);
        }
    for (std::uint32_t i = 0; i < 12; ++i)
        for (std::uint32_t j = i + 1; j < 12; ++j)
            for (std::uint32_t k = j + 1; k < 12; ++k) {
                const auto near = [&](auto a, auto b) { return (s.points[a] - s.points[b]).norm() < 2.1; };
                if (!near(i, j) || !near(j, k) || !near(k, i)) continue;
                const bool out =
                    (s.points[j] - s.points[i]).cross(s.points[k] - s.points[i]).dot(s.points[i]) > 0;
                s.triangles.push_back(out ? std::array{i, j, k} : std::array{i, k, j});
            }
    for (int n = 0; n < subdivisions; ++n) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), std::uint32_t(s.points.size()));
            if (is_new) s.points.push_back((s.points[a] + s.points[b]) / 2);
            return at->second;
        };
        std::vector<std::array<std::uint32_t, 3>> finer;
        for (const auto& [a, b, c] : s.triangles) {
            const auto ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            for (const auto& f : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
                finer.push_back(f);
        }
        s.triangles = finer;
    }
    for (auto& p : s.points) p = center + radius * p.normalized();
    s.surfaces.assign(s.triangles.size(), surface);
    return s;
}

/// Along z, from z = 0 to h, around the origin; surfaces: side, bottom, top.
inline ClosedSurface cylinder(double radius, double h, std::uint32_t n, std::uint32_t first_surface = 0) {
    ClosedSurface s;
    for (const double z : {0.0, h})
        for (std::uint32_t i = 0; i < n; ++i) {
            const double a = 2 * std::numbers::pi * i / n;
            s.points.emplace_back(radius * std::cos(a), radius * std::sin(a), z);
        }
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t surface) {
        s.triangles.push_back({a, b, c});
        s.surfaces.push_back(first_surface + surface);
    };
    for (std::uint32_t i = 0; i < n; ++i) {
        const auto j = (i + 1) % n;
        add(i, j, n + j, 0);
        add(i, n + j, n + i, 0);
        if (i > 0 && j > 0) add(0, j, i, 1), add(n, n + i, n + j, 2);
    }
    return s;
}

inline ClosedSurface transformed(ClosedSurface s, const Eigen::Affine3d& t) {
    for (auto& p : s.points) p = t * p;
    return s;
}

inline Eigen::Affine3d random_motion(std::mt19937& random, double reach) {
    std::uniform_real_distribution<double> u(-1, 1);
    const Vector3d axis = Vector3d(u(random), u(random), u(random) + 1e-3).normalized();
    const Vector3d shift(u(random), u(random), u(random));
    return Eigen::Translation3d(reach * shift) * Eigen::AngleAxisd(3.14 * u(random), axis);
}

inline double volume(const ClosedSurface& s) {
    double sum = 0;
    const Vector3d o = s.points[0];
    for (const auto& [a, b, c] : s.triangles)
        sum += (s.points[a] - o).dot((s.points[b] - o).cross(s.points[c] - o)) / 6;
    return sum;
}

/// Volume of each region, from the facets around it.
inline std::map<Region, double> volumes(const FacetComplex& complex) {
    std::map<Region, double> sums;
    for (const Facet& f : complex.facets) {
        const auto& p = complex.points;
        const Vector3d& o = p[complex.facets[0].vertices[0]];
        const double v = (p[f.vertices[0]] - o).dot((p[f.vertices[1]] - o).cross(p[f.vertices[2]] - o)) / 6;
        if (f.back != outside) sums[f.back] += v;
        if (f.front != outside) sums[f.front] -= v;
    }
    return sums;
}

inline double total(const std::map<Region, double>& volumes) {
    double sum = 0;
    for (const auto& [region, v] : volumes) sum += v;
    return sum;
}

/// Area of the facets between the solid and the outside.
inline double outer_area(const FacetComplex& complex) {
    double sum = 0;
    for (const Facet& f : complex.facets) {
        const auto& p = complex.points;
        if (f.front == outside || f.back == outside)
            sum +=
                (p[f.vertices[1]] - p[f.vertices[0]]).cross(p[f.vertices[2]] - p[f.vertices[0]]).norm() / 2;
    }
    return sum;
}

/// The facets around a region, oriented outwards.
inline ClosedSurface shell(const FacetComplex& complex, Region region) {
    ClosedSurface s;
    s.points = complex.points;
    for (const Facet& f : complex.facets) {
        const auto& [a, b, c] = f.vertices;
        if (f.back == region) s.triangles.push_back({a, b, c});
        if (f.front == region) s.triangles.push_back({a, c, b});
    }
    s.surfaces.assign(s.triangles.size(), 0);
    return s;
}

inline bool is_closed(const ClosedSurface& s) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    for (const auto& t : s.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto a = t[k], b = t[(k + 1) % 3];
            balance[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    return std::ranges::all_of(balance, [](const auto& entry) { return entry.second == 0; });
}

inline CsgTree leaf(std::uint32_t i) {
    return {Operation::leaf, i};
}

inline CsgTree node(Operation operation, std::vector<CsgTree> children) {
    return {operation, 0, std::move(children)};
}

inline CsgTree pair(Operation operation) {
    return node(operation, {leaf(0), leaf(1)});
}

}  // namespace maille::modeler::test
