#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "modeler/arrange_box_tree.hh"
#include "modeler/remesh_check.hh"
#include "modeler/remesh_passes.hh"

namespace maille::modeler::remeshing {

namespace {

constexpr double growth = 0.4;        // of the size, over a distance of one
constexpr double sizes_in_gap = 1.5;  // the size, in widths of a gap between sheets
constexpr double sizes_in_strip = 2;  // and of a strip between curves
constexpr double least_facing = 0.5;  // cosine of the angle between a normal and the way across a gap
// Curves are close to each other where the way along them is so many times the one across.
constexpr double least_detour = 5;

/// The point of the triangle that is nearest to p (Ericson, Real-Time Collision Detection, section 5.1.5).
Vec3 nearest_on_triangle(const Corners& corners, const Vec3& p) {
    const auto& [a, b, c] = corners;
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const double d1 = ab.dot(p - a);
    const double d2 = ac.dot(p - a);
    if (d1 <= 0 && d2 <= 0) return a;
    const double d3 = ab.dot(p - b);
    const double d4 = ac.dot(p - b);
    if (d3 >= 0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
    const double d5 = ab.dot(p - c);
    const double d6 = ac.dot(p - c);
    if (d6 >= 0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const double sum = va + vb + vc;
    return a + ab * (vb / sum) + ac * (vc / sum);
}

/// The region on the side of the triangle that the direction points to, if it does so steeply enough.
std::optional<Region> region_towards(const Net& net, Index t, const Vec3& direction) {
    const auto [a, b, c] = net.corners(t);
    const Vec3 normal = (b - a).cross(c - a);
    const double along = normal.dot(direction);
    if (std::abs(along) < least_facing * normal.norm() * direction.norm()) return std::nullopt;
    return along > 0 ? net.patch(t).front : net.patch(t).back;
}

/// A triangle, with its corners at hand.
struct Facing {
    Index number;
    Corners corners;
};

/// Whether v and the triangle face each other across a region that is to be meshed.
bool face_each_other(const Net& net, Index v, Index t, const Vec3& from_v_to_t) {
    const auto region = region_towards(net, t, -from_v_to_t);
    return region && *region != outside && std::ranges::all_of(net.triangles_at(v), [&](Index own) {
               return region_towards(net, own, from_v_to_t) == region;
           });
}

Eigen::AlignedBox3d box_of(const Corners& corners) {
    return Eigen::AlignedBox3d(corners[0]).extend(corners[1]).extend(corners[2]);
}

/// Tells cheaply of most triangles near a vertex that the sheets there don't face them.
class MayFace {
  public:
    MayFace(const Net& net, Index v) : net_(net), at_(net.point(v)), around_(net.neighbours(v)) {
        around_.insert(std::ranges::lower_bound(around_, v), v);
        for (const Index t : net.triangles_at(v)) {
            const auto [a, b, c] = net.corners(t);
            const Vec3 normal = (b - a).cross(c - a).normalized();
            const auto is_same = [&](const Vec3& known) { return known.cross(normal).norm() < same_normal; };
            if (std::ranges::none_of(normals_, is_same)) normals_.push_back(normal);
        }
    }

    /// False where `face_each_other` says no or the triangle is further than `reach`, or meets the sheets in
    /// a curve beside the vertex: those make no gap.
    bool operator()(const Facing& triangle, double reach) const {
        const Corners& corners = triangle.corners;
        const double distance = std::sqrt(box_of(corners).squaredExteriorDistance(at_));
        if (distance >= reach) return false;
        return std::ranges::all_of(normals_,
                                   [&](const Vec3& normal) {
                                       double off_plane = 0;
                                       for (const Vec3& p : corners)
                                           off_plane = std::max(off_plane, std::abs(normal.dot(p - at_)));
                                       return off_plane >= (least_facing - same_normal) * distance;
                                   }) &&
               std::ranges::none_of(net_.triangle(triangle.number).vertices,
                                    [&](Index w) { return std::ranges::binary_search(around_, w); });
    }

  private:
    static constexpr double same_normal = 1e-3;

    const Net& net_;
    const Vec3& at_;
    std::vector<Index> around_;
    std::vector<Vec3> normals_;
};

/// Finds how wide the gaps between sheets and the strips between curves are around vertices. The net must not
/// change while it does.
class GapFinder {
  public:
    explicit GapFinder(const Net& net)
        : net_(net),
          curves_(net.n_vertices()),
          curve_sides_(net.n_triangles()),
          boxes_(boxes_of(net, triangles_)),
          ways_(net.n_vertices(), unreached),
          questions_at_(net.n_vertices(), none) {
        for (const auto& [a, b] : net.edges()) {
            if (!net.is_feature(a, b)) continue;
            curves_[a].push_back(b);
            curves_[b].push_back(a);
            const Index t = net.triangles_at(a, b).front();
            curve_sides_[t][side(net.triangle(t), a, b)] = true;
        }
    }

    /// Whether any triangle changed after that time that comes nearer to v than `reach`.
    bool has_changed(Index v, double reach, std::uint64_t since) const {
        return !boxes_.visit_box(cube(v, reach), [&](std::uint32_t i) {
            return std::ranges::none_of(net_.triangle(triangles_[i].number).vertices,
                                        [&](Index w) { return net_.touched(w) > since; });
        });
    }

    /// The size that suits the sheets and curves close to v: at most the one wanted. One below `least` counts
    /// as that. Looking further step by step spares looking far where there are gaps, and at thousands of
    /// triangles where they are small.
    double size_at(Index v, double wanted, double least) {
        const double furthest = wanted / std::min(sizes_in_gap, sizes_in_strip);
        double nearest = least / std::max(sizes_in_gap, sizes_in_strip);
        for (const Index w : net_.neighbours(v)) nearest = std::min(nearest, net_.length(v, w));
        double size = wanted;
        const MayFace may_face(net_, v);
        for (double reach = std::min(nearest, furthest);; reach = std::min(2 * reach, furthest)) {
            collect(v, reach);
            size = std::min(size, sizes_in_gap * gap_to_sheets(v, may_face, reach, size / sizes_in_gap));
            if (net_.kind(v) != VertexKind::face)
                size = std::min(size, sizes_in_strip * gap_to_curves(v, reach, size / sizes_in_strip));
            const double next = std::min(sizes_in_gap, sizes_in_strip) * reach;
            // Where so much is near, edges are short anyway.
            if (nearby_.size() > most_looked_at) return std::max(std::min(size, next), least);
            // Whatever is further away makes it no smaller.
            if (reach >= furthest || size <= std::max(least, next)) return std::max(size, least);
        }
    }

  private:
    static constexpr std::size_t most_looked_at = 300;
    static constexpr double unreached = std::numeric_limits<double>::infinity();

    static std::vector<Eigen::AlignedBox3d> boxes_of(const Net& net, std::vector<Facing>& triangles) {
        std::vector<Eigen::AlignedBox3d> boxes;
        for (Index t = 0; t < net.n_triangles(); ++t) {
            if (!net.is_alive(t)) continue;
            triangles.push_back({t, net.corners(t)});
            boxes.push_back(box_of(triangles.back().corners));
        }
        return boxes;
    }

    static std::size_t side(const Triangle& triangle, Index a, Index b) {
        for (std::size_t i = 0; i < 2; ++i)
            if (const auto& v = triangle.vertices;
                (v[i] == a || v[i] == b) && (v[i + 1] == a || v[i + 1] == b))
                return i;
        return 2;
    }

    Eigen::AlignedBox3d cube(Index v, double reach) const {
        return {net_.point(v) - Vec3::Constant(reach), net_.point(v) + Vec3::Constant(reach)};
    }

    void collect(Index v, double reach) {
        nearby_.clear();
        boxes_.visit_box(cube(v, reach), [&](std::uint32_t i) {
            nearby_.push_back(i);
            return true;
        });
    }

    /// The width of the gap between v and other sheets, if it is less than `reach` and `gap`; else `gap`.
    double gap_to_sheets(Index v, const MayFace& may_face, double reach, double gap) const {
        for (const std::uint32_t i : nearby_) {
            const double most = std::min(gap, reach);
            const Facing& triangle = triangles_[i];
            if (!may_face(triangle, most)) continue;
            const Vec3 to_sheet = nearest_on_triangle(triangle.corners, net_.point(v)) - net_.point(v);
            const double distance = to_sheet.norm();
            if (distance > 0 && distance < most && face_each_other(net_, v, triangle.number, to_sheet))
                gap = distance;
        }
        return gap;
    }

    /// The width of the strip between v, on a curve, and other curves, or distant parts of its own; if it is
    /// less than `reach` and `gap`; else `gap`.
    double gap_to_curves(Index v, double reach, double gap) {
        edges_.clear();
        for (const std::uint32_t n : nearby_)
            for (std::size_t i = 0; i < 3; ++i) {
                const Index t = triangles_[n].number;
                if (!curve_sides_[t][i]) continue;
                const Index a = net_.triangle(t).vertices[i];
                const Index b = net_.triangle(t).vertices[(i + 1) % 3];
                const double distance = distance_to_segment(net_.point(v), net_.point(a), net_.point(b));
                if (distance < std::min(gap, reach)) edges_.push_back({distance, a, b, false});
            }
        find_ways(v);
        for (const NearEdge& edge : edges_)
            if (!edge.is_reached) gap = std::min(gap, edge.distance);
        return gap;
    }

    /// An edge of a curve near the vertex that is looked at.
    struct NearEdge {
        double distance;
        Index a, b;
        bool is_reached;  ///< along curves, by a way that is not much longer
    };
    /// Asks for the way to the end of an edge.
    struct Question {
        std::size_t edge;
        Index next;  ///< at the same end, or `none`
    };

    /// Tells which of the near edges are reached from v along curves (Dijkstra).
    void find_ways(Index v) {
        double furthest = 0;
        std::size_t n_unreached = edges_.size();
        questions_.clear();
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            furthest = std::max(furthest, least_detour * edges_[i].distance);
            for (const Index end : {edges_[i].a, edges_[i].b})
                questions_.push_back(
                    {i, std::exchange(questions_at_[end], static_cast<Index>(questions_.size()))});
        }
        using Entry = std::pair<double, Index>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        const auto consider = [&](double way, Index w) {
            if (way > furthest || way >= ways_[w]) return;
            if (ways_[w] == unreached) reached_.push_back(w);
            ways_[w] = way;
            queue.push({way, w});
        };
        reached_.clear();
        consider(0, v);
        while (!queue.empty() && n_unreached > 0) {
            const auto [way, w] = queue.top();
            queue.pop();
            if (way > ways_[w]) continue;
            for (Index q = questions_at_[w]; q != none; q = questions_[q].next) {
                NearEdge& edge = edges_[questions_[q].edge];
                if (!edge.is_reached && way <= least_detour * edge.distance) {
                    edge.is_reached = true;
                    --n_unreached;
                }
            }
            for (const Index x : curves_[w]) consider(way + net_.length(w, x), x);
        }
        for (const Index w : reached_) ways_[w] = unreached;
        for (const NearEdge& edge : edges_)
            for (const Index end : {edge.a, edge.b}) questions_at_[end] = none;
    }

    const Net& net_;
    std::vector<std::vector<Index>> curves_;        // the other ends of the feature edges at each vertex
    std::vector<std::array<bool, 3>> curve_sides_;  // of each triangle: feature edges, each of one triangle
    std::vector<Facing> triangles_;                 // in the tree
    modeler::detail::BoxTree boxes_;
    std::vector<std::uint32_t> nearby_;  // by their places in the tree
    std::vector<NearEdge> edges_;
    std::vector<double> ways_;
    std::vector<Index> reached_;
    std::vector<Question> questions_;
    std::vector<Index> questions_at_;  // the last question for each vertex
};

double wanted_size(const Session& session, Index v) {
    double size = std::numeric_limits<double>::infinity();
    for (const Index t : session.net.triangles_at(v)) {
        const Patch& patch = session.net.patch(t);
        size = std::min(size, session.geometry.size(session.net.point(v), patch.front, patch.back));
    }
    return size;
}

/// The mean length of the frozen edges at v; 0 where there is none.
double frozen_size(const Net& net, Index v) {
    double sum = 0;
    int count = 0;
    for (const Index t : net.triangles_at(v)) {
        if (!net.patch(t).frozen) continue;
        for (const Index w : net.triangle(t).vertices)
            if (w != v) {
                sum += net.length(v, w);
                ++count;
            }
    }
    return count == 0 ? 0 : sum / count;
}

/// Lets no size be more than the smallest one beside it and the growth over the distance (Dijkstra).
void limit_growth(Net& net) {
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (Index v = 0; v < net.n_vertices(); ++v)
        if (!net.triangles_at(v).empty()) queue.push({net.size(v), v});
    while (!queue.empty()) {
        const auto [size, v] = queue.top();
        queue.pop();
        if (size > net.size(v)) continue;
        for (const Index w : net.neighbours(v)) {
            const double most = size + growth * net.length(v, w);
            if (most >= net.size(w)) continue;
            net.set_size(w, most);
            queue.push({most, w});
        }
    }
}

/// About how many triangles that are not frozen there will be, with these sizes at the vertices.
double expected_triangles(const Net& net, const std::vector<double>& sizes) {
    double count = 0;
    for (Index t = 0; t < net.n_triangles(); ++t) {
        if (!net.is_alive(t) || net.patch(t).frozen) continue;
        const auto [a, b, c] = net.corners(t);
        double size = 0;
        for (const Index v : net.triangle(t).vertices) size += sizes[v] / 3;
        count += (b - a).cross(c - a).norm() / 2 / (size * size * std::sqrt(3) / 4);
    }
    return count;
}

/// Makes the smallest sizes larger where there would be too many triangles.
void limit_count(Session& session) {
    const Net& net = session.net;
    std::vector<double>& sizes = session.gap_sizes;
    std::size_t n_now = 0;
    for (Index t = 0; t < net.n_triangles(); ++t) n_now += net.is_alive(t) && !net.patch(t).frozen;
    const double most = session.options.most_growth *
                        (static_cast<double>(n_now) + expected_triangles(net, session.wanted_sizes));
    for (;;) {
        const double excess = expected_triangles(net, sizes) / most;
        if (excess <= 1 || session.smallest_gap >= 1) return;
        session.smallest_gap = std::min(1.0, session.smallest_gap * std::max(1.1, std::sqrt(excess)));
        for (Index v = 0; v < net.n_vertices(); ++v)
            if (frozen_size(net, v) == 0)
                sizes[v] = std::max(sizes[v], session.smallest_gap * session.wanted_sizes[v]);
    }
}

}  // namespace

void set_sizes(Session& session) {
    Net& net = session.net;
    GapFinder gaps(net);
    std::vector<double>& sizes = session.gap_sizes;
    std::vector<double>& wanted = session.wanted_sizes;
    sizes.resize(net.n_vertices(), 0);
    wanted.resize(net.n_vertices(), 0);
    for (Index v = 0; v < net.n_vertices(); ++v) {
        if (net.triangles_at(v).empty()) continue;
        if (const double frozen = frozen_size(net, v); frozen > 0) {
            sizes[v] = wanted[v] = frozen;
            continue;
        }
        // What was found before holds where nothing has changed as far as was looked for it.
        if (sizes[v] > 0 && !gaps.has_changed(v, sizes[v] / sizes_in_gap, session.sized)) continue;
        wanted[v] = wanted_size(session, v);
        sizes[v] = gaps.size_at(v, wanted[v], session.smallest_gap * wanted[v]);
    }
    // Later there are more triangles because of it.
    if (session.sized == 0) limit_count(session);
    for (Index v = 0; v < net.n_vertices(); ++v)
        if (!net.triangles_at(v).empty()) net.set_size(v, sizes[v]);
    limit_growth(net);
    session.sized = net.now();
}

}  // namespace maille::modeler::remeshing
