#include "modeler/geo_bounds.hh"

#include <algorithm>
#include <vector>

#include <Eigen/LU>

namespace maille::modeler {

std::vector<Plane> planes_of(const Eigen::AlignedBox3d& box) {
    std::vector<Plane> planes;
    for (int axis = 0; axis < 3; ++axis) {
        planes.emplace_back(box.min(), -Point::Unit(axis));
        planes.emplace_back(box.max(), Point::Unit(axis));
    }
    return planes;
}

// The corners of what they bound are where three planes meet behind all the others.
Eigen::AlignedBox3d box_behind(std::span<const Plane> planes, const Eigen::AlignedBox3d& world) {
    constexpr std::size_t most = 100;
    std::vector<Plane> all = planes_of(world);
    all.insert(all.end(), planes.begin(),
               planes.begin() + static_cast<std::ptrdiff_t>(std::min(most, planes.size())));
    const double tolerance = 1e-11 * world.diagonal().norm();
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            for (std::size_t k = 0; k < j; ++k) {
                Eigen::Matrix3d normals;
                normals << all[i].normal().transpose(), all[j].normal().transpose(),
                    all[k].normal().transpose();
                if (std::abs(normals.determinant()) < 1e-9) continue;
                const Point corner = normals.inverse() * Point(all[i].normal().dot(all[i].origin()),
                                                               all[j].normal().dot(all[j].origin()),
                                                               all[k].normal().dot(all[k].origin()));
                if (std::ranges::all_of(all, [&](const Plane& p) { return p.distance(corner) <= tolerance; }))
                    box.extend(corner);
            }
    return box;
}

bool reaches(const Eigen::AlignedBox3d& box, const Eigen::AlignedBox3d& world) {
    const double margin = 1e-6 * world.diagonal().norm();
    return (box.min().array() < world.min().array() + margin).any() ||
           (box.max().array() > world.max().array() - margin).any();
}

}  // namespace maille::modeler
