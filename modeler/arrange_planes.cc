#include "modeler/arrange_planes.hh"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

#include <Eigen/Geometry>

namespace maille::modeler::detail {

namespace {

using Eigen::Vector3d;

/// Planes at a smaller angle than this count as parallel.
constexpr double least_sine = 0.02;

/// Facets in one plane, found largest first.
struct Plane {
    Vector3d normal;
    Vector3d origin;
    std::uint32_t seed;                     ///< its largest facet
    std::vector<std::uint32_t> vertices{};  ///< of its facets, and of others that touch it
    std::vector<Region> primitives{};       ///< that these facets belong to
    bool shared = false;                    ///< whether facets of two primitives lie in it
    bool active = false;

    double distance(const Vector3d& p) const { return std::abs(normal.dot(p - origin)); }
};

template <class T>
void sort_unique(std::vector<T>& v) {
    std::ranges::sort(v);
    v.erase(std::unique(v.begin(), v.end()), v.end());
}

Vector3d area_vector(const FacetComplex& complex, std::uint32_t facet) {
    const auto& [a, b, c] = complex.facets[facet].vertices;
    return (complex.points[b] - complex.points[a]).cross(complex.points[c] - complex.points[a]);
}

/// Groups facets by plane. Planes are looked up by their normal, on a grid, and by their offset.
class PlaneFinder {
  public:
    PlaneFinder(const FacetComplex& complex, double tolerance)
        : complex_(complex), tolerance_(tolerance), plane_of_facet_(complex.facets.size(), none) {
        Eigen::AlignedBox3d box;
        for (const auto& p : complex.points) box.extend(p);
        center_ = box.center();
        offset_slack_ = normal_slack * box.diagonal().norm() + 2 * tolerance;
    }

    void add(std::uint32_t facet) {
        const Vector3d normal = area_vector(complex_, facet).normalized();
        if (!(normal.squaredNorm() > 0.5)) return;  // no area, no plane
        auto plane = std::min(find(facet, normal), find(facet, -normal));
        if (plane == none) plane = create(facet, normal);
        plane_of_facet_[facet] = plane;
        const Facet& f = complex_.facets[facet];
        for (const auto v : f.vertices) planes_[plane].vertices.push_back(v);
        for (const auto r : {f.front, f.back})
            if (r != outside) planes_[plane].primitives.push_back(r);
    }

    /// Adds the corners of `facet` that touch the plane of the facet `other`.
    void add_contacts(std::uint32_t facet, std::uint32_t other) {
        if (plane_of_facet_[other] == none) return;
        Plane& plane = planes_[plane_of_facet_[other]];
        Eigen::AlignedBox3d reach = facet_box(complex_, other);
        reach.min().array() -= tolerance_, reach.max().array() += tolerance_;
        const Facet& f = complex_.facets[facet];
        for (const auto v : f.vertices) {
            const Vector3d& p = complex_.points[v];
            if (!reach.contains(p) || plane.distance(p) > tolerance_) continue;
            plane.vertices.push_back(v);
            for (const auto r : {f.front, f.back})
                if (r != outside) plane.primitives.push_back(r);
        }
    }

    /// To be called when all facets are there, before contacts are added.
    void find_shared() {
        for (Plane& plane : planes_) {
            sort_unique(plane.primitives);
            plane.shared = plane.primitives.size() > 1;
        }
    }

    std::vector<Plane>& planes() { return planes_; }
    std::uint32_t plane_of(std::uint32_t facet) const { return plane_of_facet_[facet]; }

  private:
    static constexpr double normal_slack = 1e-6;
    static constexpr double cell = 1.6e-5;
    using Cell = std::array<int, 3>;

    Cell cell_of(const Eigen::Array3d& n) const {
        const Eigen::Array3i c = (n / cell).floor().cast<int>();
        return {c[0], c[1], c[2]};
    }

    std::uint32_t find(std::uint32_t facet, const Vector3d& normal) const {
        const double offset = normal.dot(complex_.points[complex_.facets[facet].vertices[0]] - center_);
        const Cell low = cell_of(normal.array() - normal_slack),
                   high = cell_of(normal.array() + normal_slack);
        std::uint32_t found = none;
        for (int x = low[0]; x <= high[0]; ++x)
            for (int y = low[1]; y <= high[1]; ++y)
                for (int z = low[2]; z <= high[2]; ++z)
                    found = std::min(found, find_in({x, y, z}, facet, offset));
        return found;
    }

    std::uint32_t find_in(const Cell& c, std::uint32_t facet, double offset) const {
        const auto at = cells_.find(c);
        if (at == cells_.end()) return none;
        std::uint32_t found = none;
        const auto end = at->second.upper_bound(offset + offset_slack_);
        for (auto it = at->second.lower_bound(offset - offset_slack_); it != end; ++it)
            if (it->second < found && holds(planes_[it->second], facet)) found = it->second;
        return found;
    }

    bool holds(const Plane& plane, std::uint32_t facet) const {
        return std::ranges::all_of(complex_.facets[facet].vertices, [&](std::uint32_t v) {
            return plane.distance(complex_.points[v]) <= tolerance_;
        });
    }

    std::uint32_t create(std::uint32_t facet, const Vector3d& normal) {
        const auto index = static_cast<std::uint32_t>(planes_.size());
        const Vector3d& origin = complex_.points[complex_.facets[facet].vertices[0]];
        planes_.push_back({normal, origin, facet});
        cells_[cell_of(normal.array())].emplace(normal.dot(origin - center_), index);
        return index;
    }

    const FacetComplex& complex_;
    double tolerance_;
    Vector3d center_;
    double offset_slack_ = 0;
    std::vector<Plane> planes_;
    std::vector<std::uint32_t> plane_of_facet_;
    std::map<Cell, std::multimap<double, std::uint32_t>> cells_;
};

std::vector<std::uint32_t> largest_first(const FacetComplex& complex, std::span<const Pair> pairs) {
    std::vector<std::uint32_t> facets;
    facets.reserve(2 * pairs.size());
    for (const auto& [a, b] : pairs) facets.push_back(a), facets.push_back(b);
    sort_unique(facets);
    std::vector<std::pair<double, std::uint32_t>> order;
    for (const auto f : facets) order.emplace_back(-area_vector(complex, f).squaredNorm(), f);
    std::ranges::sort(order);
    std::ranges::transform(order, facets.begin(), [](const auto& o) { return o.second; });
    return facets;
}

/// Decides which planes points are moved onto: those shared by two primitives, and those with no corner on
/// more planes than can be met at once. Three points lie in a plane anyhow.
void activate(std::vector<Plane>& planes, std::size_t n_points) {
    std::vector<int> planes_at(n_points, 0);
    for (Plane& plane : planes) {
        sort_unique(plane.vertices);
        sort_unique(plane.primitives);
        if (plane.vertices.size() > 3)
            for (const auto v : plane.vertices) ++planes_at[v];
    }
    for (Plane& plane : planes)
        plane.active =
            plane.vertices.size() > 3 &&
            (plane.primitives.size() > 1 ||
             std::ranges::all_of(plane.vertices, [&](std::uint32_t v) { return planes_at[v] <= 3; }));
}

ExactPoint exact(const Vector3d& p) {
    return {p.x(), p.y(), p.z()};
}

/// The plane through the corners of the largest facet if it holds all the points exactly. Otherwise one with
/// a normal in doubles, since short coefficients keep all that is computed from them short.
ExactPlane exact_plane(const Plane& plane, const FacetComplex& complex) {
    const auto& [a, b, c] = complex.facets[plane.seed].vertices;
    const ExactPlane through(exact(complex.points[a]), exact(complex.points[b]), exact(complex.points[c]));
    const bool holds_all = std::ranges::all_of(
        plane.vertices, [&](std::uint32_t v) { return through.has_on(exact(complex.points[v])); });
    if (holds_all) return through;
    return {exact(plane.origin), Exact::Vector_3(plane.normal.x(), plane.normal.y(), plane.normal.z())};
}

/// The common point of three planes that are far from parallel.
ExactPoint meet(const std::array<ExactPlane, 3>& p) {
    const auto& [e, f, g] = p;
    const ExactNumber fg_x = f.b() * g.c() - f.c() * g.b(), fg_y = f.c() * g.a() - f.a() * g.c(),
                      fg_z = f.a() * g.b() - f.b() * g.a();
    const ExactNumber ge_x = g.b() * e.c() - g.c() * e.b(), ge_y = g.c() * e.a() - g.a() * e.c(),
                      ge_z = g.a() * e.b() - g.b() * e.a();
    const ExactNumber ef_x = e.b() * f.c() - e.c() * f.b(), ef_y = e.c() * f.a() - e.a() * f.c(),
                      ef_z = e.a() * f.b() - e.b() * f.a();
    const ExactNumber scale = -1 / (e.a() * fg_x + e.b() * fg_y + e.c() * fg_z);
    ExactPoint point((e.d() * fg_x + f.d() * ge_x + g.d() * ef_x) * scale,
                     (e.d() * fg_y + f.d() * ge_y + g.d() * ef_y) * scale,
                     (e.d() * fg_z + f.d() * ge_z + g.d() * ef_z) * scale);
    CGAL::exact(point);
    return point;
}

/// Moves points onto planes.
class Lifter {
  public:
    Lifter(const std::vector<Plane>& planes, const std::vector<ExactPlane>& exact_planes, double tolerance)
        : planes_(planes), exact_(exact_planes), tolerance_(tolerance) {}

    /// The point near p on up to three of the planes: first those in which facets coincide, as they would not
    /// where a corner is off, then the most populated ones.
    ExactPoint lift(const Vector3d& p, std::vector<std::uint32_t> candidates) const {
        std::ranges::sort(candidates, {}, [&](std::uint32_t i) {
            return std::tuple(!planes_[i].shared, -static_cast<std::ptrdiff_t>(planes_[i].vertices.size()),
                              i);
        });
        std::vector<std::uint32_t> chosen = independent(candidates);
        const ExactPoint start = exact(p);
        for (; !chosen.empty(); chosen.pop_back()) {
            if (std::ranges::all_of(chosen, [&](std::uint32_t i) { return exact_[i].has_on(start); }))
                return start;
            const ExactPoint lifted = meet(complete(p, chosen));
            const Vector3d moved(CGAL::to_double(lifted.x()), CGAL::to_double(lifted.y()),
                                 CGAL::to_double(lifted.z()));
            if ((moved - p).norm() <= 64 * tolerance_) return lifted;
        }
        return start;
    }

  private:
    std::vector<std::uint32_t> independent(const std::vector<std::uint32_t>& candidates) const {
        std::vector<std::uint32_t> chosen;
        for (const auto i : candidates) {
            const Vector3d& n = planes_[i].normal;
            const bool fits =
                chosen.empty() ||
                (chosen.size() == 1 && planes_[chosen[0]].normal.cross(n).norm() > least_sine) ||
                (chosen.size() == 2 &&
                 std::abs(planes_[chosen[0]].normal.cross(planes_[chosen[1]].normal).dot(n)) > least_sine);
            if (fits) chosen.push_back(i);
            if (chosen.size() == 3) break;
        }
        return chosen;
    }

    /// Adds planes through p, across those chosen, so that there are three.
    std::array<ExactPlane, 3> complete(const Vector3d& p, const std::vector<std::uint32_t>& chosen) const {
        std::array<Vector3d, 3> normals;
        std::array<ExactPlane, 3> result;
        for (std::size_t k = 0; k < 3; ++k) {
            if (k < chosen.size()) {
                normals[k] = planes_[chosen[k]].normal;
                result[k] = exact_[chosen[k]];
                continue;
            }
            normals[k] = k == 1 ? normals[0].unitOrthogonal() : normals[0].cross(normals[1]).normalized();
            result[k] = {exact(p), Exact::Vector_3(normals[k].x(), normals[k].y(), normals[k].z())};
        }
        return result;
    }

    const std::vector<Plane>& planes_;
    const std::vector<ExactPlane>& exact_;
    double tolerance_;
};

}  // namespace

bool ExactPositions::coplanar(std::span<const std::uint32_t> asked) const {
    return std::ranges::any_of(planes_of_point[asked[0]],
                               [&](std::uint32_t plane) { return holds(plane, asked); });
}

bool ExactPositions::collinear(std::span<const std::uint32_t> asked) const {
    const Eigen::Vector3d* first = nullptr;
    for (const auto plane : planes_of_point[asked[0]]) {
        if (!holds(plane, asked)) continue;
        if (first && first->cross(normals[plane]).norm() > least_sine) return true;
        if (!first) first = &normals[plane];
    }
    return false;
}

bool ExactPositions::holds(std::uint32_t plane, std::span<const std::uint32_t> asked) const {
    return std::ranges::all_of(
        asked, [&](std::uint32_t p) { return std::ranges::binary_search(planes_of_point[p], plane); });
}

ExactPositions positions_as_given(const FacetComplex& complex) {
    ExactPositions result;
    result.points.reserve(complex.points.size());
    for (const auto& p : complex.points) result.points.push_back(exact(p));
    result.near = complex.points;
    result.planes_of_point.resize(complex.points.size());
    result.plane_of_facet.assign(complex.facets.size(), none);
    return result;
}

ExactPositions positions_on_planes(const FacetComplex& complex, std::span<const Pair> pairs,
                                   double tolerance) {
    ExactPositions result = positions_as_given(complex);
    PlaneFinder finder(complex, tolerance);
    for (const auto facet : largest_first(complex, pairs)) finder.add(facet);
    finder.find_shared();
    for (const auto& [a, b] : pairs) finder.add_contacts(a, b), finder.add_contacts(b, a);
    std::vector<Plane>& planes = finder.planes();
    activate(planes, complex.points.size());

    result.planes.resize(planes.size());
    result.normals.resize(planes.size());
    std::vector<std::vector<std::uint32_t>> candidates(complex.points.size());
    for (std::uint32_t i = 0; i < planes.size(); ++i) {
        if (!planes[i].active) continue;
        result.planes[i] = exact_plane(planes[i], complex);
        result.normals[i] = planes[i].normal;
        for (const auto v : planes[i].vertices) candidates[v].push_back(i);
    }
    const Lifter lifter(planes, result.planes, tolerance);
    for (const auto& p : complex.points) result.slack = std::max(result.slack, p.cwiseAbs().maxCoeff());
    result.slack = 4 * std::numeric_limits<double>::epsilon() * (result.slack + 64 * tolerance);
    for (std::uint32_t v = 0; v < candidates.size(); ++v) {
        if (candidates[v].empty()) continue;
        result.points[v] = lifter.lift(complex.points[v], candidates[v]);
        result.near[v] = approximate(result.points[v], result.slack / 4);
        for (const auto i : candidates[v])
            if (result.planes[i].has_on(result.points[v])) result.planes_of_point[v].push_back(i);
    }
    for (std::uint32_t f = 0; f < complex.facets.size(); ++f) {
        const auto plane = finder.plane_of(f);
        if (plane == none) continue;
        if (result.holds(plane, complex.facets[f].vertices)) result.plane_of_facet[f] = plane;
    }
    return result;
}

}  // namespace maille::modeler::detail
