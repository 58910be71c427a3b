#pragma once

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include <Eigen/Dense>

#include "modeler/remesh.hh"

/// Complexes to remesh, their true surfaces, and what can be measured of them.
namespace remesh_samples {

using maille::modeler::Facet;
using maille::modeler::FacetComplex;
using maille::modeler::outside;
using maille::modeler::Region;
using maille::modeler::RemeshGeometry;
using Vec3 = Eigen::Vector3d;

/// A plane (a point of it and its normal), a sphere (centre), or a cylinder (a point of its axis and the
/// axis).
struct Surface {
    enum class Kind { plane, sphere, cylinder } kind;
    Vec3 point;
    Vec3 direction;
    double radius = 0;

    double distance(const Vec3& p) const {
        const Vec3 d = p - point;
        switch (kind) {
            case Kind::plane:
                return d.dot(direction);
            case Kind::sphere:
                return d.norm() - radius;
            case Kind::cylinder:
                return (d - direction * d.dot(direction)).norm() - radius;
        }
        return 0;
    }
    Vec3 normal(const Vec3& p) const {
        const Vec3 d = p - point;
        switch (kind) {
            case Kind::plane:
                return direction;
            case Kind::sphere:
                return d.normalized();
            case Kind::cylinder:
                return (d - direction * d.dot(direction)).normalized();
        }
        return direction;
    }
};

inline Surface plane(const Vec3& p, const Vec3& n) {
    return {Surface::Kind::plane, p, n.normalized()};
}
inline Surface sphere(const Vec3& c, double r) {
    return {Surface::Kind::sphere, c, Vec3::UnitZ(), r};
}
inline Surface cylinder(const Vec3& p, const Vec3& axis, double r) {
    return {Surface::Kind::cylinder, p, axis.normalized(), r};
}

/// Newton's steps of least length towards all the surfaces.
inline std::optional<Vec3> project(const std::vector<Surface>& surfaces, std::span<const std::uint32_t> on,
                                   Vec3 p) {
    for (int step = 0; step < 50; ++step) {
        Eigen::MatrixXd slopes(on.size(), 3);
        Eigen::VectorXd distances(on.size());
        for (std::size_t i = 0; i < on.size(); ++i) {
            distances(static_cast<Eigen::Index>(i)) = surfaces[on[i]].distance(p);
            slopes.row(static_cast<Eigen::Index>(i)) = surfaces[on[i]].normal(p).transpose();
        }
        if (distances.lpNorm<Eigen::Infinity>() < 1e-15) return p;
        auto solver = slopes.completeOrthogonalDecomposition();
        solver.setThreshold(1e-9);
        const Vec3 move = solver.solve(distances);
        p -= move;
        if (move.norm() < 1e-15) break;
    }
    for (const std::uint32_t s : on)
        if (std::abs(surfaces[s].distance(p)) > 1e-13) return std::nullopt;
    return p;
}

inline RemeshGeometry geometry(const std::vector<Surface>& surfaces, double size) {
    return {.project = [surfaces](std::span<const std::uint32_t> on,
                                  const Vec3& p) { return project(surfaces, on, p); },
            .normal = [surfaces](std::uint32_t s, const Vec3& p) { return surfaces[s].normal(p); },
            .planar = [surfaces](std::uint32_t s) { return surfaces[s].kind == Surface::Kind::plane; },
            .size = [size](const Vec3&, Region, Region) { return size; }};
}

struct Sample {
    FacetComplex complex;
    std::vector<Surface> surfaces;
};

/// Collects triangles given by their places; one vertex a place.
class Builder {
  public:
    std::uint32_t vertex(const Vec3& p) {
        const std::array key{std::llround(p.x() * 1e9), std::llround(p.y() * 1e9), std::llround(p.z() * 1e9)};
        const auto [entry, is_new] =
            numbers_.try_emplace(key, static_cast<std::uint32_t>(complex.points.size()));
        if (is_new) complex.points.push_back(p);
        return entry->second;
    }
    void triangle(const Vec3& a, const Vec3& b, const Vec3& c, std::uint32_t surface, Region front,
                  Region back) {
        const std::array v{vertex(a), vertex(b), vertex(c)};
        if (v[0] != v[1] && v[1] != v[2] && v[2] != v[0]) complex.facets.push_back({v, surface, front, back});
    }
    void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, std::uint32_t surface, Region front,
              Region back) {
        triangle(a, b, c, surface, front, back);
        triangle(a, c, d, surface, front, back);
    }
    FacetComplex complex;

  private:
    std::map<std::array<long long, 3>, std::uint32_t> numbers_;
};

/// Two boxes side by side, [0,1] and [1,2] in x, regions 0 and 1, turned so that no plane is along the axes.
inline Sample two_boxes() {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const auto at = [&](double x, double y, double z) -> Vec3 { return turn * Vec3(x, y, z); };
    Builder b;
    for (const Region r : {0, 1}) {
        const double x = r;
        b.quad(at(x, 0, 0), at(x, 1, 0), at(x + 1, 1, 0), at(x + 1, 0, 0), 0, outside, r);
        b.quad(at(x, 0, 1), at(x + 1, 0, 1), at(x + 1, 1, 1), at(x, 1, 1), 1, outside, r);
        b.quad(at(x, 0, 0), at(x + 1, 0, 0), at(x + 1, 0, 1), at(x, 0, 1), 2, outside, r);
        b.quad(at(x, 1, 0), at(x, 1, 1), at(x + 1, 1, 1), at(x + 1, 1, 0), 3, outside, r);
    }
    b.quad(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0), 4, outside, 0);
    b.quad(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1), 5, 1, 0);
    b.quad(at(2, 0, 0), at(2, 1, 0), at(2, 1, 1), at(2, 0, 1), 6, outside, 1);
    const auto face = [&](const Vec3& p, const Vec3& n) { return plane(turn * p, turn * n); };
    return {b.complex,
            {face(Vec3(0, 0, 0), -Vec3::UnitZ()), face(Vec3(0, 0, 1), Vec3::UnitZ()),
             face(Vec3(0, 0, 0), -Vec3::UnitY()), face(Vec3(0, 1, 0), Vec3::UnitY()),
             face(Vec3(0, 0, 0), -Vec3::UnitX()), face(Vec3(1, 0, 0), -Vec3::UnitX()),
             face(Vec3(2, 0, 0), Vec3::UnitX())}};
}

/// Triangles of the unit sphere: the octahedron, each face divided into n x n.
inline std::vector<std::array<Vec3, 3>> sphere_triangles(int n) {
    std::vector<std::array<Vec3, 3>> all;
    for (int octant = 0; octant < 8; ++octant) {
        const Vec3 x(octant & 1 ? -1 : 1, 0, 0);
        const Vec3 y(0, octant & 2 ? -1 : 1, 0);
        const Vec3 z(0, 0, octant & 4 ? -1 : 1);
        const bool mirrored = x.cross(y).dot(z) < 0;
        const auto at = [&](int i, int j) -> Vec3 { return (x * i + y * j + z * (n - i - j)).normalized(); };
        const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
            all.push_back(mirrored ? std::array{a, c, b} : std::array{a, b, c});
        };
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                add(at(i, j), at(i + 1, j), at(i, j + 1));
                if (i + j + 1 < n) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            }
    }
    return all;
}

/// The unit sphere, region 0.
inline Sample ball(int n) {
    Builder b;
    for (const auto& [p, q, r] : sphere_triangles(n)) b.triangle(p, q, r, 0, outside, 0);
    return {b.complex, {sphere(Vec3::Zero(), 1)}};
}

/// A cylinder of radius 1 between z = 0 and z = height, region 0; n segments around.
inline Sample drum(int n, double height) {
    Builder b;
    const auto at = [&](int i, double z) {
        const double angle = 2 * std::numbers::pi * (i % n) / n;
        return Vec3(std::cos(angle), std::sin(angle), z);
    };
    for (int i = 0; i < n; ++i) {
        b.quad(at(i, 0), at(i + 1, 0), at(i + 1, height), at(i, height), 0, outside, 0);
        b.triangle(Vec3(0, 0, 0), at(i + 1, 0), at(i, 0), 1, outside, 0);
        b.triangle(Vec3(0, 0, height), at(i, height), at(i + 1, height), 2, outside, 0);
    }
    return {b.complex,
            {cylinder(Vec3::Zero(), Vec3::UnitZ(), 1), plane(Vec3::Zero(), -Vec3::UnitZ()),
             plane(Vec3(0, 0, height), Vec3::UnitZ())}};
}

/// The unit sphere cut at the plane through c along n, by clipping its triangles: region 0 above, 1 below,
/// and a disc between them, a fan. The triangles along the cut are slivers, its points are on chords.
inline Sample cut_ball(int n, double height, const Vec3& normal) {
    const Vec3 up = normal.normalized();
    Builder b;
    std::vector<std::array<Vec3, 2>> rim;
    for (const auto& corners : sphere_triangles(n)) {
        for (const Region region : {0, 1}) {
            const double side = region == 0 ? 1 : -1;
            std::vector<Vec3> polygon;
            std::vector<Vec3> cut;
            for (int i = 0; i < 3; ++i) {
                const Vec3& p = corners[static_cast<std::size_t>(i)];
                const Vec3& q = corners[static_cast<std::size_t>((i + 1) % 3)];
                const double dp = up.dot(p) - height;
                const double dq = up.dot(q) - height;
                if (side * dp > 0) polygon.push_back(p);
                if ((dp > 0) == (dq > 0)) continue;
                // The same rounding from either side.
                cut.push_back(dp > 0 ? Vec3(p + (q - p) * (dp / (dp - dq)))
                                     : Vec3(q + (p - q) * (dq / (dq - dp))));
                polygon.push_back(cut.back());
            }
            for (std::size_t i = 2; i < polygon.size(); ++i)
                b.triangle(polygon[0], polygon[i - 1], polygon[i], 0, outside, region);
            if (cut.size() == 2 && region == 0) rim.push_back({cut[0], cut[1]});
        }
    }
    for (const auto& [p, q] : rim) {
        const bool turns_left = up.dot((p - up * height).cross(q - up * height)) > 0;
        b.triangle(up * height, turns_left ? p : q, turns_left ? q : p, 1, 0, 1);
    }
    return {b.complex, {sphere(Vec3::Zero(), 1), plane(up * height, up)}};
}

/// What two cylinders of radius 1 at right angles have in common; four curves meet at either pole.
inline Sample crossed_cylinders(int n) {
    Builder b;
    for (int quarter = 0; quarter < 4; ++quarter) {
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd(quarter * std::numbers::pi / 2, Vec3::UnitZ()).toRotationMatrix();
        const auto at = [&](int i, int j) -> Vec3 {
            const double angle = std::numbers::pi * (static_cast<double>(i) / n - 0.5);
            const double y = i == 0 || i == n ? 0 : std::cos(angle);
            return turn * Vec3(y * (2.0 * j / n - 1), y, std::sin(angle));
        };
        const auto surface = static_cast<std::uint32_t>(quarter % 2);
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                b.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), surface, outside, 0);
    }
    return {b.complex, {cylinder(Vec3::Zero(), Vec3::UnitX(), 1), cylinder(Vec3::Zero(), Vec3::UnitY(), 1)}};
}

/// Splits random edges at random places, close to their ends too, on the true surfaces: terrible triangles.
inline void torture(Sample& sample, int splits, unsigned seed) {
    std::mt19937 random(seed);
    auto& [points, facets] = sample.complex;
    for (int i = 0; i < splits; ++i) {
        const Facet picked = facets[random() % facets.size()];
        const std::size_t side = random() % 3;
        const std::uint32_t a = picked.vertices[side];
        const std::uint32_t c = picked.vertices[(side + 1) % 3];
        const double t = 0.02 + 0.96 * (static_cast<double>(random() % 1000) / 1000);
        std::set<std::uint32_t> surfaces;
        std::vector<std::size_t> sheets;
        for (std::size_t f = 0; f < facets.size(); ++f) {
            const auto& v = facets[f].vertices;
            if (std::ranges::find(v, a) == v.end() || std::ranges::find(v, c) == v.end()) continue;
            sheets.push_back(f);
            surfaces.insert(facets[f].surface);
        }
        const std::vector<std::uint32_t> on(surfaces.begin(), surfaces.end());
        const auto p = project(sample.surfaces, on, points[a] + (points[c] - points[a]) * t);
        if (!p) continue;
        const auto middle = static_cast<std::uint32_t>(points.size());
        points.push_back(*p);
        for (const std::size_t f : sheets) {
            Facet half = facets[f];
            std::ranges::replace(half.vertices, a, middle);
            std::ranges::replace(facets[f].vertices, c, middle);
            facets.push_back(half);
        }
    }
}

inline double area(const FacetComplex& complex, const Facet& f) {
    const Vec3& a = complex.points[f.vertices[0]];
    return (complex.points[f.vertices[1]] - a).cross(complex.points[f.vertices[2]] - a).norm() / 2;
}

inline double area(const FacetComplex& complex, std::uint32_t surface) {
    double sum = 0;
    for (const Facet& f : complex.facets)
        if (f.surface == surface) sum += area(complex, f);
    return sum;
}

/// By the divergence theorem.
inline double volume(const FacetComplex& complex, Region region) {
    double sum = 0;
    for (const Facet& f : complex.facets) {
        const double cone = complex.points[f.vertices[0]].dot(
            complex.points[f.vertices[1]].cross(complex.points[f.vertices[2]]));
        sum += f.back == region ? cone : 0;
        sum -= f.front == region ? cone : 0;
    }
    return sum / 6;
}

using EdgeSheets = std::map<std::array<std::uint32_t, 2>, std::vector<Facet>>;

inline EdgeSheets edges(const FacetComplex& complex) {
    EdgeSheets all;
    for (const Facet& f : complex.facets)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(f.vertices[i], f.vertices[(i + 1) % 3]);
            all[{low, high}].push_back(f);
        }
    return all;
}

/// Whether the shell of the region has as many facets that run an edge this way as that way.
inline bool is_closed(const FacetComplex& complex, Region region) {
    std::map<std::array<std::uint32_t, 2>, int> balance;
    for (const Facet& f : complex.facets)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = f.vertices[i];
            const std::uint32_t b = f.vertices[(i + 1) % 3];
            const int way = (a < b ? 1 : -1) * ((f.back == region ? 1 : 0) - (f.front == region ? 1 : 0));
            balance[{std::min(a, b), std::max(a, b)}] += way;
        }
    return std::ranges::all_of(balance, [](const auto& entry) { return entry.second == 0; });
}

/// Vertices less edges plus facets of the region's shell.
inline long euler(const FacetComplex& complex, Region region) {
    FacetComplex shell;
    std::set<std::uint32_t> vertices;
    for (const Facet& f : complex.facets) {
        if (f.front != region && f.back != region) continue;
        shell.facets.push_back(f);
        vertices.insert(f.vertices.begin(), f.vertices.end());
    }
    return static_cast<long>(vertices.size()) - static_cast<long>(edges(shell).size()) +
           static_cast<long>(shell.facets.size());
}

/// Length of all edges where sheets of both surfaces meet.
inline double curve_length(const FacetComplex& complex, std::uint32_t one, std::uint32_t other) {
    double sum = 0;
    for (const auto& [ends, sheets] : edges(complex)) {
        const auto lies_on = [&](std::uint32_t s) {
            return std::ranges::any_of(sheets, [&](const Facet& f) { return f.surface == s; });
        };
        if (lies_on(one) && lies_on(other)) sum += (complex.points[ends[0]] - complex.points[ends[1]]).norm();
    }
    return sum;
}

/// Degrees.
inline double smallest_angle(const FacetComplex& complex) {
    double smallest = 180;
    for (const Facet& f : complex.facets)
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3& p = complex.points[f.vertices[i]];
            const Vec3 a = complex.points[f.vertices[(i + 1) % 3]] - p;
            const Vec3 b = complex.points[f.vertices[(i + 2) % 3]] - p;
            smallest = std::min(smallest, std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi);
        }
    return smallest;
}

/// The largest distance of a vertex from a surface of one of its facets.
inline double largest_distance(const Sample& sample) {
    double largest = 0;
    for (const Facet& f : sample.complex.facets)
        for (const std::uint32_t v : f.vertices)
            largest =
                std::max(largest, std::abs(sample.surfaces[f.surface].distance(sample.complex.points[v])));
    return largest;
}

struct Lengths {
    double shortest;
    double longest;
};

inline Lengths lengths(const FacetComplex& complex) {
    Lengths result{1e300, 0};
    for (const auto& [ends, sheets] : edges(complex)) {
        const double length = (complex.points[ends[0]] - complex.points[ends[1]]).norm();
        result = {std::min(result.shortest, length), std::max(result.longest, length)};
    }
    return result;
}

}  // namespace remesh_samples
