#pragma once

#include <vector>

#include <Eigen/Core>

namespace maille::picture {

/// A part of the image, in pixels.
struct Frame {
    float x, y, width, height;
};

/// A perspective camera that looks at the origin. Its image plane is moved and scaled, not its eye, to fit
/// the frame.
class Camera {
  public:
    /// Sees all of the points, as large as the frame allows. `view` runs from the points towards the eye.
    Camera(const Eigen::Vector3d& view, const std::vector<Eigen::Vector3f>& points, const Frame& frame);

    const Eigen::Vector3f& eye() const { return eye_; }
    /// Unit direction through a place of the image.
    Eigen::Vector3f direction(const Eigen::Vector2f& pixel) const;
    Eigen::Vector2f pixel(const Eigen::Vector3f& point) const;

  private:
    Eigen::Vector2f on_plane(const Eigen::Vector3f& point) const;

    Eigen::Vector3f eye_, right_, up_, forward_;
    Eigen::Vector2f offset_ = Eigen::Vector2f::Zero();
    float scale_ = 1;
};

}  // namespace maille::picture
