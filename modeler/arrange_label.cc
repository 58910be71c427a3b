#include "modeler/arrange_label.hh"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <stdexcept>

#include "modeler/arrange_filter.hh"
#include "modeler/arrange_ray.hh"
#include "modeler/arrange_scene.hh"
#include "volmesh/union_find.hh"

namespace maille::modeler::detail {

namespace {

bool same_covers(std::span<const Cover> a, std::span<const Cover> b) {
    return std::ranges::equal(a, b, [](const Cover& x, const Cover& y) {
        return x.primitive == y.primitive && x.winding == y.winding;
    });
}

/// Joins sheets that go on as one surface, with nothing else at the edge between them: they separate the same
/// cells.
volmesh::UnionFind find_patches(const Subdivision& subdivision) {
    struct Use {
        std::uint64_t edge;
        std::uint32_t sheet;
        bool rising;
        auto operator<=>(const Use&) const = default;
    };
    std::vector<Use> uses;
    uses.reserve(3 * subdivision.pieces.size());
    for (const Piece& piece : subdivision.pieces)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto a = piece.corners[k], b = piece.corners[(k + 1) % 3];
            uses.push_back({edge_key(a, b), piece.sheet, a < b});
        }
    std::ranges::sort(uses);
    volmesh::UnionFind patches(subdivision.sheets.size());
    for (std::size_t i = 0; i < uses.size();) {
        std::size_t end = i;
        while (end < uses.size() && uses[end].edge == uses[i].edge) ++end;
        if (end - i == 2 && uses[i].rising != uses[i + 1].rising &&
            same_covers(subdivision.covers_of(subdivision.sheets[uses[i].sheet]),
                        subdivision.covers_of(subdivision.sheets[uses[i + 1].sheet])))
            patches.unite(uses[i].sheet, uses[i + 1].sheet);
        i = end;
    }
    return patches;
}

/// Finds how often each primitive winds around a place, by rays.
class Labeller {
  public:
    Labeller(const Subdivision& subdivision, const FacetComplex& scene, const ExactPositions& positions,
             const PointRegistry& registry, const CsgTree& tree)
        : subdivision_(subdivision),
          scene_(scene),
          positions_(positions),
          registry_(registry),
          tree_(tree),
          boxes_(facet_boxes(scene)),
          length_(4 * diagonal(scene)),
          slack_(std::max(positions.slack, 4 * std::numeric_limits<double>::epsilon() * reach(scene))),
          degenerate_(degenerate_facets(scene, positions)) {
        Region last = outside;
        for (const Facet& f : scene.facets) last = std::max({last, f.front, f.back});
        windings_.resize(static_cast<std::size_t>(last + 1));
    }

    /// The sides of the sheet of a piece.
    Sides sides_of(const Piece& piece) {
        const auto covers = subdivision_.covers_of(subdivision_.sheets[piece.sheet]);
        for (int attempt = 0; attempt < max_ray_attempts; ++attempt) {
            std::ranges::fill(windings_, 0);
            const auto leaves_in_front = shoot(piece, covers, attempt);
            if (!leaves_in_front) continue;
            Sides sides{};
            (*leaves_in_front ? sides.front : sides.back) = label();
            const int sign = *leaves_in_front ? 1 : -1;
            for (const Cover& c : covers)
                windings_[static_cast<std::size_t>(c.primitive)] += sign * c.winding;
            (*leaves_in_front ? sides.back : sides.front) = label();
            return sides;
        }
        throw std::logic_error("the arrangement found no ray in general position");
    }

  private:
    static std::vector<Eigen::AlignedBox3d> facet_boxes(const FacetComplex& scene) {
        std::vector<Eigen::AlignedBox3d> boxes;
        boxes.reserve(scene.facets.size());
        for (std::uint32_t f = 0; f < scene.facets.size(); ++f) boxes.push_back(facet_box(scene, f));
        return boxes;
    }

    static double reach(const FacetComplex& scene) {
        double largest = 0;
        for (const auto& p : scene.points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
        return largest;
    }

    /// Sums what the ray from the middle of the piece crosses. Says whether it leaves to the front of the
    /// piece, or nothing if it meets an edge.
    std::optional<bool> shoot(const Piece& piece, std::span<const Cover> covers, int attempt) {
        const ExactPoint &a = registry_[piece.corners[0]], &b = registry_[piece.corners[1]],
                         &c = registry_[piece.corners[2]];
        const ExactPoint start = CGAL::barycenter(a, 5, b, 7, c, 11);
        const Eigen::Vector3d from = approximate(start, slack_ / 4),
                              to = from + length_ * ray_direction(attempt);
        const ExactPoint end(to.x(), to.y(), to.z());
        const auto side = CGAL::orientation(a, b, c, end);
        if (side == CGAL::ZERO) return std::nullopt;

        const bool clear = boxes_.visit(from, to, 1e-6 * length_, [&](std::uint32_t f) {
            if (degenerate_[f] ||
                std::ranges::any_of(covers, [&](const Cover& cover) { return cover.facet == f; }))
                return true;
            const Facet& facet = scene_.facets[f];
            const auto& v = facet.vertices;
            const std::array near{positions_.near[v[0]], positions_.near[v[1]], positions_.near[v[2]]};
            const auto certain = certain_hit(from, to, near, slack_);
            const Hit h =
                certain
                    ? *certain
                    : hit<Exact>(start, end,
                                 {positions_.points[v[0]], positions_.points[v[1]], positions_.points[v[2]]});
            if (h == Hit::leaving) wind(facet, 1);
            if (h == Hit::entering) wind(facet, -1);
            return h != Hit::unclear;
        });
        if (!clear) return std::nullopt;
        return side == CGAL::POSITIVE;
    }

    void wind(const Facet& facet, int sign) {
        if (facet.back != outside) windings_[static_cast<std::size_t>(facet.back)] += sign;
        if (facet.front != outside) windings_[static_cast<std::size_t>(facet.front)] -= sign;
    }

    Region label() const {
        const auto found =
            owner(tree_, [&](std::uint32_t i) { return i < windings_.size() && windings_[i] > 0; });
        return found ? static_cast<Region>(*found) : outside;
    }

    const Subdivision& subdivision_;
    const FacetComplex& scene_;
    const ExactPositions& positions_;
    const PointRegistry& registry_;
    const CsgTree& tree_;
    BoxTree boxes_;
    double length_;
    double slack_;  ///< by which points in doubles are off at most
    std::vector<bool> degenerate_;
    std::vector<int> windings_;  ///< of the primitives, around the place in question
};

}  // namespace

std::vector<Sides> label_sheets(const Subdivision& subdivision, const FacetComplex& scene,
                                const ExactPositions& positions, const PointRegistry& registry,
                                const CsgTree& tree) {
    volmesh::UnionFind patches = find_patches(subdivision);
    std::vector<Sides> sides(subdivision.sheets.size(), {outside, outside});
    std::vector<bool> done(subdivision.sheets.size(), false);
    Labeller labeller(subdivision, scene, positions, registry, tree);
    for (const Piece& piece : subdivision.pieces) {
        const auto patch = patches.find(piece.sheet);
        if (done[patch]) continue;
        const auto facet = subdivision.covers_of(subdivision.sheets[piece.sheet]).front().facet;
        sides[patch] = guarded(scene, std::array{facet}, [&] { return labeller.sides_of(piece); });
        done[patch] = true;
    }
    for (std::uint32_t s = 0; s < sides.size(); ++s) sides[s] = sides[patches.find(s)];
    return sides;
}

}  // namespace maille::modeler::detail
