#include "modeler/remesh_gaps.hh"

#include <algorithm>
#include <optional>
#include <queue>
#include <utility>

#include "modeler/remesh_check.hh"

namespace maille::modeler::remeshing {

namespace {

constexpr double sizes_in_gap = 1.5;  // the size, in widths of a gap between sheets
constexpr double sizes_in_strip = 2;  // and of a strip between curves
constexpr double least_facing = 0.5;  // cosine of the angle between a normal and the way across a gap
// Curves are close to each other where the way along them is so many times the one across.
constexpr double least_detour = 5;
constexpr std::size_t most_looked_at = 300;

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

/// Whether v and the triangle face each other across a region that is to be meshed.
bool face_each_other(const Net& net, Index v, Index t, const Vec3& from_v_to_t) {
    const auto region = region_towards(net, t, -from_v_to_t);
    return region && *region != outside && std::ranges::all_of(net.triangles_at(v), [&](Index own) {
               return region_towards(net, own, from_v_to_t) == region;
           });
}

/// Which side of the triangle the edge is.
std::size_t side(const Triangle& triangle, Index a, Index b) {
    for (std::size_t i = 0; i < 2; ++i)
        if (const auto& v = triangle.vertices; (v[i] == a || v[i] == b) && (v[i + 1] == a || v[i + 1] == b))
            return i;
    return 2;
}

std::vector<Surroundings::Sheet> sheets_of(const Net& net) {
    std::vector<Surroundings::Sheet> sheets;
    for (Index t = 0; t < net.n_triangles(); ++t)
        if (net.is_alive(t)) sheets.push_back({t, net.corners(t), {}});
    return sheets;
}

std::vector<Eigen::AlignedBox3d> boxes_of(const std::vector<Surroundings::Sheet>& sheets) {
    std::vector<Eigen::AlignedBox3d> boxes;
    for (const Surroundings::Sheet& sheet : sheets) boxes.push_back(box_of(sheet.corners));
    return boxes;
}

}  // namespace

Surroundings::Surroundings(const Net& net)
    : net_(net), curves_(net.n_vertices()), sheets_(sheets_of(net)), boxes_(boxes_of(sheets_)) {
    for (const auto& [a, b] : net.edges()) {
        if (!net.is_feature(a, b)) continue;
        curves_[a].push_back(b);
        curves_[b].push_back(a);
        const Index t = net.triangles_at(a, b).front();
        const auto sheet = std::ranges::lower_bound(sheets_, t, {}, &Sheet::number);
        sheet->on_curve[side(net.triangle(t), a, b)] = true;
    }
}

/// Tells cheaply of most triangles near a vertex that the sheets there don't face them.
class GapFinder::MayFace {
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
    bool operator()(const Surroundings::Sheet& triangle, double reach) const {
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

GapFinder::GapFinder(const Surroundings& around)
    : surroundings_(around),
      net_(around.net()),
      ways_(net_.n_vertices(), unreached),
      questions_at_(net_.n_vertices(), none) {}

bool GapFinder::has_changed(Index v, double size, std::uint64_t since) const {
    return !surroundings_.visit(v, size / sizes_in_gap, [&](std::uint32_t i) {
        return std::ranges::none_of(net_.triangle(surroundings_.sheet(i).number).vertices,
                                    [&](Index w) { return net_.touched(w) > since; });
    });
}

double GapFinder::size_at(Index v, double wanted, double least) {
    const double furthest = wanted / std::min(sizes_in_gap, sizes_in_strip);
    double nearest = least / std::max(sizes_in_gap, sizes_in_strip);
    for (const Index w : net_.neighbours(v)) nearest = std::min(nearest, net_.length(v, w));
    double size = wanted;
    const MayFace may_face(net_, v);
    for (double reach = std::min(nearest, furthest);; reach = std::min(2 * reach, furthest)) {
        nearby_.clear();
        surroundings_.visit(v, reach, [&](std::uint32_t i) {
            nearby_.push_back(i);
            return true;
        });
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

/// The width of the gap between v and other sheets, if it is less than `reach` and `gap`; else `gap`.
double GapFinder::gap_to_sheets(Index v, const MayFace& may_face, double reach, double gap) const {
    for (const std::uint32_t i : nearby_) {
        const double most = std::min(gap, reach);
        const Surroundings::Sheet& triangle = surroundings_.sheet(i);
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
double GapFinder::gap_to_curves(Index v, double reach, double gap) {
    edges_.clear();
    for (const std::uint32_t n : nearby_)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& [number, corners, on_curve] = surroundings_.sheet(n);
            if (!on_curve[i]) continue;
            const Index a = net_.triangle(number).vertices[i];
            const Index b = net_.triangle(number).vertices[(i + 1) % 3];
            const double distance = distance_to_segment(net_.point(v), net_.point(a), net_.point(b));
            if (distance < std::min(gap, reach)) edges_.push_back({distance, a, b, false});
        }
    find_ways(v);
    for (const NearEdge& edge : edges_)
        if (!edge.is_reached) gap = std::min(gap, edge.distance);
    return gap;
}

/// Tells which of the near edges are reached from v along curves (Dijkstra).
void GapFinder::find_ways(Index v) {
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
        for (const Index x : surroundings_.curves_at(w)) consider(way + net_.length(w, x), x);
    }
    for (const Index w : reached_) ways_[w] = unreached;
    for (const NearEdge& edge : edges_)
        for (const Index end : {edge.a, edge.b}) questions_at_[end] = none;
}

}  // namespace maille::modeler::remeshing
