#include "modeler/shape_cone.hh"

#include <algorithm>

#include "modeler/shape_frame.hh"

namespace maille::modeler {

Cone::Cone(double r1, double r2, const Eigen::Affine3d& map)
    : map_((check_frame(map), map)), side_(r1, r2, map), faces_{{"side", false}} {
    const Point up = map.linear().inverse().transpose().col(2);
    const auto add_cap = [&](const char* name, double z, const Point& normal) {
        faces_.push_back({name, true});
        caps_.emplace_back(map * Point(0, 0, z), normal);
        return static_cast<std::uint32_t>(caps_.size());
    };
    if (r1 > 0) bottom_ = add_cap("bottom", 0, -up);
    if (r2 > 0) top_ = add_cap("top", 1, up);
}

Eigen::AlignedBox3d Cone::bounding_box() const {
    const Point reach = map_.linear().leftCols<2>().rowwise().norm();
    Eigen::AlignedBox3d box;
    for (double z : {0.0, 1.0}) {
        const Point centre = map_ * Point(0, 0, z);
        box.extend(centre - radius(z) * reach).extend(centre + radius(z) * reach);
    }
    return box;
}

double Cone::implicit(const Point& p) const {
    double largest = side_.implicit(p);
    for (const Plane& cap : caps_) largest = std::max(largest, cap.distance(p));
    return largest;
}

double Cone::face_implicit(std::uint32_t face, const Point& p) const {
    return face == 0 ? side_.implicit(p) : caps_[face - 1].distance(p);
}

Point Cone::face_normal(std::uint32_t face, const Point& p) const {
    return face == 0 ? side_.normal(p) : caps_[face - 1].normal();
}

Eigen::Matrix3d Cone::face_curvature(std::uint32_t face, const Point& p) const {
    return face == 0 ? side_.curvature(p) : Eigen::Matrix3d::Zero();
}

Point Cone::project(std::uint32_t face, const Point& p) const {
    return face == 0 ? side_.project(p) : caps_[face - 1].project(p);
}

double Cone::max_curvature(std::uint32_t face) const {
    return face == 0 ? side_.max_curvature() : 0;
}

}  // namespace maille::modeler
