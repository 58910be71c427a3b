#include "modeler/arrange_coarsen.hh"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>

#include <Eigen/Geometry>

#include "modeler/arrange_kernel.hh"
#include "modeler/arrange_outline.hh"

namespace maille::modeler::detail {

namespace {

using Eigen::Vector3d;

/// One primitive of a scene: its facets are a run of the scene's.
class Primitive {
  public:
    Primitive(const FacetComplex& complex, std::uint32_t first, std::uint32_t end, double tolerance)
        : complex_(complex), first_(first), end_(end), tolerance_(tolerance), patch_of_(end - first, none) {
        for (std::uint32_t f = first; f < end; ++f)
            for (std::size_t k = 0; k < 3; ++k) sides_.push_back({edge_key(from(f, k), to(f, k)), f});
        std::ranges::sort(sides_);
    }

    void find_patches() {
        std::vector<std::pair<double, std::uint32_t>> order;
        for (auto f = first_; f < end_; ++f) order.emplace_back(-area_vector(f).norm(), f);
        std::ranges::sort(order);
        for (const auto& [area, seed] : order)
            if (patch_of_[seed - first_] == none) flood(seed);
        for (Patch& patch : patches_) std::ranges::sort(patch.facets);
    }

    /// The straight lines of borders: what lies between their ends is to be left out.
    void find_chains() {
        std::map<std::uint32_t, std::vector<std::uint32_t>> neighbors;  // along borders
        for_each_border([&](std::uint32_t a, std::uint32_t b) {
            neighbors[a].push_back(b);
            neighbors[b].push_back(a);
        });
        const auto goes_on = [&](std::uint32_t v) {
            const auto& n = neighbors.at(v);
            return n.size() == 2 && is_between(n[0], v, n[1]);
        };
        for (const auto& [start, next_points] : neighbors) {
            if (goes_on(start)) continue;
            for (const auto next : next_points) {
                Chain chain{{start, next}};
                while (goes_on(chain.points.back())) {
                    const auto& n = neighbors.at(chain.points.back());
                    chain.points.push_back(n[0] == chain.points.rbegin()[1] ? n[1] : n[0]);
                }
                if (chain.points.size() > 2 && is_straight(chain) &&
                    std::pair(start, next) < std::pair(chain.points.back(), chain.points.rbegin()[1]))
                    chains_.push_back(std::move(chain));
            }
        }
    }

    /// The patches in fewer triangles, or nothing where one cannot be cut so.
    std::optional<std::vector<std::pair<std::uint32_t, Facet>>> coarse_facets() const {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>
            shortcut;  // first edge to last point
        std::vector<std::uint32_t> skipped;
        for (const Chain& chain : chains_) {
            const auto& p = chain.points;
            shortcut[{p[0], p[1]}] = p.back();
            shortcut[{p.back(), p[p.size() - 2]}] = p[0];
            skipped.insert(skipped.end(), p.begin() + 1, p.end() - 1);
        }
        std::ranges::sort(skipped);
        std::vector<std::vector<std::array<std::uint32_t, 2>>> outlines(patches_.size());
        for (std::uint32_t f = first_; f < end_; ++f)
            for (std::size_t k = 0; k < 3; ++k) {
                const auto a = from(f, k), b = to(f, k);
                if (!is_border(edge_key(a, b)) || std::ranges::binary_search(skipped, a)) continue;
                const auto at = shortcut.find({a, b});
                outlines[patch_of_[f - first_]].push_back({a, at == shortcut.end() ? b : at->second});
            }
        std::vector<std::pair<std::uint32_t, Facet>> result;
        for (std::uint32_t p = 0; p < patches_.size(); ++p) {
            const auto seed = patches_[p].facets.front();
            if (patches_[p].facets.size() == 1 && outlines[p].size() == 3) {
                result.emplace_back(p, complex_.facets[seed]);
                continue;
            }
            const auto triangles = fill(patches_[p], outlines[p]);
            if (!triangles) return std::nullopt;
            for (const auto& corners : *triangles) {
                Facet facet = complex_.facets[seed];
                facet.vertices = corners;
                result.emplace_back(p, facet);
            }
        }
        return result;
    }

    std::vector<Patch>& patches() { return patches_; }
    std::vector<Chain>& chains() { return chains_; }
    std::uint32_t patch_of(std::uint32_t facet) const { return patch_of_[facet - first_]; }

    /// The points on no border, rising.
    std::vector<std::uint32_t> inner_points() const {
        std::vector<std::uint32_t> all, at_borders, result;
        for (auto f = first_; f < end_; ++f)
            for (const auto v : complex_.facets[f].vertices) all.push_back(v);
        for_each_border([&](std::uint32_t a, std::uint32_t b) {
            at_borders.push_back(a);
            at_borders.push_back(b);
        });
        for (auto* list : {&all, &at_borders}) {
            std::ranges::sort(*list);
            list->erase(std::unique(list->begin(), list->end()), list->end());
        }
        std::ranges::set_difference(all, at_borders, std::back_inserter(result));
        return result;
    }

  private:
    std::uint32_t from(std::uint32_t f, std::size_t k) const { return complex_.facets[f].vertices[k]; }
    std::uint32_t to(std::uint32_t f, std::size_t k) const {
        return complex_.facets[f].vertices[(k + 1) % 3];
    }
    const Vector3d& point(std::uint32_t v) const { return complex_.points[v]; }

    Vector3d area_vector(std::uint32_t f) const {
        const auto& [a, b, c] = complex_.facets[f].vertices;
        return (point(b) - point(a)).cross(point(c) - point(a));
    }

    auto facets_at(std::uint64_t edge) const {
        return std::ranges::equal_range(sides_, edge, {}, [](const auto& side) { return side.first; });
    }

    bool is_border(std::uint64_t edge) const {
        const auto facets = facets_at(edge);
        return facets.size() != 2 ||
               patch_of_[facets[0].second - first_] != patch_of_[facets[1].second - first_];
    }

    template <class F>
    void for_each_border(const F& f) const {
        for (std::size_t i = 0; i < sides_.size(); ++i)
            if ((i == 0 || sides_[i - 1].first != sides_[i].first) && is_border(sides_[i].first))
                f(static_cast<std::uint32_t>(sides_[i].first >> 32),
                  static_cast<std::uint32_t>(sides_[i].first));
    }

    void flood(std::uint32_t seed) {
        const auto number = static_cast<std::uint32_t>(patches_.size());
        const Vector3d normal = area_vector(seed).normalized();
        const Vector3d& origin = point(from(seed, 0));
        patches_.push_back({normal, {seed}});
        patch_of_[seed - first_] = number;
        if (!(normal.squaredNorm() > 0.5)) return;  // no area, no plane
        const auto belongs = [&](std::uint32_t f) {
            return patch_of_[f - first_] == none &&
                   complex_.facets[f].surface == complex_.facets[seed].surface &&
                   area_vector(f).normalized().dot(normal) > 0.9 &&
                   std::ranges::all_of(complex_.facets[f].vertices, [&](std::uint32_t v) {
                       return std::abs(normal.dot(point(v) - origin)) <= tolerance_;
                   });
        };
        auto& facets = patches_.back().facets;
        for (std::size_t i = 0; i < facets.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                const auto a = from(facets[i], k), b = to(facets[i], k);
                const auto at_edge = facets_at(edge_key(a, b));
                if (at_edge.size() != 2) continue;
                const auto next = at_edge[at_edge[0].second == facets[i]].second;
                if (!belongs(next)) continue;
                patch_of_[next - first_] = number;
                facets.push_back(next);
            }
    }

    bool is_between(std::uint32_t a, std::uint32_t v, std::uint32_t b) const {
        const Vector3d p = point(v) - point(a), q = point(b) - point(v);
        return p.dot(q) > 0 && p.cross(q).norm() <= tolerance_ * std::min(p.norm(), q.norm());
    }

    bool is_straight(const Chain& chain) const {
        const Vector3d &a = point(chain.points.front()), &b = point(chain.points.back());
        const Vector3d direction = (b - a).normalized();
        double reached = 0;
        for (std::size_t i = 1; i < chain.points.size(); ++i) {
            const Vector3d p = point(chain.points[i]) - a;
            if (p.dot(direction) <= reached || p.cross(direction).norm() > tolerance_) return false;
            reached = p.dot(direction);
        }
        return true;
    }

    std::optional<std::vector<std::array<std::uint32_t, 3>>> fill(
        const Patch& patch, const std::vector<std::array<std::uint32_t, 2>>& outline) const {
        std::vector<std::uint32_t> used;
        for (const auto& edge : outline) used.insert(used.end(), edge.begin(), edge.end());
        std::ranges::sort(used);
        used.erase(std::unique(used.begin(), used.end()), used.end());
        const auto local = [&](std::uint32_t v) {
            return static_cast<std::uint32_t>(std::ranges::lower_bound(used, v) - used.begin());
        };
        const FlatView view(patch.normal);
        std::vector<Eigen::Vector2d> flat;
        for (const auto v : used) flat.push_back(view(point(v)));
        std::vector<FlatEdge> edges;
        for (const auto& [a, b] : outline) edges.push_back({local(a), local(b), 0});
        const auto triangles = triangulate(flat, edges);
        if (!triangles) return std::nullopt;
        std::vector<std::array<std::uint32_t, 3>> result;
        for (const auto& [corners, region] : *triangles)
            result.push_back({used[corners[0]], used[corners[1]], used[corners[2]]});
        return result;
    }

    const FacetComplex& complex_;
    std::uint32_t first_, end_;
    double tolerance_;
    std::vector<std::uint32_t> patch_of_;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> sides_;  ///< edge and facet
    std::vector<Patch> patches_;
    std::vector<Chain> chains_;
};

/// The primitive with every facet as a patch of its own.
void append_as_is(CoarseScene& result, const Scene& scene, std::uint32_t first, std::uint32_t end) {
    const auto& p = scene.complex.points;
    for (auto f = first; f < end; ++f) {
        const auto& [a, b, c] = scene.complex.facets[f].vertices;
        result.patch_of.push_back(static_cast<std::uint32_t>(result.patches.size()));
        result.patches.push_back({(p[b] - p[a]).cross(p[c] - p[a]).normalized(), {f}});
        result.scene.complex.facets.push_back(scene.complex.facets[f]);
        result.scene.parents.push_back(scene.parents[f]);
    }
}

void append(CoarseScene& result, const Scene& scene, std::uint32_t first, std::uint32_t end,
            double tolerance) {
    Primitive primitive(scene.complex, first, end, tolerance);
    primitive.find_patches();
    primitive.find_chains();
    const auto coarse = primitive.coarse_facets();
    if (!coarse) return append_as_is(result, scene, first, end);
    const auto n_patches = static_cast<std::uint32_t>(result.patches.size());
    for (auto f = first; f < end; ++f) result.patch_of.push_back(n_patches + primitive.patch_of(f));
    for (const auto& [patch, facet] : *coarse) {
        result.scene.complex.facets.push_back(facet);
        result.scene.parents.push_back(scene.parents[primitive.patches()[patch].facets.front()]);
    }
    std::ranges::move(primitive.patches(), std::back_inserter(result.patches));
    std::ranges::move(primitive.chains(), std::back_inserter(result.chains));
    std::ranges::copy(primitive.inner_points(), std::back_inserter(result.inner_points));
}

}  // namespace

CoarseScene coarsen(const Scene& scene, double tolerance) {
    CoarseScene result;
    result.scene.complex.points = scene.complex.points;
    const auto& facets = scene.complex.facets;
    for (std::uint32_t first = 0; first < facets.size();) {
        auto end = first;
        while (end < facets.size() && facets[end].back == facets[first].back) ++end;
        append(result, scene, first, end, tolerance);
        first = end;
    }
    return result;
}

}  // namespace maille::modeler::detail
