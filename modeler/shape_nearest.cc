#include "modeler/shape_nearest.hh"

namespace maille::modeler {

// Lagrange's conditions give x = a^2 qx / (a^2 + t), y = b^2 qy / (b^2 + t), z = qz / (1 - t) = |(x/a, y/b)|.
// With s = t + b^2 the last equation is qz / norm(s) = 1 + b^2 - s, whose left side is concave in s where qz
// > 0 and convex where qz < 0; Newton's method converges from below in the first case, from above in the
// second.
Eigen::Vector3d nearest_on_elliptic_cone(double a, double b, const Eigen::Vector3d& q) {
    const double ax = a * std::abs(q.x()), by = b * std::abs(q.y()), z = q.z();
    const double gap = (a - b) * (a + b), end = 1 + b * b;
    double u = 0, v = 0;  // x / a, y / b
    const auto set = [&](double s) {
        u = ax > 0 ? ax / (s + gap) : 0;
        v = by > 0 ? by / s : 0;
    };
    const auto in_space = [&] {
        return Eigen::Vector3d(std::copysign(a * u, q.x()), q.y() < 0 ? -b * v : b * v, std::hypot(u, v));
    };
    if (z <= 0 && std::hypot(ax, by) <= -z) return Eigen::Vector3d::Zero();
    if (z > 0 && by == 0 && (ax == 0 || gap > 0)) {
        set(0);
        const double norm = z / end;
        if (u <= norm) {
            v = std::sqrt((norm - u) * (norm + u));
            return in_space();
        }
    }
    double s = end;
    if (z > 0) s = end * std::max(ax > 0 ? (ax - gap * z / end) / (z + ax) : 0, by / (z + by));
    const auto newton_step = [&] {
        set(s);
        const double norm = std::hypot(u, v);
        const double slope = (ax > 0 ? u * u / (s + gap) : 0) + (by > 0 ? v * v / s : 0);
        return -(z / norm - end + s) / (z * slope / (norm * norm * norm) + 1);
    };
    if (z < 0) {
        const auto below_root = [&] {
            set(s);
            return z / std::hypot(u, v) - end + s < 0;
        };
        while (below_root() && s < 1e100) s += 2 * s;
    }
    for (int iteration = 0; iteration < 200; ++iteration) {
        const double step = newton_step();
        const double previous = s;
        if (z == 0 || !((z > 0) == (step > 0))) break;
        s += step;
        if (s == previous) break;
    }
    set(s);
    return in_space();
}

}  // namespace maille::modeler
