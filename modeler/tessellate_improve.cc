#include "modeler/tessellate_improve.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "modeler/shape_frame.hh"

namespace maille::modeler {
namespace {

using Mesh = volmesh::TriMesh;
using Vertex = Mesh::VertexHandle;
using Edge = Mesh::EdgeHandle;
using Halfedge = Mesh::HalfedgeHandle;
using Face = Mesh::FaceHandle;

/// Edges longer than this many times the wanted length are split, and shorter than that collapsed.
constexpr double too_long = 4.0 / 3, too_short = 4.0 / 5;
/// A surface of which all edges are within these limits, and all angles large enough, is left alone.
constexpr double good_longest = 1.5, good_shortest = 0.6;
const double good_angle = std::cos(38 * std::numbers::pi / 180);
/// Triangles turn no further away from the surface, unless they were worse before.
constexpr double least_alignment = 0.3;
/// How fast the wanted length grows along the surface, away from where it is short.
constexpr double growth = 0.4;

/// The cosine of a triangle's smallest angle: 0.5 at best, 1 at worst.
double sharpness(const Point& a, const Point& b, const Point& c) {
    const Point ab = b - a, bc = c - b, ca = a - c;
    const double lab = ab.norm(), lbc = bc.norm(), lca = ca.norm();
    if (lab == 0 || lbc == 0 || lca == 0) return 1;
    return std::max({-ab.dot(ca) / (lab * lca), -bc.dot(ab) / (lbc * lab), -ca.dot(bc) / (lca * lbc)});
}

class Improver {
  public:
    Improver(Mesh& mesh, const Shape& shape, const Sizing& sizing, std::span<const std::uint32_t> corners,
             bool keep_first_face);
    void run();

  private:
    /// The worst of a few triangles.
    struct Worst {
        double sharpness = 0;
        double alignment = 1;  ///< of a triangle's normal with the surface's at its corners: their cosine

        bool is_better_than(const Worst& now, double allowed_sharpness) const {
            return sharpness <= allowed_sharpness && alignment >= std::min(least_alignment, now.alignment);
        }
    };

    std::uint32_t surface(Face f) const { return mesh_.property(surface_, f); }
    std::uint32_t surface(Vertex v) const { return surface(mesh_.face_handle(mesh_.halfedge_handle(v))); }
    bool is_rim(Edge e) const;
    bool is_active(Edge e) const {
        return !is_rim(e) && active_[surface(mesh_.face_handle(mesh_.halfedge_handle(e, 0)))];
    }
    double wanted(Edge e) const;
    double sharpness_of(Face f) const;
    Point at(Vertex v) const { return mesh_.point(v); }
    Point at(Halfedge h) const { return mesh_.point(mesh_.to_vertex_handle(h)); }

    void find_fixed(std::span<const std::uint32_t> corners);
    void find_wanted();
    void find_normals();
    bool find_active();
    std::size_t split_long_edges();
    bool split(Edge e);
    std::size_t collapse_short_edges();
    bool collapse(Edge e);
    std::size_t flip_edges();
    void smooth();
    void open_sharp_angles();
    struct Corner {
        Point at, normal;
    };
    Corner corner(Vertex v) const { return {at(v), normals_[v.idx()]}; }
    Vertex opposite(Halfedge h) const { return mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h)); }
    static Worst worst_of(std::initializer_list<std::array<Corner, 3>> triangles);
    static Worst worse(const Worst& a, const Worst& b);
    Point normal_at(Vertex v, const Point& p) const;
    Worst star_at(Vertex v, const Point& p, Vertex without = Vertex()) const;
    void move(Vertex v, const Point& p);

    Mesh& mesh_;
    const Shape& shape_;
    const Sizing& sizing_;
    bool keep_first_face_;
    OpenMesh::FPropHandleT<std::uint32_t> surface_;
    std::vector<bool> fixed_;      ///< by vertex
    std::vector<bool> is_smooth_;  ///< by vertex: on no sharp curve or corner
    std::vector<double> wanted_;   ///< length of edge, by vertex
    std::vector<Point> normals_;   ///< of the surface, by vertex; 0 where that is not smooth
    std::vector<bool> active_;     ///< surfaces to work at
};

Improver::Improver(Mesh& mesh, const Shape& shape, const Sizing& sizing,
                   std::span<const std::uint32_t> corners, bool keep_first_face)
    : mesh_(mesh),
      shape_(shape),
      sizing_(sizing),
      keep_first_face_(keep_first_face),
      active_(shape.faces().size(), true) {
    mesh_.get_property_handle(surface_, "surface");
    mesh_.request_vertex_status();
    mesh_.request_edge_status();
    mesh_.request_face_status();
    mesh_.request_halfedge_status();
    find_fixed(corners);
    find_wanted();
    find_normals();
}

bool Improver::is_rim(Edge e) const {
    return surface(mesh_.face_handle(mesh_.halfedge_handle(e, 0))) !=
           surface(mesh_.face_handle(mesh_.halfedge_handle(e, 1)));
}

double Improver::wanted(Edge e) const {
    const Halfedge h = mesh_.halfedge_handle(e, 0);
    return (wanted_[mesh_.to_vertex_handle(h).idx()] + wanted_[mesh_.from_vertex_handle(h).idx()]) / 2;
}

double Improver::sharpness_of(Face f) const {
    const Halfedge h = mesh_.halfedge_handle(f);
    const Halfedge next = mesh_.next_halfedge_handle(h);
    return sharpness(at(h), at(next), at(mesh_.next_halfedge_handle(next)));
}

void Improver::find_fixed(std::span<const std::uint32_t> corners) {
    fixed_.assign(mesh_.n_vertices(), false);
    for (std::uint32_t corner : corners) fixed_[corner] = true;
    for (Edge e : mesh_.edges()) {
        if (!is_rim(e)) continue;
        for (int side : {0, 1}) fixed_[mesh_.to_vertex_handle(mesh_.halfedge_handle(e, side)).idx()] = true;
    }
    is_smooth_ = fixed_;
    is_smooth_.flip();
}

// Sharp curves set the length with their own edges; elsewhere the curvature does, and the way to the next
// short edge.
void Improver::find_wanted() {
    wanted_.assign(mesh_.n_vertices(), 0);
    for (Vertex v : mesh_.vertices()) {
        double rim = 0;
        int edges = 0;
        for (Edge e : mesh_.ve_range(v))
            if (is_rim(e)) {
                rim += mesh_.calc_edge_length(e);
                ++edges;
            }
        wanted_[v.idx()] = edges > 0 ? rim / edges : sizing_.at(surface(v), at(v));
    }
    constexpr int most_sweeps = 30;
    bool changed = true;
    for (int sweep = 0; changed && sweep < most_sweeps; ++sweep) {
        changed = false;
        const auto limit = [&](Edge e) {
            const Halfedge h = mesh_.halfedge_handle(e, 0);
            const int i = mesh_.to_vertex_handle(h).idx(), j = mesh_.from_vertex_handle(h).idx();
            const double step = growth * mesh_.calc_edge_length(e);
            for (auto [from, to] : {std::pair(i, j), std::pair(j, i)})
                if (wanted_[to] > wanted_[from] + step) {
                    wanted_[to] = wanted_[from] + step;
                    changed = true;
                }
        };
        for (Edge e : mesh_.edges()) limit(e);
    }
}

void Improver::find_normals() {
    normals_.clear();
    for (Vertex v : mesh_.vertices()) normals_.push_back(normal_at(v, at(v)));
}

Point Improver::normal_at(Vertex v, const Point& p) const {
    return is_smooth_[v.idx()] ? shape_.face_normal(surface(v), p) : Point::Zero();
}

/// Finds the surfaces that are worth work; all vertices of the others are fixed.
bool Improver::find_active() {
    active_.assign(active_.size(), false);
    for (Face f : mesh_.faces())
        if (sharpness_of(f) > good_angle) active_[surface(f)] = true;
    for (Edge e : mesh_.edges()) {
        const double ratio = mesh_.calc_edge_length(e) / wanted(e);
        if (!is_rim(e) && (ratio > good_longest || ratio < good_shortest))
            active_[surface(mesh_.face_handle(mesh_.halfedge_handle(e, 0)))] = true;
    }
    if (keep_first_face_) active_[0] = false;
    for (Face f : mesh_.faces())
        if (!active_[surface(f)])
            for (Vertex v : mesh_.fv_range(f)) fixed_[v.idx()] = true;
    return std::ranges::find(active_, true) != active_.end();
}

std::size_t Improver::split_long_edges() {
    std::vector<std::pair<double, int>> long_edges;
    for (Edge e : mesh_.edges())
        if (is_active(e) && mesh_.calc_edge_length(e) > too_long * wanted(e))
            long_edges.emplace_back(-mesh_.calc_edge_length(e) / wanted(e), e.idx());
    std::ranges::sort(long_edges);
    std::size_t count = 0;
    for (const auto& [length, index] : long_edges)
        if (split(Edge(index))) ++count;
    return count;
}

bool Improver::split(Edge e) {
    const Halfedge h = mesh_.halfedge_handle(e, 0), o = mesh_.halfedge_handle(e, 1);
    const std::uint32_t on = surface(mesh_.face_handle(h));
    const Point middle = shape_.project(on, mesh_.calc_edge_midpoint(e));
    const Point normal = shape_.face_normal(on, middle);
    const Corner centre{middle, normal};
    const Corner a = corner(mesh_.from_vertex_handle(h)), b = corner(mesh_.to_vertex_handle(h));
    const Corner left = corner(opposite(h)), right = corner(opposite(o));
    const Worst now = worst_of({{a, b, left}, {b, a, right}});
    const Worst then =
        worst_of({{a, centre, left}, {centre, b, left}, {b, centre, right}, {centre, a, right}});
    if (then.alignment < std::min(least_alignment, now.alignment)) return false;
    wanted_.push_back(wanted(e));
    fixed_.push_back(false);
    is_smooth_.push_back(true);
    normals_.push_back(normal);
    mesh_.split_copy(e, middle);
    return true;
}

std::size_t Improver::collapse_short_edges() {
    std::size_t count = 0;
    for (Edge e : mesh_.edges())
        if (!mesh_.status(e).deleted() && is_active(e) && mesh_.calc_edge_length(e) < too_short * wanted(e) &&
            collapse(e))
            ++count;
    return count;
}

bool Improver::collapse(Edge e) {
    Halfedge h = mesh_.halfedge_handle(e, 0);
    if (fixed_[mesh_.from_vertex_handle(h).idx()]) h = mesh_.opposite_halfedge_handle(h);
    const Vertex gone = mesh_.from_vertex_handle(h), stays = mesh_.to_vertex_handle(h);
    if (fixed_[gone.idx()] || !mesh_.is_collapse_ok(h)) return false;
    for (int side : {0, 1}) {
        const Halfedge next = mesh_.next_halfedge_handle(mesh_.halfedge_handle(e, side));
        if (mesh_.valence(mesh_.to_vertex_handle(next)) <= 3) return false;
    }
    const Point target =
        fixed_[stays.idx()] ? at(stays) : shape_.project(surface(gone), mesh_.calc_edge_midpoint(e));
    for (Vertex end : {gone, stays}) {
        for (Vertex v : mesh_.vv_range(end)) {
            const double limit = too_long * (wanted_[v.idx()] + wanted_[stays.idx()]) / 2;
            if (v != gone && v != stays && (end == gone || !fixed_[stays.idx()]) &&
                (at(v) - target).norm() > limit)
                return false;
        }
    }
    const Worst now = worse(star_at(gone, at(gone)), star_at(stays, at(stays)));
    const Worst then = worse(star_at(gone, target, stays), star_at(stays, target, gone));
    if (!then.is_better_than(now, std::max(now.sharpness, good_angle))) return false;
    mesh_.collapse(h);
    move(stays, target);
    return true;
}

std::size_t Improver::flip_edges() {
    std::size_t count = 0;
    for (Edge e : mesh_.edges()) {
        if (mesh_.status(e).deleted() || !is_active(e) || !mesh_.is_flip_ok(e)) continue;
        const Halfedge h = mesh_.halfedge_handle(e, 0), o = mesh_.halfedge_handle(e, 1);
        const Corner a = corner(mesh_.from_vertex_handle(h)), b = corner(mesh_.to_vertex_handle(h));
        const Corner left = corner(opposite(h)), right = corner(opposite(o));
        const Worst now = worst_of({{a, b, left}, {b, a, right}});
        const Worst then = worst_of({{left, right, b}, {right, left, a}});
        if (!then.is_better_than(now, now.sharpness - 1e-9)) continue;
        // Where no corner has a normal, the old triangles tell the surface's.
        const Point outward = (b.at - a.at).cross(left.at - a.at) + (a.at - b.at).cross(right.at - b.at);
        if ((right.at - left.at).cross(b.at - left.at).dot(outward) <= 0 ||
            (left.at - right.at).cross(a.at - right.at).dot(outward) <= 0)
            continue;
        mesh_.flip(e);
        ++count;
    }
    return count;
}

/// The triangles of v if it were at p; those that have `without` as well are left out.
Improver::Worst Improver::star_at(Vertex v, const Point& p, Vertex without) const {
    Worst worst;
    const Corner centre{p, normal_at(v, p)};
    for (Halfedge h : mesh_.voh_range(v)) {
        const Vertex b = mesh_.to_vertex_handle(h), c = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h));
        if (b != without && c != without) worst = worse(worst, worst_of({{centre, corner(b), corner(c)}}));
    }
    return worst;
}

Improver::Worst Improver::worst_of(std::initializer_list<std::array<Corner, 3>> triangles) {
    Worst worst;
    for (const auto& corners : triangles) {
        const auto& [a, b, c] = corners;
        worst.sharpness = std::max(worst.sharpness, sharpness(a.at, b.at, c.at));
        const Point normal = (b.at - a.at).cross(c.at - a.at).normalized();
        for (const Corner& corner : corners)
            if (!corner.normal.isZero(0))
                worst.alignment = std::min(worst.alignment, normal.dot(corner.normal));
    }
    return worst;
}

Improver::Worst Improver::worse(const Worst& a, const Worst& b) {
    return {std::max(a.sharpness, b.sharpness), std::min(a.alignment, b.alignment)};
}

void Improver::move(Vertex v, const Point& p) {
    mesh_.set_point(v, p);
    normals_[v.idx()] = normal_at(v, p);
}

// Towards the mean of the triangles' centres, weighted by area over the square of the wanted size.
void Improver::smooth() {
    for (Vertex v : mesh_.vertices()) {
        if (mesh_.status(v).deleted() || fixed_[v.idx()]) continue;
        const std::uint32_t on = surface(v);
        Point sum = Point::Zero();
        double weights = 0;
        for (Halfedge h : mesh_.voh_range(v)) {
            const Halfedge next = mesh_.next_halfedge_handle(h);
            const double scale = (wanted_[v.idx()] + wanted_[mesh_.to_vertex_handle(h).idx()] +
                                  wanted_[mesh_.to_vertex_handle(next).idx()]) /
                                 3;
            const double weight = (at(h) - at(v)).cross(at(next) - at(v)).norm() / (scale * scale);
            sum += weight * (at(v) + at(h) + at(next)) / 3;
            weights += weight;
        }
        if (!(weights > 0)) continue;
        const Worst now = star_at(v, at(v));
        const Point start = at(v);
        for (double part : {1.0, 0.5, 0.25}) {
            const Point p = shape_.project(on, start + part * (sum / weights - start));
            if (!star_at(v, p).is_better_than(now, std::max(now.sharpness, good_angle))) continue;
            move(v, p);
            break;
        }
    }
}

/// Moves the vertices of sharp triangles, by search, so that their smallest angle grows.
void Improver::open_sharp_angles() {
    constexpr int directions = 8;
    for (Vertex v : mesh_.vertices()) {
        if (mesh_.status(v).deleted() || fixed_[v.idx()]) continue;
        Worst now = star_at(v, at(v));
        if (now.sharpness <= good_angle) continue;
        const std::uint32_t on = surface(v);
        const Plane tangent(at(v), shape_.face_normal(on, at(v)));
        for (double step : {0.2, 0.1, 0.05, 0.02}) {
            Point best = at(v);
            for (int i = 0; i < directions; ++i) {
                const Point p = shape_.project(
                    on, tangent.unflatten(step * wanted_[v.idx()] * unit_circle(i, directions)));
                const Worst then = star_at(v, p);
                if (!then.is_better_than(now, now.sharpness - 1e-9)) continue;
                now = then;
                best = p;
            }
            if (best != at(v)) move(v, best);
        }
    }
}

void Improver::run() {
    if (!find_active()) return;
    constexpr int most_rounds = 12, smoothings = 3, polishings = 8;
    for (int round = 0; round < most_rounds; ++round) {
        std::size_t changes = split_long_edges();
        flip_edges();
        changes += collapse_short_edges();
        flip_edges();
        for (int i = 0; i < smoothings; ++i) {
            smooth();
            flip_edges();
        }
        if (changes <= mesh_.n_edges() / 1000) break;
        find_wanted();
    }
    for (int i = 0; i < polishings; ++i) {
        open_sharp_angles();
        flip_edges();
    }
    mesh_.garbage_collection();
}

}  // namespace

void improve(volmesh::TriMesh& mesh, const Shape& shape, const Sizing& sizing,
             std::span<const std::uint32_t> corners, bool keep_first_face) {
    Improver(mesh, shape, sizing, corners, keep_first_face).run();
}

}  // namespace maille::modeler
