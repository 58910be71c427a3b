#pragma once

#include <vector>

#include "modeler/shape_cone.hh"
#include "modeler/shape_ellipsoid.hh"
#include "modeler/shape_polyhedron.hh"
#include "modeler/shape_torus.hh"
#include "modeler/tessellate.hh"
#include "modeler/tessellate_polygon.hh"

namespace maille::modeler {

/// A closed surface of triangles, each on a face of the shape: right in topology and about right in size.
struct SurfaceSeed {
    std::vector<Point> points;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> surfaces;  ///< by triangle
    std::vector<std::uint32_t> corners;   ///< points that must stay, besides those between two faces

    std::uint32_t add_point(const Point& p);
    void add_triangle(const Triangle& triangle, std::uint32_t surface, bool mirrored = false);
};

/// The edge lengths that the options ask for.
class Sizing {
  public:
    Sizing(const Shape& shape, const TessellateOptions& options) : shape_(shape), options_(options) {}

    double size() const { return options_.size; }
    /// On a surface or curve of that curvature: an eighth of a circle at most.
    double for_curvature(double curvature) const;
    /// At a point of a face.
    double at(std::uint32_t face, const Point& p) const;
    /// No length on the face is smaller: the limit near the apex of a cone.
    double smallest(std::uint32_t face) const { return for_curvature(shape_.max_curvature(face)) / 4; }

  private:
    const Shape& shape_;
    TessellateOptions options_;
};

SurfaceSeed seed_surface(const Ellipsoid& shape, const Sizing& sizing);
SurfaceSeed seed_surface(const Torus& shape, const Sizing& sizing);
SurfaceSeed seed_surface(const Cone& shape, const Sizing& sizing);
SurfaceSeed seed_surface(const Polyhedron& shape, const Sizing& sizing);

/// Covers a planar face, whose boundary is the loops of points of the seed, with triangles of about that
/// size.
void fill_planar_face(SurfaceSeed& seed, const Plane& plane,
                      const std::vector<std::vector<std::uint32_t>>& loops, std::uint32_t surface,
                      double size);

}  // namespace maille::modeler
