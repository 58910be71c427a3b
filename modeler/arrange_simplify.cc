#include "modeler/arrange_simplify.hh"

#include <algorithm>
#include <map>

#include "modeler/arrange_features.hh"
#include "modeler/arrange_fill.hh"

namespace maille::modeler::detail {

namespace {

/// The cover that gives a sheet its surface: of the earliest primitive that owns a side, or else the earliest
/// of all.
const Cover& leading_cover(std::span<const Cover> covers, const Sides& sides) {
    for (const Cover& c : covers)
        if (c.primitive == sides.front || c.primitive == sides.back) return c;
    return covers.front();
}

/// Collects the sheets to keep, and those of one cluster that look alike as one group.
KeptSheets keep(const Subdivision& subdivision, const std::vector<Sides>& sides, const Scene& scene) {
    KeptSheets kept;
    std::map<std::tuple<std::uint32_t, Region, Region, std::uint32_t>, std::uint32_t> groups;
    kept.group_of.assign(subdivision.sheets.size(), none);
    for (std::uint32_t s = 0; s < subdivision.sheets.size(); ++s) {
        if (sides[s].front == sides[s].back) continue;
        const Sheet& sheet = subdivision.sheets[s];
        const Cover& cover = leading_cover(subdivision.covers_of(sheet), sides[s]);
        const Facet& facet = scene.complex.facets[cover.facet];
        Group group{sheet.cluster, sides[s], cover.primitive, facet.surface, scene.parents[cover.facet]};
        if (sheet.mirrored) std::swap(group.sides.front, group.sides.back);
        kept.group_of[s] = static_cast<std::uint32_t>(kept.groups.size());
        if (sheet.cluster != none) {
            const auto [at, is_new] = groups.try_emplace(
                {sheet.cluster, group.sides.front, group.sides.back, group.surface}, kept.group_of[s]);
            kept.group_of[s] = at->second;
            if (!is_new) continue;
        }
        kept.groups.push_back(group);
    }
    return kept;
}

/// Puts the facets together. Between a region and the outside the normal points outwards; between two
/// regions, into the later one.
class Collector {
  public:
    Collector(const Scene& scene, const PointRegistry& registry)
        : scene_(scene), registry_(registry), new_number_(registry.size(), none) {}

    void add(const std::array<std::uint32_t, 3>& corners, const Group& group, const FacetParent& parent) {
        Facet facet{corners, group.surface, group.sides.front, group.sides.back};
        if (facet.back == outside || (facet.front != outside && facet.front < facet.back)) {
            std::swap(facet.front, facet.back);
            std::swap(facet.vertices[1], facet.vertices[2]);
        }
        for (const auto v : corners) new_number_[v] = 0;
        result_.complex.facets.push_back(facet);
        result_.parents.push_back(parent);
    }

    Arrangement finish() {
        auto& points = result_.complex.points;
        for (std::uint32_t v = 0; v < new_number_.size(); ++v) {
            if (new_number_[v] == none) continue;
            new_number_[v] = static_cast<std::uint32_t>(points.size());
            points.push_back(v < scene_.complex.points.size() ? scene_.complex.points[v]
                                                              : rounded(registry_[v]));
        }
        for (Facet& f : result_.complex.facets)
            for (auto& v : f.vertices) v = new_number_[v];
        return std::move(result_);
    }

  private:
    /// To the last bit or two; a lazy number's own conversion is too coarse.
    static Eigen::Vector3d rounded(const ExactPoint& p) {
        const auto& exact = CGAL::exact(p);
        return {CGAL::to_double(exact.x()), CGAL::to_double(exact.y()), CGAL::to_double(exact.z())};
    }

    const Scene& scene_;
    const PointRegistry& registry_;
    std::vector<std::uint32_t> new_number_;
    Arrangement result_;
};

/// The facets of a cluster by their corners: a triangle may have come out as it was.
std::map<std::array<std::uint32_t, 3>, std::uint32_t> facets_by_corners(const Cluster& cluster,
                                                                        const Scene& scene) {
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> result;
    for (const auto f : cluster.facets) {
        auto corners = scene.complex.facets[f].vertices;
        std::ranges::sort(corners);
        result.try_emplace(corners, f);
    }
    return result;
}

}  // namespace

Arrangement simplify(const Subdivision& subdivision, const std::vector<Sides>& sides, const Scene& scene,
                     const PointRegistry& registry) {
    const KeptSheets kept = keep(subdivision, sides, scene);
    const Features features(subdivision, kept, scene.complex, registry);
    Collector collector(scene, registry);
    for (const Piece& piece : subdivision.pieces) {
        const auto group = kept.group_of[piece.sheet];
        if (group != none && kept.groups[group].cluster == none)
            collector.add(piece.corners, kept.groups[group], kept.groups[group].parent);
    }
    for (std::uint32_t c = 0; c < subdivision.clusters.size(); ++c) {
        if (features.outlines()[c].empty()) continue;
        const Cluster& cluster = subdivision.clusters[c];
        const auto unchanged = facets_by_corners(cluster, scene);
        const auto filled = guarded(scene.complex, cluster.facets, [&] {
            return fill(features.outlines()[c], features.points()[c], cluster, registry);
        });
        for (const auto& [corners, group] : filled) {
            auto sorted = corners;
            std::ranges::sort(sorted);
            const auto at = unchanged.find(sorted);
            collector.add(corners, kept.groups[group],
                          at == unchanged.end() ? kept.groups[group].parent : scene.parents[at->second]);
        }
    }
    return collector.finish();
}

}  // namespace maille::modeler::detail
