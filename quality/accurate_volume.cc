#include "quality/accurate_volume.hh"

#include <array>

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace maille::quality {
namespace {

using Number = boost::multiprecision::cpp_bin_float_quad;
using Vector = std::array<Number, 3>;

Vector edge(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double unit) {
    Vector v;
    for (int i = 0; i < 3; ++i) v[i] = (Number(to[i]) - Number(from[i])) / unit;
    return v;
}

Vector cross(const Vector& u, const Vector& v) {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

Number dot(const Vector& u, const Vector& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

}  // namespace

AccurateVolume accurate_volume(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                               const Eigen::Vector3d& d, double unit) {
    const std::array edges{edge(a, b, unit), edge(a, c, unit), edge(a, d, unit)};
    Vector towards_center{};
    Vector normal;
    for (int i = 0; i < 3; ++i) {
        normal = cross(edges[(i + 1) % 3], edges[(i + 2) % 3]);
        const Number square = dot(edges[i], edges[i]);
        for (int axis = 0; axis < 3; ++axis) towards_center[axis] += square * normal[axis];
    }
    return {static_cast<double>(dot(normal, edges[2])),
            static_cast<double>(sqrt(dot(towards_center, towards_center)))};
}

}  // namespace maille::quality
