#pragma once

#include <Eigen/Core>

namespace maille::quality {

/// What a near-flat tetrahedron loses to cancellation, worked out with twice the digits.
struct AccurateVolume {
    double six_volumes;  ///< (b-a)x(c-a).(d-a)
    /// 12 V times the circumradius: the length of the sum of |b-a|^2 (c-a)x(d-a) and so on.
    double twelve_volumes_times_radius;
};

/// In units of `unit`, a power of two. Precondition: finite points. Cost: some microseconds.
AccurateVolume accurate_volume(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                               const Eigen::Vector3d& d, double unit);

}  // namespace maille::quality
