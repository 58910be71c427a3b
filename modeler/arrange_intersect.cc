#include "modeler/arrange_intersect.hh"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <unordered_map>

#include "modeler/arrange_filter.hh"
#include "modeler/arrange_projection.hh"
#include "modeler/arrange_scene.hh"

namespace maille::modeler::detail {

namespace {

using Corners = std::array<std::uint32_t, 3>;
using Signs = std::array<CGAL::Sign, 3>;

class Intersector {
  public:
    Intersector(const FacetComplex& complex, const ExactPositions& positions, PointRegistry& registry)
        : complex_(complex), positions_(positions), registry_(registry) {
        contacts_.segments.resize(complex.facets.size());
        contacts_.degenerate = degenerate_facets(complex, positions);
    }

    void intersect(std::uint32_t i, std::uint32_t j) {
        if (contacts_.degenerate[i] || contacts_.degenerate[j]) {
            if (!contacts_.degenerate[j]) place_corners(i, j);
            if (!contacts_.degenerate[i]) place_corners(j, i);
            return;
        }
        if (is_beyond(i, j) || is_beyond(j, i)) return;
        const Signs si = sides(i, j);
        if (on_one_side(si)) return;
        const Signs sj = sides(j, i);
        if (on_one_side(sj)) return;
        if (si == Signs{CGAL::ZERO, CGAL::ZERO, CGAL::ZERO}) {
            if (overlap(i, j)) contacts_.coplanar.emplace_back(i, j);
            return;
        }
        common_.clear();
        collect(i, si, j);
        collect(j, sj, i);
        if (common_.empty()) return;
        const auto edge_of_i = edge_in_plane(i, si), edge_of_j = edge_in_plane(j, sj);
        add({{common_.front(), common_.back()}, edge_of_i != 0 ? edge_of_i : edge_of_j, j}, i);
        add({{common_.front(), common_.back()}, edge_of_j != 0 ? edge_of_j : edge_of_i, i}, j);
    }

    Contacts take() {
        sort_unique(contacts_.edges);
        sort_unique(contacts_.on_edges);
        return std::move(contacts_);
    }

  private:
    static void sort_unique(auto& values) {
        std::ranges::sort(values);
        values.erase(std::unique(values.begin(), values.end()), values.end());
    }

    const Corners& corners(std::uint32_t facet) const { return complex_.facets[facet].vertices; }
    const ExactPoint& point(std::uint32_t v) const { return positions_.points[v]; }

    /// Orientation of four of the scene's points. What is known to be zero is not computed.
    CGAL::Sign orientation(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
        if (a == b || a == c || a == d || b == c || b == d || c == d) return CGAL::ZERO;
        const auto& near = positions_.near;
        const int certain = certain_orientation(near[a], near[b], near[c], near[d], positions_.slack);
        if (certain != 0) return CGAL::sign(certain);
        if (positions_.coplanar(std::array{a, b, c, d})) return CGAL::ZERO;
        return CGAL::orientation(point(a), point(b), point(c), point(d));
    }

    /// On which side of the plane of facet j the corners of i are.
    Signs sides(std::uint32_t i, std::uint32_t j) const {
        const auto& [a, b, c] = corners(j);
        Signs s{};
        for (std::size_t k = 0; k < 3; ++k) s[k] = orientation(a, b, c, corners(i)[k]);
        return s;
    }

    /// Whether all corners of i are on one side of facet j, for sure: most pairs end here.
    bool is_beyond(std::uint32_t i, std::uint32_t j) const {
        const auto& near = positions_.near;
        const auto& [a, b, c] = corners(j);
        int sum = 0;
        for (const auto v : corners(i))
            sum += certain_orientation(near[a], near[b], near[c], near[v], positions_.slack);
        return std::abs(sum) == 3;
    }

    static bool on_one_side(const Signs& s) { return s[0] != CGAL::ZERO && s[0] == s[1] && s[1] == s[2]; }

    /// Adds the points in which the boundary of facet i, whose corners have these sides, meets facet j.
    void collect(std::uint32_t i, const Signs& s, std::uint32_t j) {
        const Corners& c = corners(i);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            if (s[k] == CGAL::ZERO && holds(j, c[k])) note(c[k]);
            if (s[k] * s[next] < 0) {
                const auto p = crossing(c[k], c[next], j);
                if (p != none) note(p);
            }
        }
    }

    /// The points of a contact lie on a line, and no more than two are different.
    void note(std::uint32_t p) {
        if (std::ranges::find(common_, p) == common_.end()) common_.push_back(p);
    }

    /// The edge of facet i that lies in the plane that its corners are on these sides of, or 0.
    std::uint64_t edge_in_plane(std::uint32_t i, const Signs& s) const {
        const Corners& c = corners(i);
        for (std::size_t k = 0; k < 3; ++k)
            if (s[k] != CGAL::ZERO && s[(k + 1) % 3] == CGAL::ZERO && s[(k + 2) % 3] == CGAL::ZERO)
                return edge_key(c[(k + 1) % 3], c[(k + 2) % 3]);
        return 0;
    }

    /// Whether point v, which lies in the plane of the facet, lies in the facet.
    bool holds(std::uint32_t facet, std::uint32_t v) {
        const Corners& c = corners(facet);
        if (std::ranges::find(c, v) != c.end()) return true;
        const Projection projection(point(c[0]), point(c[1]), point(c[2]));
        Signs s{};
        for (std::size_t k = 0; k < 3; ++k) {
            s[k] = turn(projection, c[k], c[(k + 1) % 3], v);
            if (have_both_signs(s)) return false;
        }
        note_on_edges(c, s, v);
        return true;
    }

    static bool have_both_signs(const Signs& s) {
        return std::ranges::find(s, CGAL::POSITIVE) != s.end() &&
               std::ranges::find(s, CGAL::NEGATIVE) != s.end();
    }

    /// Point p of a facet lies on those of its edges that it is on neither side of.
    void note_on_edges(const Corners& c, const Signs& s, std::uint32_t p) {
        for (std::size_t k = 0; k < 3; ++k)
            if (s[k] == CGAL::ZERO) contacts_.on_edges.emplace_back(edge_key(c[k], c[(k + 1) % 3]), p);
    }

    /// Orientation of three points of one plane.
    CGAL::Sign turn(const Projection& projection, std::uint32_t a, std::uint32_t b, std::uint32_t v) const {
        if (positions_.collinear(std::array{a, b, v})) return CGAL::ZERO;
        return CGAL::orientation(projection(point(a)), projection(point(b)), projection(point(v)));
    }

    /// The point in which an edge, whose ends are on different sides of the facet's plane, meets the facet,
    /// or none.
    std::uint32_t crossing(std::uint32_t a, std::uint32_t b, std::uint32_t facet) {
        if (a > b) std::swap(a, b);
        const auto edge =
            edges_.try_emplace(edge_key(a, b), static_cast<std::uint32_t>(edges_.size())).first->second;
        const auto [at, is_new] = crossings_.try_emplace(std::uint64_t{edge} << 32 | facet, none);
        const Corners& c = corners(facet);
        if (const auto s = is_new ? pierces(a, b, c) : std::nullopt) {
            at->second = registry_.add(construct_crossing(a, b, facet));
            contacts_.on_edges.emplace_back(edge_key(a, b), at->second);
            note_on_edges(c, *s, at->second);
        }
        return at->second;
    }

    /// On which sides of the edge those of the facet with these corners run; nothing where it misses them.
    std::optional<Signs> pierces(std::uint32_t a, std::uint32_t b, const Corners& c) const {
        Signs s{};
        for (std::size_t k = 0; k < 3; ++k) {
            s[k] = orientation(a, b, c[k], c[(k + 1) % 3]);
            if (have_both_signs(s)) return std::nullopt;
        }
        return s;
    }

    ExactPoint construct_crossing(std::uint32_t a, std::uint32_t b, std::uint32_t facet) const {
        const auto construct = Exact().construct_plane_line_intersection_point_3_object();
        const auto plane = positions_.plane_of_facet[facet];
        if (plane != none) return construct(positions_.planes[plane], point(a), point(b));
        const Corners& c = corners(facet);
        return construct(point(c[0]), point(c[1]), point(c[2]), point(a), point(b));
    }

    bool overlap(std::uint32_t i, std::uint32_t j) const {
        const Corners &a = corners(i), &b = corners(j);
        const Projection flat(point(a[0]), point(a[1]), point(a[2]));
        const auto triangle = [&](const Corners& c) {
            return Exact::Triangle_2(flat(point(c[0])), flat(point(c[1])), flat(point(c[2])));
        };
        return CGAL::do_intersect(triangle(a), triangle(b));
    }

    /// Puts the corners of a facet without area on another facet.
    void place_corners(std::uint32_t degenerate, std::uint32_t facet) {
        const auto& [a, b, c] = corners(facet);
        for (const auto v : corners(degenerate))
            if (orientation(a, b, c, v) == CGAL::ZERO && holds(facet, v)) add({{v, v}, 0, degenerate}, facet);
    }

    void add(const Contacts::Segment& segment, std::uint32_t facet) {
        const Corners& c = corners(facet);
        const auto is_corner = [&](std::uint32_t p) { return std::ranges::find(c, p) != c.end(); };
        const auto& [p, q] = segment.ends;
        if (!is_corner(p) || !is_corner(q))
            contacts_.segments[facet].push_back(segment);
        else if (p != q)
            contacts_.edges.push_back(edge_key(p, q));
    }

    const FacetComplex& complex_;
    const ExactPositions& positions_;
    PointRegistry& registry_;
    Contacts contacts_;
    std::vector<std::uint32_t> common_;
    std::unordered_map<std::uint64_t, std::uint32_t> edges_;
    std::unordered_map<std::uint64_t, std::uint32_t> crossings_;  ///< by edge and facet
};

}  // namespace

std::vector<bool> degenerate_facets(const FacetComplex& complex, const ExactPositions& positions) {
    std::vector<bool> result(complex.facets.size());
    for (std::uint32_t i = 0; i < complex.facets.size(); ++i) {
        const auto& [a, b, c] = complex.facets[i].vertices;
        const Eigen::Vector3d u = complex.points[b] - complex.points[a],
                              v = complex.points[c] - complex.points[a];
        const bool clearly_not = u.cross(v).norm() > 1e-6 * std::max(u.squaredNorm(), v.squaredNorm());
        result[i] =
            !clearly_not && CGAL::collinear(positions.points[a], positions.points[b], positions.points[c]);
    }
    return result;
}

Contacts intersect(const FacetComplex& complex, const ExactPositions& positions, std::span<const Pair> pairs,
                   PointRegistry& registry) {
    Intersector intersector(complex, positions, registry);
    for (const auto& [i, j] : pairs) guarded(complex, std::array{i, j}, [&] { intersector.intersect(i, j); });
    return intersector.take();
}

}  // namespace maille::modeler::detail
