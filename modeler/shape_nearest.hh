#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

namespace maille::modeler {

/// The point of an ellipse (N = 2) or ellipsoid (N = 3) nearest to q, in the axes of the ellipsoid; `semi`
/// holds its semi-axes in descending order. Where several points are equally near, the one with positive
/// coordinates.
///
/// The nearest point is x_i = e_i^2 q_i / (s + g_i), with g_i = e_i^2 - e_N^2 and the one s >= 0 that puts it
/// on the ellipsoid (D. Eberly, "Distance from a point to an ellipse, an ellipsoid, or a hyperellipsoid",
/// 2013). The reciprocal norm of (x_i / e_i) is concave in s, so Newton's method on it converges from below,
/// and fast (J. More, D. Sorensen, "Computing a trust region step", 1983).
template <int N>
Eigen::Vector<double, N> nearest_on_ellipsoid(const Eigen::Vector<double, N>& semi,
                                              const Eigen::Vector<double, N>& q) {
    using Vector = Eigen::Vector<double, N>;
    const double least = semi[N - 1];
    const Vector a = semi.cwiseProduct(q.cwiseAbs());
    Vector gap;
    for (int i = 0; i < N; ++i) gap[i] = (semi[i] - least) * (semi[i] + least);

    Vector unit;  // x_i / e_i
    const auto set_unit = [&](double s) {
        for (int i = 0; i < N; ++i) unit[i] = a[i] > 0 ? a[i] / (s + gap[i]) : 0;
    };
    const auto in_space = [&] {
        Vector x = unit.cwiseProduct(semi);
        for (int i = 0; i < N; ++i)
            if (q[i] < 0) x[i] = -x[i];
        return x;
    };

    double s = 0;
    bool in_focal_space = true;
    for (int i = 0; i < N; ++i) {
        if (a[i] > 0) s = std::max(s, a[i] - gap[i]);
        in_focal_space &= a[i] == 0 || gap[i] > 0;
    }
    if (in_focal_space) {
        set_unit(0);
        const double rest = 1 - unit.squaredNorm();
        if (rest >= 0) {
            unit[N - 1] = std::sqrt(rest);
            return in_space();
        }
    }
    for (int iteration = 0; iteration < 100; ++iteration) {
        set_unit(s);
        double slope = 0;
        for (int i = 0; i < N; ++i)
            if (a[i] > 0) slope += unit[i] * unit[i] / (s + gap[i]);
        const double step = (unit.norm() - 1) * unit.squaredNorm() / slope;
        if (!(step > std::numeric_limits<double>::epsilon() * s)) break;
        s += step;
    }
    set_unit(s);
    unit.normalize();
    return in_space();
}

/// The point of the half cone (x/a)^2 + (y/b)^2 = z^2, z >= 0, a >= b > 0, nearest to q: the apex, or a root
/// like the one above.
Eigen::Vector3d nearest_on_elliptic_cone(double a, double b, const Eigen::Vector3d& q);

}  // namespace maille::modeler
