#pragma once

#include <memory>
#include <vector>

#include "modeler/primitive.hh"
#include "modeler/shape_plane.hh"

namespace maille::modeler {

class SignedDistance;

/// A solid bounded by planar polygons: a closed surface, oriented outwards.
class Polyhedron final : public Shape {
  public:
    struct Polygon {
        std::vector<std::vector<std::uint32_t>> loops;  ///< outline counter-clockwise, then holes
        std::string name;
    };

    Polyhedron(std::vector<Point> points, std::vector<Polygon> polygons);

    std::span<const PrimitiveFace> faces() const override { return faces_; }
    Eigen::AlignedBox3d bounding_box() const override;
    double implicit(const Point& p) const override;
    double face_implicit(std::uint32_t face, const Point& p) const override;
    Point face_normal(std::uint32_t face, const Point& p) const override;
    Eigen::Matrix3d face_curvature(std::uint32_t face, const Point& p) const override;
    Point project(std::uint32_t face, const Point& p) const override;
    double max_curvature(std::uint32_t face) const override;

    std::span<const Point> points() const { return points_; }
    const Polygon& polygon(std::uint32_t face) const { return polygons_[face]; }
    const Plane& plane(std::uint32_t face) const { return planes_[face]; }

  private:
    bool is_convex() const;

    std::vector<Point> points_;
    std::vector<Polygon> polygons_;
    std::vector<Plane> planes_;
    std::vector<PrimitiveFace> faces_;
    std::shared_ptr<const SignedDistance> distance_;  ///< where the planes alone don't tell the inside
};

/// Twice the area of a polygon's loops, times their normal.
Point area_vector(std::span<const Point> points, const std::vector<std::vector<std::uint32_t>>& loops);

/// The triangles of a polygon that lies in the plane, counter-clockwise seen from the plane's normal.
std::vector<std::array<std::uint32_t, 3>> triangulate_polygon(
    std::span<const Point> points, const std::vector<std::vector<std::uint32_t>>& loops, const Plane& plane);

}  // namespace maille::modeler
