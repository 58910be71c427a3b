#include "modeler/arrange_self_intersection.hh"

#include <algorithm>
#include <array>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "modeler/arrange_boxes.hh"

namespace maille::modeler {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Corners = std::array<std::uint32_t, 3>;

class Checker {
  public:
    explicit Checker(const FacetComplex& complex) : complex_(complex) {
        points_.reserve(complex.points.size());
        for (const auto& p : complex.points) points_.emplace_back(p.x(), p.y(), p.z());
    }

    bool is_degenerate(std::uint32_t facet) const {
        const auto& [a, b, c] = corners(facet);
        return CGAL::collinear(points_[a], points_[b], points_[c]);
    }

    /// Whether two facets that are not degenerate meet elsewhere than in a common vertex or edge.
    bool collide(std::uint32_t i, std::uint32_t j) const {
        Corners a = corners(i), b = corners(j);
        switch (bring_common_corners_to_front(a, b)) {
            case 0:
                return CGAL::do_intersect(triangle(a), triangle(b));
            case 1:
                return hits(a[1], a[2], b) || hits(b[1], b[2], a);
            case 2:
                return fold(a, b);
            default:
                return true;
        }
    }

  private:
    const Corners& corners(std::uint32_t facet) const { return complex_.facets[facet].vertices; }
    Kernel::Triangle_3 triangle(const Corners& c) const {
        return {points_[c[0]], points_[c[1]], points_[c[2]]};
    }

    static int bring_common_corners_to_front(Corners& a, Corners& b) {
        int n = 0;
        for (int k = n; k < 3; ++k) {
            const auto at = std::find(b.begin() + n, b.end(), a[k]);
            if (at == b.end()) continue;
            std::iter_swap(at, b.begin() + n);
            std::swap(a[k], a[n++]);
        }
        return n;
    }

    bool hits(std::uint32_t p, std::uint32_t q, const Corners& c) const {
        return CGAL::do_intersect(Kernel::Segment_3(points_[p], points_[q]), triangle(c));
    }

    /// Facets with a common edge overlap when both lie in one plane on the same side of it.
    bool fold(const Corners& a, const Corners& b) const {
        const Point &p = points_[a[0]], &q = points_[a[1]], &r = points_[a[2]], &s = points_[b[2]];
        return CGAL::orientation(p, q, r, s) == CGAL::COPLANAR &&
               CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
    }

    const FacetComplex& complex_;
    std::vector<Point> points_;
};

std::vector<detail::Pair> near_facets(const FacetComplex& complex) {
    return detail::pairs_of_near_facets(complex, 0, [](auto, auto) { return true; });
}

/// Calls `report` for each self-intersection until it returns false.
template <class Report>
void search(const FacetComplex& complex, const Report& report) {
    const Checker checker(complex);
    std::vector<bool> degenerate(complex.facets.size());
    for (std::uint32_t i = 0; i < complex.facets.size(); ++i) {
        degenerate[i] = checker.is_degenerate(i);
        if (degenerate[i] && !report(i, i)) return;
    }
    for (const auto& [i, j] : near_facets(complex))
        if (!degenerate[i] && !degenerate[j] && checker.collide(i, j) && !report(i, j)) return;
}

}  // namespace

std::optional<SelfIntersection> find_self_intersection(const FacetComplex& complex) {
    std::optional<SelfIntersection> found;
    search(complex, [&](std::uint32_t i, std::uint32_t j) {
        found = SelfIntersection{i, j};
        return false;
    });
    return found;
}

std::vector<SelfIntersection> find_self_intersections(const FacetComplex& complex) {
    std::vector<SelfIntersection> found;
    search(complex, [&](std::uint32_t i, std::uint32_t j) {
        found.push_back({i, j});
        return true;
    });
    std::ranges::sort(found, {}, [](const SelfIntersection& s) { return std::pair(s.first, s.second); });
    return found;
}

}  // namespace maille::modeler
