#include "tools/picture/camera.hh"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace maille::picture {
namespace {

/// Far enough for a calm perspective of the unit ball.
constexpr float distance = 5;

}  // namespace

Camera::Camera(const Eigen::Vector3d& view, const std::vector<Eigen::Vector3f>& points, const Frame& frame) {
    const Eigen::Vector3f back = view.normalized().cast<float>();
    eye_ = distance * back;
    forward_ = -back;
    // Looking straight up or down, y is up in the picture.
    const Eigen::Vector3f upward =
        std::abs(back.z()) < 0.9999F ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitY();
    right_ = forward_.cross(upward).normalized();
    up_ = right_.cross(forward_);

    Eigen::AlignedBox2f seen;
    for (const Eigen::Vector3f& p : points) seen.extend(on_plane(p));
    const Eigen::Vector2f size = seen.sizes().cwiseMax(1e-6F);
    scale_ = std::min(frame.width / size.x(), frame.height / size.y());
    offset_ = Eigen::Vector2f(frame.x + frame.width / 2, frame.y + frame.height / 2) - scale_ * seen.center();
}

Eigen::Vector2f Camera::on_plane(const Eigen::Vector3f& point) const {
    const Eigen::Vector3f from_eye = point - eye_;
    return Eigen::Vector2f(right_.dot(from_eye), -up_.dot(from_eye)) / forward_.dot(from_eye);
}

Eigen::Vector2f Camera::pixel(const Eigen::Vector3f& point) const {
    return scale_ * on_plane(point) + offset_;
}

Eigen::Vector3f Camera::direction(const Eigen::Vector2f& pixel) const {
    const Eigen::Vector2f place = (pixel - offset_) / scale_;
    return (forward_ + place.x() * right_ - place.y() * up_).normalized();
}

}  // namespace maille::picture
