#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "modeler/primitive.hh"

namespace maille::modeler {

/// The standard solids. Each is made in its own coordinates and then mapped by `frame`, which may be any
/// affine map that is not singular: mirrors, non-uniform scales and shears included. The images are exact.
/// All throw InputError, with a message that names the wrong parameter, on values that make no solid.

/// A box: from the origin, or centred on it. Faces `x- x+ y- y+ z- z+`.
std::shared_ptr<const Shape> make_cube(const Eigen::Vector3d& size, bool center,
                                       const Eigen::Affine3d& frame = Eigen::Affine3d::Identity());

/// Face `surface`.
std::shared_ptr<const Shape> make_sphere(double radius,
                                         const Eigen::Affine3d& frame = Eigen::Affine3d::Identity());

/// Face `surface`; the semi-axes lie along x, y and z.
std::shared_ptr<const Shape> make_ellipsoid(const Eigen::Vector3d& semi_axes,
                                            const Eigen::Affine3d& frame = Eigen::Affine3d::Identity());

/// A cylinder, cone or frustum around z, from z = 0 to `height` or centred on z = 0, of radius `r1` at the
/// bottom and `r2` at the top. Faces `side bottom top`; where a radius is 0 that cap does not exist.
std::shared_ptr<const Shape> make_cylinder(double height, double r1, double r2, bool center,
                                           const Eigen::Affine3d& frame = Eigen::Affine3d::Identity());

/// A ring around z: a tube of radius `minor` along a circle of radius `major` > `minor`. Face `surface`.
std::shared_ptr<const Shape> make_torus(double major, double minor,
                                        const Eigen::Affine3d& frame = Eigen::Affine3d::Identity());

/// A box from the origin whose top (at z = size.z) reaches from x = 0 to `dx` only. Faces as the cube's; a
/// `dx` of 0 makes the top an edge, and `z+` does not exist.
std::shared_ptr<const Shape> make_wedge(const Eigen::Vector3d& size, double dx,
                                        const Eigen::Affine3d& frame = Eigen::Affine3d::Identity());

/// A regular prism of n sides around z, from z = 0 to `height`; its corners lie at `radius`, the first one on
/// the x axis. Faces `side0 side1 ... bottom top`.
std::shared_ptr<const Shape> make_prism(int n, double radius, double height,
                                        const Eigen::Affine3d& frame = Eigen::Affine3d::Identity());

/// A regular pyramid with the base of the prism and its tip at z = `height`. Faces `side0 side1 ... bottom`.
std::shared_ptr<const Shape> make_pyramid(int n, double radius, double height,
                                          const Eigen::Affine3d& frame = Eigen::Affine3d::Identity());

/// Faces `face0` to `face3`; face i is opposite point i. The points may come in either orientation.
std::shared_ptr<const Shape> make_tetrahedron(const std::array<Point, 4>& points,
                                              const Eigen::Affine3d& frame = Eigen::Affine3d::Identity());

/// A polygon of a polyhedron. The first loop is its outline, counter-clockwise seen from outside the solid;
/// any further loops are holes, clockwise.
struct PolyhedronFace {
    std::vector<std::vector<std::uint32_t>> loops;  ///< indices of points
    std::string name;                               ///< of the surface
};

/// A closed polyhedron, convex or not. Each edge belongs to exactly two faces; those that are inside out are
/// turned round. Equal points are taken for one, but where parts touch in it only. A face that is not planar
/// is cut into triangles, each a surface of its own with the face's name.
std::shared_ptr<const Shape> make_polyhedron(std::vector<Point> points, std::vector<PolyhedronFace> faces,
                                             const Eigen::Affine3d& frame = Eigen::Affine3d::Identity());

/// The same with one loop a face.
std::shared_ptr<const Shape> make_polyhedron(std::vector<Point> points,
                                             std::vector<std::vector<std::uint32_t>> faces,
                                             std::vector<std::string> face_names,
                                             const Eigen::Affine3d& frame = Eigen::Affine3d::Identity());

/// The part of a half-space that matters: all of it within `clip` (a box in space, after `frame`), and
/// somewhat more. The half-space lies behind the plane through `point`, `normal` points out of it. Face 0 is
/// `plane`; the others, named `clip1` to `clip5`, lie outside `clip`.
std::shared_ptr<const Shape> make_halfspace(const Point& point, const Eigen::Vector3d& normal,
                                            const Eigen::AlignedBox3d& clip,
                                            const Eigen::Affine3d& frame = Eigen::Affine3d::Identity());

}  // namespace maille::modeler
