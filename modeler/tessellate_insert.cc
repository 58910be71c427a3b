#include "modeler/tessellate_insert.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "modeler/projector_newton.hh"
#include "modeler/remesh_check.hh"

namespace maille::modeler {
namespace {

using Mesh = volmesh::TriMesh;
using Vertex = Mesh::VertexHandle;
using Edge = Mesh::EdgeHandle;
using Halfedge = Mesh::HalfedgeHandle;
using Face = Mesh::FaceHandle;
using Corners = std::array<Point, 3>;

/// Parts of a triangle: a point is beside it, at its edge, or at its corner.
constexpr double beside = -0.25, at_edge = 0.05, at_corner = 1e-3;
/// The least cosine between a triangle's normal and its surface's.
constexpr double least_alignment = 0.3;

class Inserter {
  public:
    Inserter(Mesh& mesh, const Shape& shape) : mesh_(mesh), shape_(shape) {
        mesh_.get_property_handle(surface_, "surface");
    }

    void insert(const FacePoint& wanted) {
        constexpr int most_divisions = 4;
        for (int i = 0; i <= most_divisions; ++i) {
            const auto [face, weights] = triangle_under(wanted);
            if (!face.is_valid()) return;
            Eigen::Index least = 0, most = 0;
            weights.minCoeff(&least);
            if (weights.maxCoeff(&most) > 1 - at_corner) {
                if (i == 0) refine_around(corner(face, most));
                return;
            }
            const Edge edge = edge_across(face, least);
            Vertex added;
            if (weights[least] < at_edge && lies_on_both_sides(edge, wanted))
                added = split(edge, wanted.point);
            else if (weights[least] > at_corner)
                added = split(face, wanted);
            if (added.is_valid()) return improve_around(added);
            // The edge runs too far from the surface there, or between the point and the true rim.
            if (!divide(edge)) return;
        }
    }

  private:
    struct Foot {
        Face face;
        Eigen::Vector3d weights = Eigen::Vector3d::Zero();  ///< of the corners
    };

    std::uint32_t surface(Face f) const { return mesh_.property(surface_, f); }
    Corners corners(Face f) const {
        Corners points;
        std::size_t n = 0;
        for (Halfedge h = mesh_.halfedge_handle(f); n < 3; h = mesh_.next_halfedge_handle(h))
            points[n++] = mesh_.point(mesh_.to_vertex_handle(h));
        return points;
    }
    /// Corners are the ends of the halfedges, in their order.
    Vertex corner(Face f, Eigen::Index k) const {
        Halfedge h = mesh_.halfedge_handle(f);
        for (; k > 0; --k) h = mesh_.next_halfedge_handle(h);
        return mesh_.to_vertex_handle(h);
    }
    /// The halfedge before a corner's own is across.
    Edge edge_across(Face f, Eigen::Index k) const {
        Halfedge h = mesh_.halfedge_handle(f);
        for (Eigen::Index i = 0; i < (k + 2) % 3; ++i) h = mesh_.next_halfedge_handle(h);
        return mesh_.edge_handle(h);
    }
    std::array<std::uint32_t, 2> faces_of(Edge e) const {
        return {surface(mesh_.face_handle(mesh_.halfedge_handle(e, 0))),
                surface(mesh_.face_handle(mesh_.halfedge_handle(e, 1)))};
    }
    bool is_rim(Edge e) const { return faces_of(e)[0] != faces_of(e)[1]; }
    bool is_aligned(std::uint32_t surface, const Corners& c) const {
        const Point normal = (c[1] - c[0]).cross(c[2] - c[0]);
        const Point wanted = shape_.face_normal(surface, (c[0] + c[1] + c[2]) / 3);
        return normal.dot(wanted) > least_alignment * normal.norm();
    }

    bool lies_on(std::uint32_t surface, const Point& p, double scale) const {
        return (shape_.project(surface, p) - p).norm() <= on_surface * scale;
    }

    /// The triangle of the face that the point is over, or nothing.
    Foot triangle_under(const FacePoint& wanted) const {
        Foot best;
        double inside = beside;
        for (const Face f : mesh_.faces()) {
            if (surface(f) != wanted.face) continue;
            const Corners c = corners(f);
            const Point u = c[1] - c[0], v = c[2] - c[0], w = wanted.point - c[0];
            if (w.squaredNorm() > 4 * std::max(u.squaredNorm(), v.squaredNorm())) continue;
            const Point normal = u.cross(v);
            const double b = w.cross(v).dot(normal) / normal.squaredNorm();
            const double d = u.cross(w).dot(normal) / normal.squaredNorm();
            const Eigen::Vector3d weights(1 - b - d, b, d);
            if (!(weights.minCoeff() > inside) ||
                normal.dot(shape_.face_normal(wanted.face, wanted.point)) <= 0)
                continue;
            inside = weights.minCoeff();
            best = {f, weights};
        }
        return best;
    }

    bool lies_on_both_sides(Edge e, const FacePoint& wanted) const {
        return std::ranges::all_of(faces_of(e), [&](std::uint32_t face) {
            return face == wanted.face || lies_on(face, wanted.point, mesh_.calc_edge_length(e));
        });
    }

    /// Splits the edge in its middle, or where its surfaces are nearest to that.
    bool divide(Edge e) {
        const Point middle = mesh_.calc_edge_midpoint(e);
        const auto [first, second] = faces_of(e);
        const auto place =
            nearest_common_point(std::array{ShapeFace{&shape_, first}, ShapeFace{&shape_, second}}, middle,
                                 mesh_.calc_edge_length(e));
        const Vertex added = place ? split(e, *place) : Vertex();
        if (added.is_valid()) improve_around(added);
        return added.is_valid();
    }

    /// Halves the edges at a vertex: that alone was not enough.
    void refine_around(Vertex v) {
        std::vector<Edge> edges;
        for (const Edge e : mesh_.ve_range(v)) edges.push_back(e);
        for (const Edge e : edges) divide(e);
    }

    /// Both halves of every triangle at the edge must be fit.
    Vertex split(Edge e, const Point& p) {
        for (const int side : {0, 1}) {
            const Halfedge h = mesh_.halfedge_handle(e, side);
            const std::uint32_t on = surface(mesh_.face_handle(h));
            const Point from = mesh_.point(mesh_.from_vertex_handle(h)),
                        to = mesh_.point(mesh_.to_vertex_handle(h)),
                        apex = mesh_.point(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h)));
            if (!is_aligned(on, {from, p, apex}) || !is_aligned(on, {p, to, apex})) return Vertex();
        }
        return mesh_.split_copy(e, p);
    }

    Vertex split(Face f, const FacePoint& wanted) {
        const auto [a, b, c] = corners(f);
        const Point& p = wanted.point;
        for (const Corners& part : {Corners{a, b, p}, Corners{b, c, p}, Corners{c, a, p}})
            if (!is_aligned(wanted.face, part)) return Vertex();
        return mesh_.split_copy(f, p);
    }

    /// Flips the edges across from the vertex while that makes angles larger.
    void improve_around(Vertex added) {
        std::vector<Edge> edges;
        const auto collect = [&] {
            for (const Halfedge h : mesh_.voh_range(added))
                edges.push_back(mesh_.edge_handle(mesh_.next_halfedge_handle(h)));
        };
        collect();
        constexpr int most_flips = 30;
        for (int flips = 0; !edges.empty() && flips < most_flips;) {
            const Edge e = edges.back();
            edges.pop_back();
            if (!try_flip(e)) continue;
            ++flips;
            collect();
        }
    }

    bool try_flip(Edge e) {
        if (is_rim(e) || !mesh_.is_flip_ok(e)) return false;
        const Halfedge h = mesh_.halfedge_handle(e, 0), o = mesh_.halfedge_handle(e, 1);
        const auto at = [&](Halfedge along) { return mesh_.point(mesh_.to_vertex_handle(along)); };
        const Point a = at(o), b = at(h), left = at(mesh_.next_halfedge_handle(h)),
                    right = at(mesh_.next_halfedge_handle(o));
        const auto worst = [](const Corners& one, const Corners& other) {
            return std::min(remeshing::quality(one), remeshing::quality(other));
        };
        const Corners first{left, right, b}, second{right, left, a};
        if (worst(first, second) <= worst({a, b, left}, {b, a, right}) + 1e-9) return false;
        const std::uint32_t on = surface(mesh_.face_handle(h));
        if (!is_aligned(on, first) || !is_aligned(on, second)) return false;
        mesh_.flip(e);
        return true;
    }

    Mesh& mesh_;
    const Shape& shape_;
    OpenMesh::FPropHandleT<std::uint32_t> surface_;
};

}  // namespace

void insert_points(volmesh::TriMesh& mesh, const Shape& shape, std::span<const FacePoint> points) {
    Inserter inserter(mesh, shape);
    for (const FacePoint& point : points) inserter.insert(point);
}

}  // namespace maille::modeler
