#include "modeler/arrange_cluster.hh"

#include <algorithm>
#include <map>

#include "modeler/arrange_cut.hh"
#include "modeler/arrange_scene.hh"
#include "volmesh/union_find.hh"

namespace maille::modeler::detail {

namespace {

/// The facets at each edge of the scene.
class EdgeUses {
  public:
    explicit EdgeUses(const FacetComplex& complex) {
        uses_.reserve(3 * complex.facets.size());
        for (std::uint32_t f = 0; f < complex.facets.size(); ++f) {
            const auto& v = complex.facets[f].vertices;
            for (std::size_t k = 0; k < 3; ++k) uses_.push_back({edge_key(v[k], v[(k + 1) % 3]), f});
        }
        std::ranges::sort(uses_);
    }

    /// Calls f(edge, facets at it).
    template <class F>
    void for_each(const F& f) const {
        std::vector<std::uint32_t> facets;
        for (std::size_t i = 0; i < uses_.size();) {
            const auto edge = uses_[i].first;
            facets.clear();
            for (; i < uses_.size() && uses_[i].first == edge; ++i) facets.push_back(uses_[i].second);
            f(edge, facets);
        }
    }

  private:
    std::vector<std::pair<std::uint64_t, std::uint32_t>> uses_;
};

bool runs_along(const Facet& facet, std::uint32_t from, std::uint32_t to) {
    const auto& [a, b, c] = facet.vertices;
    return (a == from && b == to) || (b == from && c == to) || (c == from && a == to);
}

/// Groups the facets that are met by others.
class ClusterFinder {
  public:
    ClusterFinder(const FacetComplex& complex, const ExactPositions& positions, const Contacts& contacts)
        : complex_(complex), positions_(positions), contacts_(contacts), groups_(complex.facets.size()) {
        touched_.resize(complex.facets.size());
        for (std::uint32_t f = 0; f < complex.facets.size(); ++f)
            touched_[f] = !contacts.degenerate[f] && !contacts.segments[f].empty();
        for (const auto& [i, j] : contacts.coplanar) {
            touched_[i] = touched_[j] = true;
            groups_.unite(i, j);
        }
        EdgeUses(complex).for_each([&](std::uint64_t edge, const std::vector<std::uint32_t>& facets) {
            if (facets.size() != 2 || !continues(facets[0], facets[1], edge)) return;
            groups_.unite(facets[0], facets[1]);
            dissolved_.push_back(edge);
        });
    }

    /// The facets of each cluster, in rising order.
    std::vector<std::vector<std::uint32_t>> clusters() {
        std::map<std::uint32_t, std::vector<std::uint32_t>> by_root;
        for (std::uint32_t f = 0; f < touched_.size(); ++f)
            if (touched_[f]) by_root[groups_.find(f)].push_back(f);
        std::vector<std::vector<std::uint32_t>> result;
        for (auto& [root, facets] : by_root) result.push_back(std::move(facets));
        return result;
    }

    /// For each facet the first one of its plane that it hangs together with.
    std::vector<std::uint32_t> plane_of_facet() {
        std::vector<std::uint32_t> planes(touched_.size());
        for (std::uint32_t f = 0; f < planes.size(); ++f) planes[f] = groups_.find(f);
        return planes;
    }
    bool is_touched(std::uint32_t facet) const { return touched_[facet]; }
    /// Edges, rising, across which a facet of a cluster just goes on.
    const std::vector<std::uint64_t>& dissolved() const { return dissolved_; }

  private:
    bool continues(std::uint32_t i, std::uint32_t j, std::uint64_t edge) const {
        if (!touched_[i] || !touched_[j] || std::ranges::binary_search(contacts_.edges, edge)) return false;
        const Facet &f = complex_.facets[i], &g = complex_.facets[j];
        if (f.surface != g.surface || f.front != g.front || f.back != g.back) return false;
        const auto a = static_cast<std::uint32_t>(edge >> 32), b = static_cast<std::uint32_t>(edge);
        if (runs_along(f, a, b) == runs_along(g, a, b)) return false;
        const auto plane = positions_.plane_of_facet[i];
        if (plane != none && plane == positions_.plane_of_facet[j]) return true;
        const auto corner = [&](std::size_t k) -> const ExactPoint& {
            return positions_.points[f.vertices[k]];
        };
        return std::ranges::all_of(g.vertices, [&](std::uint32_t v) {
            return v == a || v == b ||
                   CGAL::orientation(corner(0), corner(1), corner(2), positions_.points[v]) == CGAL::ZERO;
        });
    }

    const FacetComplex& complex_;
    const ExactPositions& positions_;
    const Contacts& contacts_;
    volmesh::UnionFind groups_;
    std::vector<bool> touched_;
    std::vector<std::uint64_t> dissolved_;
};

/// Sums the windings of each primitive, turns the sheet so that the first is positive, and adds it with its
/// pieces. A sheet that makes no difference is left out.
void add_sheet(Subdivision& result, std::uint32_t cluster, std::vector<Cover> covers,
               std::span<const std::array<std::uint32_t, 3>> triangles) {
    std::ranges::sort(covers, {}, [](const Cover& c) { return std::tuple(c.primitive, c.facet, c.winding); });
    Sheet sheet{cluster, false, static_cast<std::uint32_t>(result.covers.size()), 0};
    for (std::size_t i = 0; i < covers.size();) {
        std::size_t end = i;
        int sum = 0;
        for (; end < covers.size() && covers[end].primitive == covers[i].primitive; ++end)
            sum += covers[end].winding;
        if (sum != 0) {
            while (covers[i].winding * sum < 0) ++i;
            result.covers.push_back({covers[i].primitive, sum, covers[i].facet});
        }
        i = end;
    }
    sheet.end_cover = static_cast<std::uint32_t>(result.covers.size());
    if (sheet.first_cover == sheet.end_cover) return;
    sheet.mirrored = result.covers[sheet.first_cover].winding < 0;
    if (sheet.mirrored)
        for (auto i = sheet.first_cover; i < sheet.end_cover; ++i) result.covers[i].winding *= -1;
    for (const auto& [a, b, c] : triangles)
        result.pieces.push_back({sheet.mirrored ? std::array{a, c, b} : std::array{a, b, c},
                                 static_cast<std::uint32_t>(result.sheets.size())});
    result.sheets.push_back(sheet);
}

/// What a facet does to the winding numbers, seen along its normal (`side` 1) or against it (-1).
void add_covers(std::vector<Cover>& covers, const FacetComplex& complex, std::uint32_t facet, int side) {
    const Facet& f = complex.facets[facet];
    if (f.back != outside) covers.push_back({f.back, side, facet});
    if (f.front != outside) covers.push_back({f.front, -side, facet});
}

}  // namespace

Subdivision subdivide(const FacetComplex& complex, const ExactPositions& positions, const Contacts& contacts,
                      PointRegistry& registry) {
    ClusterFinder finder(complex, positions, contacts);
    Subdivision result;
    std::vector<Cover> covers;
    for (std::uint32_t f = 0; f < complex.facets.size(); ++f) {
        if (finder.is_touched(f) || contacts.degenerate[f]) continue;
        covers.clear();
        add_covers(covers, complex, f, 1);
        add_sheet(result, none, covers, std::span(&complex.facets[f].vertices, 1));
    }
    PlaneCrossings crossings(finder.plane_of_facet());
    for (auto& facets : finder.clusters()) {
        const auto number = static_cast<std::uint32_t>(result.clusters.size());
        PlaneCut cut = guarded(complex, facets, [&] {
            return cut_plane(complex, positions, contacts, facets, finder.dissolved(), crossings, registry);
        });
        for (const PlaneCut::Part& part : cut.parts) {
            covers.clear();
            for (const auto& [facet, side] : part.facets) add_covers(covers, complex, facet, side);
            add_sheet(result, number, covers, part.triangles);
        }
        result.clusters.push_back({std::move(facets), cut.projection});
    }
    return result;
}

}  // namespace maille::modeler::detail
