#include "modeler/arrange_restore.hh"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include <Eigen/Geometry>

#include "modeler/arrange_box_tree.hh"
#include "modeler/arrange_boxes.hh"
#include "modeler/arrange_kernel.hh"
#include "modeler/arrange_outline.hh"
#include "modeler/arrange_split_edges.hh"
#include "modeler/point_index.hh"

namespace maille::modeler::detail {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Edge = std::array<std::uint32_t, 2>;
using Corners = std::array<std::uint32_t, 3>;

/// How many facets are at an edge.
class EdgeCounts {
  public:
    explicit EdgeCounts(const FacetComplex& complex) {
        for (const Facet& f : complex.facets)
            for (std::size_t k = 0; k < 3; ++k)
                edges_.push_back(edge_key(f.vertices[k], f.vertices[(k + 1) % 3]));
        std::ranges::sort(edges_);
    }
    std::size_t operator()(std::uint32_t a, std::uint32_t b) const {
        return std::ranges::equal_range(edges_, edge_key(a, b)).size();
    }

  private:
    std::vector<std::uint64_t> edges_;
};

/// Points, in the plane, with which a part of the arrangement is triangulated anew.
struct FlatPart {
    std::vector<std::uint32_t> numbers;  ///< in the arrangement
    std::vector<Vector2d> points;
    std::map<std::uint32_t, std::uint32_t> local{};  ///< and back

    std::uint32_t add(std::uint32_t number, const Vector2d& p) {
        const auto [at, is_new] = local.try_emplace(number, static_cast<std::uint32_t>(points.size()));
        if (is_new) numbers.push_back(number), points.push_back(p);
        return at->second;
    }
};

/// Where the outlines of a part are.
class OutlineTree {
  public:
    OutlineTree(const FlatPart& part, const std::vector<FlatEdge>& outline)
        : part_(part), outline_(outline), tree_(boxes(part, outline)) {}

    bool is_near(const Vector2d& p, double distance) const {
        return !visit(p, p, distance, [&](const FlatEdge& e) {
            return distance_to_segment(p, part_.points[e.from], part_.points[e.to]) >= distance;
        });
    }

    /// Whether an outline reaches into a triangle.
    bool reaches_into(const Corners& t) const {
        const auto& p = part_.points;
        Vector2d low = p[t[0]].cwiseMin(p[t[1]]).cwiseMin(p[t[2]]),
                 high = p[t[0]].cwiseMax(p[t[1]]).cwiseMax(p[t[2]]);
        return !visit(low, high, 0, [&](const FlatEdge& e) { return !reaches_into(e, t); });
    }

  private:
    static std::vector<Eigen::AlignedBox3d> boxes(const FlatPart& part,
                                                  const std::vector<FlatEdge>& outline) {
        std::vector<Eigen::AlignedBox3d> result;
        for (const FlatEdge& e : outline) {
            const Vector2d &a = part.points[e.from], &b = part.points[e.to];
            result.push_back(segment_box({a.x(), a.y(), 0}, {b.x(), b.y(), 0}));
        }
        return result;
    }

    /// Calls f for the edges near the box until it says false.
    template <class F>
    bool visit(const Vector2d& low, const Vector2d& high, double margin, const F& f) const {
        const Eigen::AlignedBox3d box(Vector3d(low.x() - margin, low.y() - margin, -1),
                                      Vector3d(high.x() + margin, high.y() + margin, 1));
        return tree_.visit_box(box, [&](std::uint32_t e) { return f(outline_[e]); });
    }

    static double cross(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
        return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    }

    bool reaches_into(const FlatEdge& e, const Corners& t) const {
        const auto from = std::ranges::find(t, e.from), to = std::ranges::find(t, e.to);
        if (from != t.end() && to != t.end()) return false;
        const auto& p = part_.points;
        if (from == t.end() && to == t.end()) {
            // Separated by a side of the triangle or by the line of the edge?
            int left = 0, right = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vector2d &a = p[t[k]], &b = p[t[(k + 1) % 3]];
                if (cross(a, b, p[e.from]) <= 0 && cross(a, b, p[e.to]) <= 0) return false;
                const double side = cross(p[e.from], p[e.to], a);
                left += side >= 0, right += side <= 0;
            }
            return e.from == e.to || (left != 3 && right != 3);
        }
        const auto k = static_cast<std::size_t>((from != t.end() ? from : to) - t.begin());
        const Vector2d& other = p[from != t.end() ? e.to : e.from];
        const Vector2d &a = p[t[k]], &b = p[t[(k + 1) % 3]], &c = p[t[(k + 2) % 3]];
        return cross(a, b, other) > 0 && cross(a, other, c) > 0;
    }

    const FlatPart& part_;
    const std::vector<FlatEdge>& outline_;
    BoxTree tree_;
};

class Restorer {
  public:
    Restorer(const Arrangement& arrangement, const Scene& fine, const CoarseScene& coarse, double tolerance)
        : result_(arrangement),
          fine_(fine),
          coarse_(coarse),
          splitter_(result_, fine, coarse.chains, tolerance),
          counts_(arrangement.complex) {
        for (std::uint32_t v = 0; v < result_.complex.points.size(); ++v)
            numbers_.insert(result_.complex.points[v], v);
        is_inner_.resize(fine.complex.points.size());
        for (const auto v : coarse.inner_points) is_inner_[v] = true;
    }

    /// False where some part cannot be triangulated.
    bool run() {
        std::map<std::uint32_t, std::vector<std::uint32_t>> parts;  // by patch
        for (std::uint32_t f = 0; f < result_.complex.facets.size(); ++f) {
            const auto patch = patch_of(result_.parents[f]);
            if (coarse_.patches[patch].facets.size() > 1 || has_cut_edge(f))
                parts[patch].push_back(f);
            else
                keep(f);
        }
        return std::ranges::all_of(parts, [&](const auto& part) { return fill(part.first, part.second); });
    }

    Arrangement take() {
        result_.complex.facets = std::move(facets_);
        result_.parents = std::move(parents_);
        drop_unused_points();
        return std::move(result_);
    }

  private:
    std::uint32_t fine_facet(const FacetParent& parent) const {
        const auto at =
            std::ranges::lower_bound(fine_.parents, std::pair(parent.primitive, parent.triangle), {},
                                     [](const FacetParent& p) { return std::pair(p.primitive, p.triangle); });
        return static_cast<std::uint32_t>(at - fine_.parents.begin());
    }
    std::uint32_t patch_of(const FacetParent& parent) const { return coarse_.patch_of[fine_facet(parent)]; }

    bool has_cut_edge(std::uint32_t f) const {
        const auto& [a, b, c] = result_.complex.facets[f].vertices;
        return splitter_.is_cut(a, b) || splitter_.is_cut(b, c) || splitter_.is_cut(c, a);
    }

    void keep(std::uint32_t f) {
        facets_.push_back(result_.complex.facets[f]);
        parents_.push_back(result_.parents[f]);
    }

    /// What the arrangement has of a patch, seen from where its normal points.
    struct Aspect {
        struct Sample {
            std::uint32_t facet;
            bool face_down;
        };
        std::vector<Sample> regions;          ///< facets that look alike are one region
        std::map<Edge, std::uint32_t> sides;  ///< of the facets, each with its region on the left
    };

    /// Nothing where facets lie on each other.
    std::optional<Aspect> look_at(const std::vector<std::uint32_t>& facets, const Vector3d& normal) const {
        Aspect aspect;
        std::map<std::tuple<Region, Region, std::uint32_t>, std::uint32_t> numbers;
        const auto& p = result_.complex.points;
        for (const auto f : facets) {
            const Facet& facet = result_.complex.facets[f];
            const auto& [a, b, c] = facet.vertices;
            const bool down = (p[b] - p[a]).cross(p[c] - p[a]).dot(normal) < 0;
            const std::tuple key(down ? facet.back : facet.front, down ? facet.front : facet.back,
                                 facet.surface);
            const auto [at, is_new] =
                numbers.try_emplace(key, static_cast<std::uint32_t>(aspect.regions.size()));
            if (is_new) aspect.regions.push_back({f, down});
            for (std::size_t k = 0; k < 3; ++k) {
                Edge side{facet.vertices[k], facet.vertices[(k + 1) % 3]};
                if (down) std::swap(side[0], side[1]);
                if (!aspect.sides.emplace(side, at->second).second) return std::nullopt;
            }
        }
        return aspect;
    }

    /// The sides where a region ends or other facets stand, cut at the points that they are given back.
    std::vector<FlatEdge> outline_of(const Aspect& aspect, const FlatView& view, FlatPart& part) const {
        const auto add = [&](std::uint32_t v) { return part.add(v, view(result_.complex.points[v])); };
        std::vector<FlatEdge> outline;
        for (const auto& [side, region] : aspect.sides) {
            auto last = add(side[0]);
            const auto across = aspect.sides.find({side[1], side[0]});
            if (across != aspect.sides.end() && across->second == region && counts_(side[0], side[1]) == 2)
                continue;
            for (const auto v : splitter_.between(side[0], side[1])) {
                const auto next = add(v);
                outline.push_back({last, next, region});
                last = next;
            }
            outline.push_back({last, add(side[1]), region});
        }
        return outline;
    }

    /// Triangulates what the arrangement has of a patch.
    bool fill(std::uint32_t patch_number, const std::vector<std::uint32_t>& facets) {
        const Patch& patch = coarse_.patches[patch_number];
        const auto aspect = look_at(facets, patch.normal);
        if (!aspect) return false;
        const FlatView view(patch.normal);
        FlatPart part;
        const std::vector<FlatEdge> outline = outline_of(*aspect, view, part);
        const FlatPart bare = part;
        add_inner_points(patch, view, part, outline);
        std::map<Corners, std::uint32_t> whole;
        const auto kept = whole_triangles(patch, part, outline, whole);
        auto triangles = triangulate(part.points, outline, kept);
        if (!triangles) triangles = triangulate(bare.points, outline);
        if (!triangles) return false;
        for (const auto& [corners, region] : *triangles) {
            const auto& [sample, face_down] = aspect->regions[region];
            Facet facet = result_.complex.facets[sample];
            for (std::size_t k = 0; k < 3; ++k) facet.vertices[k] = part.numbers[corners[k]];
            if (face_down) std::swap(facet.vertices[1], facet.vertices[2]);
            auto sorted = corners;
            std::ranges::sort(sorted);
            const auto at = whole.find(sorted);
            facets_.push_back(facet);
            parents_.push_back(at == whole.end() ? result_.parents[sample] : fine_.parents[at->second]);
        }
        return true;
    }

    void add_inner_points(const Patch& patch, const FlatView& view, FlatPart& part,
                          const std::vector<FlatEdge>& outline) {
        std::vector<FlatEdge> obstacles = outline;
        for (std::uint32_t v = 0; v < part.points.size(); ++v) obstacles.push_back({v, v, none});
        const FlatPart before = part;
        const OutlineTree tree(before, obstacles);
        std::map<std::uint32_t, double> shortest;  // edge at each inner point
        const auto& points = fine_.complex.points;
        for (const auto f : patch.facets)
            for (std::size_t k = 0; k < 3; ++k) {
                const auto a = fine_.complex.facets[f].vertices[k],
                           b = fine_.complex.facets[f].vertices[(k + 1) % 3];
                for (const auto v : {a, b})
                    if (is_inner_[v]) {
                        const auto at =
                            shortest.try_emplace(v, std::numeric_limits<double>::infinity()).first;
                        at->second = std::min(at->second, (points[a] - points[b]).norm());
                    }
            }
        for (const auto& [v, length] : shortest) {
            const Vector2d p = view(points[v]);
            if (numbers_.find(points[v]) || tree.is_near(p, least_clearance * length)) continue;
            const auto number = static_cast<std::uint32_t>(result_.complex.points.size());
            numbers_.insert(points[v], number);
            result_.complex.points.push_back(points[v]);
            part.add(number, p);
        }
    }

    /// The sides of the triangles of the patch that nothing reaches into; `whole` gets these triangles by
    /// their corners.
    std::vector<Edge> whole_triangles(const Patch& patch, const FlatPart& part,
                                      const std::vector<FlatEdge>& outline,
                                      std::map<Corners, std::uint32_t>& whole) const {
        std::vector<FlatEdge> obstacles = outline;
        for (std::uint32_t v = 0; v < part.points.size(); ++v) obstacles.push_back({v, v, none});
        const OutlineTree tree(part, obstacles);
        std::vector<Edge> kept;
        for (const auto f : patch.facets) {
            Corners corners{};
            bool complete = true;
            for (std::size_t k = 0; k < 3 && complete; ++k) {
                const auto number = numbers_.find(fine_.complex.points[fine_.complex.facets[f].vertices[k]]);
                const auto at = number ? part.local.find(*number) : part.local.end();
                complete = at != part.local.end();
                if (complete) corners[k] = at->second;
            }
            if (!complete || tree.reaches_into(corners)) continue;
            for (std::size_t k = 0; k < 3; ++k) kept.push_back({corners[k], corners[(k + 1) % 3]});
            std::ranges::sort(corners);
            whole.emplace(corners, f);
        }
        return kept;
    }

    void drop_unused_points() {
        std::vector<std::uint32_t> new_number(result_.complex.points.size(), none);
        std::vector<Vector3d> points;
        for (Facet& f : result_.complex.facets)
            for (auto& v : f.vertices) {
                if (new_number[v] == none) {
                    new_number[v] = static_cast<std::uint32_t>(points.size());
                    points.push_back(result_.complex.points[v]);
                }
                v = new_number[v];
            }
        result_.complex.points = std::move(points);
    }

    Arrangement result_;
    const Scene& fine_;
    const CoarseScene& coarse_;
    EdgeSplitter splitter_;
    EdgeCounts counts_;
    PointIndex numbers_;
    std::vector<bool> is_inner_;
    std::vector<Facet> facets_;
    std::vector<FacetParent> parents_;
};

}  // namespace

Arrangement restore(const Arrangement& arrangement, const Scene& fine, const CoarseScene& coarse,
                    double tolerance) {
    Restorer restorer(arrangement, fine, coarse, tolerance);
    return restorer.run() ? restorer.take() : arrangement;
}

}  // namespace maille::modeler::detail
