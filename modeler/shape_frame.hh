#pragma once

#include <Eigen/Geometry>

namespace maille::modeler {

/// Throws InputError unless the map is finite and not singular.
void check_frame(const Eigen::Affine3d& frame);

/// Throws InputError unless the parameter of that name is a finite number above 0 (or, allowed, 0 itself).
void check_positive(double value, const char* name);
void check_not_negative(double value, const char* name);

/// Whether the map is a rotation or mirror times a scale, to rounding.
bool is_similarity(const Eigen::Matrix3d& linear);

/// Largest and smallest factor by which the map stretches a length.
double largest_stretch(const Eigen::Matrix3d& linear);
double smallest_stretch(const Eigen::Matrix3d& linear);

/// The point i of n on the unit circle; exact and exactly symmetric at every eighth of the circle.
Eigen::Vector2d unit_circle(int i, int n);

/// Rate of turn of the unit normal of the level set of a function that has this gradient and Hessian.
Eigen::Matrix3d level_set_curvature(const Eigen::Vector3d& gradient, const Eigen::Matrix3d& hessian);

}  // namespace maille::modeler
