#include "volmesh/orientation.hh"

#include <cmath>

#include <Eigen/Geometry>
#include <boost/multiprecision/cpp_int.hpp>

namespace maille::volmesh {
namespace {

int exact_orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
    using Number = boost::multiprecision::cpp_rational;
    std::array<std::array<Number, 3>, 3> m;
    const std::array<const Point*, 3> ends{&b, &c, &d};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) m[i][j] = Number((*ends[i])[j]) - Number(a[j]);
    const Number det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                       m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                       m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    return det.sign();
}

}  // namespace

int orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
    const Point u = b - a;
    const Point v = c - a;
    const Point w = d - a;
    const double det = u.cross(v).dot(w);
    // Shewchuk's bound on the error (Adaptive Precision Floating-Point Arithmetic, 1997, section 4.3),
    // rounded up.
    const Point size = u.cwiseAbs();
    const double permanent = size[0] * (std::abs(v[1] * w[2]) + std::abs(v[2] * w[1])) +
                             size[1] * (std::abs(v[2] * w[0]) + std::abs(v[0] * w[2])) +
                             size[2] * (std::abs(v[0] * w[1]) + std::abs(v[1] * w[0]));
    constexpr double bound = 1e-15;
    constexpr double no_underflow = 1e-290;
    if (std::abs(det) > bound * permanent && permanent > no_underflow) return det > 0 ? 1 : -1;
    return exact_orientation(a, b, c, d);
}

}  // namespace maille::volmesh
