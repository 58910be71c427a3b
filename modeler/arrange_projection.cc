#include "modeler/arrange_projection.hh"

#include <array>
#include <cmath>

#include <Eigen/Geometry>

namespace maille::modeler::detail {

namespace {

CGAL::Sign orientation_without(int axis, const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto flat = [&](const ExactPoint& p) { return Exact::Point_2(p[u], p[v]); };
    return CGAL::orientation(flat(a), flat(b), flat(c));
}

}  // namespace

Projection::Projection(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c)
    : axis_(0), mirrored_(false) {
    constexpr double anything =
        std::numeric_limits<double>::infinity();  // the choice need not be the best one
    const Eigen::Vector3d p = approximate(a, anything), q = approximate(b, anything),
                          r = approximate(c, anything);
    const Eigen::Vector3d size = (q - p).cross(r - p).cwiseAbs();
    std::array<int, 3> axes{0, 1, 2};
    std::stable_sort(axes.begin(), axes.end(), [&](int i, int j) { return size[i] > size[j]; });
    for (const int axis : axes) {
        const auto sign = orientation_without(axis, a, b, c);
        if (sign == CGAL::ZERO) continue;
        axis_ = axis;
        mirrored_ = sign == CGAL::NEGATIVE;
        return;
    }
}

ExactPoint Projection::lift(const Exact::Point_2& p, const ExactPlane& plane) const {
    const ExactNumber &u = mirrored_ ? p.y() : p.x(), &v = mirrored_ ? p.x() : p.y();
    switch (axis_) {
        case 0:
            return {-(plane.b() * u + plane.c() * v + plane.d()) / plane.a(), u, v};
        case 1:
            return {v, -(plane.c() * u + plane.a() * v + plane.d()) / plane.b(), u};
        default:
            return {u, v, -(plane.a() * u + plane.b() * v + plane.d()) / plane.c()};
    }
}

}  // namespace maille::modeler::detail
