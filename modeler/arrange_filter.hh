#pragma once

#include <Eigen/Geometry>

namespace maille::modeler::detail {

/// The sign of the determinant of b-a, c-a and d-a, as CGAL's orientation has it, where doubles suffice to
/// tell; 0 where they don't. Each coordinate may be off by `slack`.
inline int certain_orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                               const Eigen::Vector3d& d, double slack) {
    const Eigen::Vector3d u = b - a, v = c - a, w = d - a;
    const Eigen::Array3d m = u.cwiseAbs().cwiseMax(v.cwiseAbs()).cwiseMax(w.cwiseAbs()).array() + 2 * slack;
    const double determinant = u.dot(v.cross(w));
    // Rounding as in CGAL's static filters; and each of nine entries, off by twice the slack, counts with a
    // minor of two products. Both with something to spare, and nothing certain where numbers underflow.
    const double error =
        1e-300 + 8e-15 * m[0] * m[1] * m[2] + 16 * slack * (m[0] * m[1] + m[1] * m[2] + m[2] * m[0]);
    if (determinant > error) return 1;
    if (determinant < -error) return -1;
    return 0;
}

}  // namespace maille::modeler::detail
