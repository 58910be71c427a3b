#include "refine/simplex_tree.hh"

#include <unsupported/Eigen/BVH>
#include <utility>

#include <Eigen/Geometry>

#include "volmesh/tet_topology.hh"

namespace maille::refine {
namespace {

using Weights = Eigen::Vector4d;
using Box = Eigen::AlignedBox3d;

Box box_of(const Simplex& simplex) {
    Box box;
    for (int i = 0; i < simplex.n_corners; ++i) box.extend(simplex.corners[i]);
    return box;
}

/// How far along the segment from 0, at a, to 1, at b.
double nearest_on_segment(const Point& a, const Point& b, const Point& p) {
    const Point way = b - a;
    const double along = way.dot(p - a);
    if (along <= 0) return 0;
    const double whole = way.squaredNorm();
    return along >= whole ? 1 : along / whole;
}

/// Barycentric coordinates of the point of the triangle abc nearest to p, by the region that p lies in.
/// (C. Ericson, "Real-Time Collision Detection", 5.1.5.)
Eigen::Vector3d nearest_on_triangle(const Point& a, const Point& b, const Point& c, const Point& p) {
    const Point ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
    if (va <= 0) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {0, 1 - w, w};
    }
    return Eigen::Vector3d(va, vb, vc) / (va + vb + vc);
}

/// Barycentric coordinates of p; where the tetrahedron is flat, those of a point that is outside.
Weights barycentric(const std::array<Point, 4>& t, const Point& p) {
    const auto det = [](const Point& a, const Point& b, const Point& c) { return a.cross(b).dot(c); };
    const Point b = t[1] - t[0], c = t[2] - t[0], d = t[3] - t[0], q = p - t[0];
    const double whole = det(b, c, d);
    if (whole == 0) return Weights::Constant(-1);
    const double wb = det(q, c, d) / whole, wc = det(b, q, d) / whole, wd = det(b, c, q) / whole;
    return {1 - wb - wc - wd, wb, wc, wd};
}

NearestOnSimplex with_distance(const Simplex& simplex, const Weights& weights, const Point& p) {
    NearestOnSimplex found{weights, 0};
    found.squared_distance = (p - found.of(simplex)).squaredNorm();
    return found;
}

NearestOnSimplex nearest_on_tetrahedron(const Simplex& simplex, const Point& p) {
    const auto& t = simplex.corners;
    if (const Weights inside = barycentric(t, p); inside.minCoeff() >= 0) return {inside, 0};
    NearestOnSimplex best;
    for (const auto& f : volmesh::tet::face_vertices) {
        const Eigen::Vector3d on_face = nearest_on_triangle(t[f[0]], t[f[1]], t[f[2]], p);
        Weights weights = Weights::Zero();
        for (int i = 0; i < 3; ++i) weights[f[i]] = on_face[i];
        const NearestOnSimplex found = with_distance(simplex, weights, p);
        if (found.squared_distance < best.squared_distance) best = found;
    }
    return best;
}

}  // namespace

Point NearestOnSimplex::of(const Simplex& simplex) const {
    Point point = Point::Zero();
    for (int i = 0; i < simplex.n_corners; ++i) point += weights[i] * simplex.corners[i];
    return point;
}

NearestOnSimplex nearest_on(const Simplex& simplex, const Point& p) {
    const auto& c = simplex.corners;
    if (simplex.n_corners == 4) return nearest_on_tetrahedron(simplex, p);
    Weights weights(1, 0, 0, 0);
    if (simplex.n_corners == 3) weights.head<3>() = nearest_on_triangle(c[0], c[1], c[2], p);
    if (simplex.n_corners == 2) {
        const double t = nearest_on_segment(c[0], c[1], p);
        weights.head<2>() = Eigen::Vector2d(1 - t, t);
    }
    return with_distance(simplex, weights, p);
}

struct SimplexTree::Boxes {
    std::vector<Simplex> simplices;
    Eigen::KdBVH<double, 3, std::uint32_t> tree;
};

SimplexTree::SimplexTree(std::vector<Simplex> simplices) {
    std::vector<std::uint32_t> indices;
    std::vector<Box> boxes;
    for (const Simplex& simplex : simplices) {
        indices.push_back(static_cast<std::uint32_t>(indices.size()));
        boxes.push_back(box_of(simplex));
    }
    boxes_ = std::make_shared<const Boxes>(
        Boxes{std::move(simplices), {indices.begin(), indices.end(), boxes.begin(), boxes.end()}});
}

double SimplexTree::least(const Point& p, const std::function<double(double)>& bound,
                          const std::function<double(std::uint32_t)>& value) const {
    struct Minimizer {
        using Scalar = double;
        const Point& p;
        const std::function<double(double)>& bound;
        const std::function<double(std::uint32_t)>& value;
        double minimumOnVolume(const Box& box) const { return bound(box.exteriorDistance(p)); }
        double minimumOnObject(std::uint32_t i) const { return value(i); }
    };
    Minimizer minimizer{p, bound, value};
    return Eigen::BVMinimize(boxes_->tree, minimizer);
}

SimplexTree::Nearest SimplexTree::nearest(const Point& p, double limit) const {
    struct Minimizer {
        using Scalar = double;
        const std::vector<Simplex>& simplices;
        const Point& p;
        double limit;
        Nearest best{};
        double minimumOnVolume(const Box& box) const {
            const double squared = box.squaredExteriorDistance(p);
            return squared > limit * limit ? std::numeric_limits<double>::max() : squared;
        }
        double minimumOnObject(std::uint32_t i) {
            const NearestOnSimplex found = nearest_on(simplices[i], p);
            if (found.squared_distance < best.squared_distance ||
                (found.squared_distance == best.squared_distance && i < best.simplex))
                best = {found, i};
            return found.squared_distance;
        }
    };
    Minimizer minimizer{boxes_->simplices, p, limit};
    Eigen::BVMinimize(boxes_->tree, minimizer);
    return minimizer.best;
}

const Simplex& SimplexTree::operator[](std::uint32_t i) const {
    return boxes_->simplices[i];
}

std::size_t SimplexTree::size() const {
    return boxes_->simplices.size();
}

}  // namespace maille::refine
