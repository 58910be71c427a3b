#include "modeler/arrange_features.hh"

#include <algorithm>
#include <tuple>

namespace maille::modeler::detail {

namespace {

/// A side of a kept piece.
struct Use {
    std::uint64_t edge;
    bool rising;
    std::uint32_t group;
    bool operator<(const Use& other) const {
        return std::tie(edge, rising, group) < std::tie(other.edge, other.rising, other.group);
    }
};

/// Which points belong to which primitives.
class Ownership {
  public:
    explicit Ownership(const FacetComplex& scene) {
        for (const Facet& f : scene.facets)
            for (const auto v : f.vertices)
                for (const auto r : {f.front, f.back})
                    if (r != outside) pairs_.emplace_back(v, r);
        std::ranges::sort(pairs_);
        pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    }
    bool owns(Region primitive, std::uint32_t point) const {
        return std::ranges::binary_search(pairs_, std::pair(point, primitive));
    }

  private:
    std::vector<std::pair<std::uint32_t, Region>> pairs_;
};

class FeatureFinder {
  public:
    FeatureFinder(const Subdivision& subdivision, const KeptSheets& kept, const PointRegistry& registry)
        : subdivision_(subdivision), kept_(kept), registry_(registry), points_(registry.size()) {}

    void mark_own_points(const FacetComplex& scene) {
        const Ownership ownership(scene);
        for_each_kept_piece([&](const Piece& piece, std::uint32_t group) {
            const Group& g = kept_.groups[group];
            for (const auto v : piece.corners)
                points_[v].is_fixed |=
                    v < scene.points.size() && (g.cluster == none || ownership.owns(g.primitive, v));
        });
    }

    void find_edges() {
        collect_uses();
        for (std::size_t i = 0; i < uses_.size();) {
            std::size_t end = i;
            while (end < uses_.size() && uses_[end].edge == uses_[i].edge) ++end;
            const bool goes_on = end - i == 2 && uses_[i].group == uses_[i + 1].group &&
                                 uses_[i].rising != uses_[i + 1].rising && is_cut(uses_[i].group);
            if (!goes_on) {
                const auto a = static_cast<std::uint32_t>(uses_[i].edge >> 32);
                const auto b = static_cast<std::uint32_t>(uses_[i].edge);
                points_[a].join(b);
                points_[b].join(a);
                edges_.insert(edges_.end(), uses_.begin() + static_cast<std::ptrdiff_t>(i),
                              uses_.begin() + static_cast<std::ptrdiff_t>(end));
            }
            i = end;
        }
    }

    /// A point is left out if it is not a primitive's own and no edge ends or turns there.
    void choose_points() {
        for (std::uint32_t v = 0; v < points_.size(); ++v) {
            PointState& p = points_[v];
            if (p.n_edges == 0 || p.is_fixed) continue;
            p.is_fixed = p.n_edges != 2 ||
                         !CGAL::collinear(registry_[p.neighbors[0]], registry_[v], registry_[p.neighbors[1]]);
        }
    }

    std::vector<std::vector<OutlineEdge>> outlines() const {
        std::vector<std::vector<OutlineEdge>> result(subdivision_.clusters.size());
        for (const Use& use : edges_) {
            if (!is_cut(use.group)) continue;
            auto from = static_cast<std::uint32_t>(use.edge >> 32), to = static_cast<std::uint32_t>(use.edge);
            if (!use.rising) std::swap(from, to);
            if (points_[from].is_fixed)
                result[kept_.groups[use.group].cluster].push_back({from, end_of_chain(from, to), use.group});
        }
        return result;
    }

    std::vector<std::vector<std::uint32_t>> points() const {
        std::vector<std::vector<std::uint32_t>> result(subdivision_.clusters.size());
        for_each_kept_piece([&](const Piece& piece, std::uint32_t group) {
            if (!is_cut(group)) return;
            for (const auto v : piece.corners)
                if (points_[v].is_fixed) result[kept_.groups[group].cluster].push_back(v);
        });
        for (auto& points : result) {
            std::ranges::sort(points);
            points.erase(std::unique(points.begin(), points.end()), points.end());
        }
        return result;
    }

  private:
    struct PointState {
        bool is_fixed = false;
        std::uint32_t n_edges = 0;
        std::array<std::uint32_t, 2> neighbors{};  ///< the first two

        void join(std::uint32_t other) {
            if (n_edges < 2) neighbors[n_edges] = other;
            ++n_edges;
        }
    };

    template <class F>
    void for_each_kept_piece(const F& f) const {
        for (const Piece& piece : subdivision_.pieces)
            if (kept_.group_of[piece.sheet] != none) f(piece, kept_.group_of[piece.sheet]);
    }

    bool is_cut(std::uint32_t group) const { return kept_.groups[group].cluster != none; }

    void collect_uses() {
        for_each_kept_piece([&](const Piece& piece, std::uint32_t group) {
            const bool mirrored = subdivision_.sheets[piece.sheet].mirrored;
            for (std::size_t k = 0; k < 3; ++k) {
                const auto a = piece.corners[k], b = piece.corners[(k + 1) % 3];
                uses_.push_back({edge_key(a, b), (a < b) != mirrored, group});
            }
        });
        std::sort(uses_.begin(), uses_.end());
    }

    std::uint32_t end_of_chain(std::uint32_t from, std::uint32_t to) const {
        while (!points_[to].is_fixed) {
            const auto& [a, b] = points_[to].neighbors;
            const auto next = a == from ? b : a;
            from = to;
            to = next;
        }
        return to;
    }

    const Subdivision& subdivision_;
    const KeptSheets& kept_;
    const PointRegistry& registry_;
    std::vector<PointState> points_;
    std::vector<Use> uses_;
    std::vector<Use> edges_;  ///< those at features
};

}  // namespace

Features::Features(const Subdivision& subdivision, const KeptSheets& kept, const FacetComplex& scene,
                   const PointRegistry& registry) {
    FeatureFinder finder(subdivision, kept, registry);
    finder.mark_own_points(scene);
    finder.find_edges();
    finder.choose_points();
    outlines_ = finder.outlines();
    points_ = finder.points();
}

}  // namespace maille::modeler::detail
