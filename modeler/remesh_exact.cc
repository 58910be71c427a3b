#include "modeler/remesh_exact.hh"

#include <algorithm>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace maille::modeler::remeshing {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 exact(const Vec3& p) {
    return {p.x(), p.y(), p.z()};
}

Kernel::Triangle_3 exact(const Corners& c) {
    return {exact(c[0]), exact(c[1]), exact(c[2])};
}

// Far above the rounding of a few products of differences, far below any angle that matters.
constexpr double margin = 1e-10;

/// A plane with the one triangle on this side and the other on that, seen in floating point with room to
/// spare. It spares nearly all exact tests, above all those of triangles in one plane, which are slow.
bool clearly_apart(const Corners& a, const Corners& b) {
    const Vec3 axis = (a[0] + a[1] + a[2]) - (b[0] + b[1] + b[2]);
    const Vec3& origin = a[0];
    double lowest = 0;
    for (const Vec3& p : a) lowest = std::min(lowest, axis.dot(p - origin));
    double reach = 0;
    double highest = -std::numeric_limits<double>::infinity();
    for (const Vec3& p : b) {
        highest = std::max(highest, axis.dot(p - origin));
        reach = std::max(reach, (p - origin).norm());
    }
    return highest < lowest - margin * axis.norm() * reach;
}

/// The same for triangles with a common vertex, through which the plane goes.
bool clearly_apart(const Vec3& common, const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b) {
    const Vec3 a0 = (a[0] - common).normalized();
    const Vec3 a1 = (a[1] - common).normalized();
    const Vec3 b0 = (b[0] - common).normalized();
    const Vec3 b1 = (b[1] - common).normalized();
    const auto parts = [&](const Vec3& axis) {
        return axis.dot(a0) > margin && axis.dot(a1) > margin && axis.dot(b0) < -margin &&
               axis.dot(b1) < -margin;
    };
    return parts((a0 + a1).normalized() - (b0 + b1).normalized()) || parts(a0 + a1 - b0 - b1);
}

/// Seen in floating point, with room to spare for the rounding of two products and their difference.
bool clearly_has_area(const Corners& c) {
    const Vec3 a = c[1] - c[0];
    const Vec3 b = c[2] - c[0];
    return a.cross(b).cwiseAbs().maxCoeff() > 1e-14 * a.cwiseAbs().maxCoeff() * b.cwiseAbs().maxCoeff();
}

bool folded(const Vec3& s0, const Vec3& s1, const Vec3& a, const Vec3& b) {
    const auto p0 = exact(s0);
    const auto p1 = exact(s1);
    const auto pa = exact(a);
    const auto pb = exact(b);
    return CGAL::orientation(p0, p1, pa, pb) == CGAL::COPLANAR && !CGAL::collinear(p0, p1, pa) &&
           CGAL::coplanar_orientation(p0, p1, pa, pb) == CGAL::POSITIVE;
}

bool collide_beyond(const Vec3& common, const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b) {
    if (clearly_apart(common, a, b)) return false;
    if (has_no_area({common, a[0], a[1]}) || has_no_area({common, b[0], b[1]})) return false;
    const Kernel::Triangle_3 first(exact(common), exact(a[0]), exact(a[1]));
    const Kernel::Triangle_3 second(exact(common), exact(b[0]), exact(b[1]));
    return CGAL::do_intersect(Kernel::Segment_3(first[1], first[2]), second) ||
           CGAL::do_intersect(Kernel::Segment_3(second[1], second[2]), first);
}

bool an_edge_meets(const Kernel::Triangle_3& line, const Kernel::Triangle_3& triangle) {
    for (int i = 0; i < 3; ++i)
        if (CGAL::do_intersect(Kernel::Segment_3(line[i], line[i + 1]), triangle)) return true;
    return false;
}

bool collide_apart(const Corners& a, const Corners& b) {
    if (clearly_apart(a, b)) return false;
    const Kernel::Triangle_3 first = exact(a);
    const Kernel::Triangle_3 second = exact(b);
    if (has_no_area(a)) return !has_no_area(b) && an_edge_meets(first, second);
    if (has_no_area(b)) return an_edge_meets(second, first);
    return CGAL::do_intersect(first, second);
}

}  // namespace

bool collide(const PlacedTriangle& a, const PlacedTriangle& b) {
    // Bring the shared vertices to the front, in the same order.
    PlacedTriangle first = a;
    PlacedTriangle second = b;
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto match = std::find(second.vertices.begin() + static_cast<std::ptrdiff_t>(shared),
                                     second.vertices.end(), first.vertices[i]);
        if (match == second.vertices.end()) continue;
        const auto j = static_cast<std::size_t>(match - second.vertices.begin());
        std::swap(first.vertices[shared], first.vertices[i]);
        std::swap(first.corners[shared], first.corners[i]);
        std::swap(second.vertices[shared], second.vertices[j]);
        std::swap(second.corners[shared], second.corners[j]);
        ++shared;
    }
    const auto& p = first.corners;
    const auto& q = second.corners;
    switch (shared) {
        case 0:
            return collide_apart(p, q);
        case 1:
            return collide_beyond(p[0], {p[1], p[2]}, {q[1], q[2]});
        case 2:
            return folded(p[0], p[1], p[2], q[2]);
        default:
            return true;
    }
}

bool has_no_area(const Corners& corners) {
    return !clearly_has_area(corners) && exact(corners).is_degenerate();
}

bool is_inside(const std::array<Vec3, 4>& t, const Vec3& p) {
    const auto a = exact(t[0]);
    const auto b = exact(t[1]);
    const auto c = exact(t[2]);
    const auto d = exact(t[3]);
    const auto x = exact(p);
    const CGAL::Orientation whole = CGAL::orientation(a, b, c, d);
    return whole != CGAL::COPLANAR && CGAL::orientation(x, b, c, d) == whole &&
           CGAL::orientation(a, x, c, d) == whole && CGAL::orientation(a, b, x, d) == whole &&
           CGAL::orientation(a, b, c, x) == whole;
}

}  // namespace maille::modeler::remeshing
