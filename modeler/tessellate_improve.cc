#include "modeler/tessellate_improve.hh"

#include <algorithm>
#include <cmath>
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
    Improver(Mesh& mesh, const Shape& shape, const Sizing& sizing, std::span<const std::uint32_t> corners);
    void run();

  private:
    /// What a vertex's triangles would look like elsewhere.
    struct Star {
        double sharpest = 0;
        bool folded = false;
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
    bool find_active();
    std::size_t split_long_edges();
    std::size_t collapse_short_edges();
    bool collapse(Edge e);
    std::size_t flip_edges();
    void smooth();
    void open_sharp_angles();
    Star star_at(Vertex v, const Point& p, Vertex without = Vertex()) const;
    bool move(Vertex v, const Point& p, double allowed);

    Mesh& mesh_;
    const Shape& shape_;
    const Sizing& sizing_;
    OpenMesh::FPropHandleT<std::uint32_t> surface_;
    std::vector<bool> fixed_;     ///< by vertex
    std::vector<double> wanted_;  ///< length of edge, by vertex
    std::vector<bool> active_;    ///< surfaces to work at
};

Improver::Improver(Mesh& mesh, const Shape& shape, const Sizing& sizing,
                   std::span<const std::uint32_t> corners)
    : mesh_(mesh), shape_(shape), sizing_(sizing), active_(shape.faces().size(), true) {
    mesh_.get_property_handle(surface_, "surface");
    mesh_.request_vertex_status();
    mesh_.request_edge_status();
    mesh_.request_face_status();
    mesh_.request_halfedge_status();
    find_fixed(corners);
    find_wanted();
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
    for (const auto& [length, index] : long_edges) {
        const Edge e(index);
        const std::uint32_t on = surface(mesh_.face_handle(mesh_.halfedge_handle(e, 0)));
        const Point middle = shape_.project(on, mesh_.calc_edge_midpoint(e));
        wanted_.push_back(wanted(e));
        fixed_.push_back(false);
        mesh_.split_copy(e, middle);
    }
    return long_edges.size();
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
    const double now = std::max(star_at(gone, at(gone)).sharpest, star_at(stays, at(stays)).sharpest);
    for (Vertex end : {gone, stays}) {
        const Star star = star_at(end, target, end == gone ? stays : gone);
        if (star.folded || star.sharpest > std::max(now, good_angle)) return false;
    }
    mesh_.collapse(h);
    mesh_.set_point(stays, target);
    return true;
}

std::size_t Improver::flip_edges() {
    std::size_t count = 0;
    for (Edge e : mesh_.edges()) {
        if (mesh_.status(e).deleted() || !is_active(e) || !mesh_.is_flip_ok(e)) continue;
        const Halfedge h = mesh_.halfedge_handle(e, 0), o = mesh_.halfedge_handle(e, 1);
        const Point a = at(o), b = at(h);
        const Point left = at(mesh_.next_halfedge_handle(h)), right = at(mesh_.next_halfedge_handle(o));
        const double now = std::max(sharpness(a, b, left), sharpness(b, a, right));
        const double then = std::max(sharpness(left, right, b), sharpness(right, left, a));
        if (then > now - 1e-9) continue;
        const Point normal_1 = (right - left).cross(b - left), normal_2 = (left - right).cross(a - right);
        const Point outward = (b - a).cross(left - a) + (a - b).cross(right - b);
        if (normal_1.dot(outward) <= 0.3 * normal_1.norm() * outward.norm() ||
            normal_2.dot(outward) <= 0.3 * normal_2.norm() * outward.norm())
            continue;
        mesh_.flip(e);
        ++count;
    }
    return count;
}

/// The triangles of v if it were at p; those that have `without` as well are left out.
Improver::Star Improver::star_at(Vertex v, const Point& p, Vertex without) const {
    Star star;
    const bool is_rim_vertex = fixed_[v.idx()];
    const Point normal = is_rim_vertex ? Point::Zero() : shape_.face_normal(surface(v), p);
    for (Halfedge h : mesh_.voh_range(v)) {
        const Vertex b = mesh_.to_vertex_handle(h), c = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h));
        if (b == without || c == without) continue;
        star.sharpest = std::max(star.sharpest, sharpness(p, at(b), at(c)));
        const Point cross = (at(b) - p).cross(at(c) - p);
        const Point before = (at(b) - at(v)).cross(at(c) - at(v));
        const Point& reference = is_rim_vertex ? before : normal;
        star.folded |= cross.dot(reference) <= 0.3 * cross.norm() * reference.norm();
    }
    return star;
}

bool Improver::move(Vertex v, const Point& p, double allowed) {
    const Star star = star_at(v, p);
    if (star.folded || star.sharpest > allowed) return false;
    mesh_.set_point(v, p);
    return true;
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
        const double allowed = std::max(star_at(v, at(v)).sharpest, good_angle);
        const Point start = at(v);
        for (double part : {1.0, 0.5, 0.25})
            if (move(v, shape_.project(on, start + part * (sum / weights - start)), allowed)) break;
    }
}

/// Moves the vertices of sharp triangles, by search, so that their smallest angle grows.
void Improver::open_sharp_angles() {
    constexpr int directions = 8;
    for (Vertex v : mesh_.vertices()) {
        if (mesh_.status(v).deleted() || fixed_[v.idx()]) continue;
        double now = star_at(v, at(v)).sharpest;
        if (now <= good_angle) continue;
        const std::uint32_t on = surface(v);
        const Plane tangent(at(v), shape_.face_normal(on, at(v)));
        for (double step : {0.2, 0.1, 0.05, 0.02}) {
            Point best = at(v);
            for (int i = 0; i < directions; ++i) {
                const Point p = shape_.project(
                    on, tangent.unflatten(step * wanted_[v.idx()] * unit_circle(i, directions)));
                const Star star = star_at(v, p);
                if (star.folded || star.sharpest >= now) continue;
                now = star.sharpest;
                best = p;
            }
            mesh_.set_point(v, best);
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
        if (changes == 0) break;
        mesh_.garbage_collection();
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
             std::span<const std::uint32_t> corners) {
    Improver(mesh, shape, sizing, corners).run();
}

}  // namespace maille::modeler
