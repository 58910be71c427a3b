#pragma once

#include <vector>

#include "modeler/shape_cone.hh"
#include "modeler/shape_ellipsoid.hh"
#include "modeler/shape_polyhedron.hh"
#include "modeler/shape_torus.hh"
#include "modeler/shape_turned.hh"
#include "modeler/shared_surface.hh"
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
    /// No part of the shape is thinner than twice that radius, but for an edge or apex.
    Sizing(const Shape& shape, const TessellateOptions& options, double thinnest_radius);

    double size() const { return options_.size; }
    /// On a surface or curve of that curvature: an eighth of a circle at most. Sharper bends than the
    /// thinness of the shape explains (the rim of a flat ellipsoid, the apex of a cone) make the length no
    /// smaller.
    double for_curvature(double curvature) const;
    /// At a point of a face.
    double at(std::uint32_t face, const Point& p) const;

  private:
    const Shape& shape_;
    TessellateOptions options_;
    double thinnest_radius_;
    double max_curvature_;
};

/// A count near the one wanted, within 15 %, that doubles where the wanted one does, but for the smallest: 1,
/// 2, 3, 4, 5, 6, 8, 10, 12, 16, 20... With half the size a surface so divided has facets of just half the
/// size, where simple rounding would let their errors fall by any factor from 2 to 8.
int doubling_count(double wanted, int least);

/// Half the thickness of a shape where it is thinnest.
double thinnest_radius(const Ellipsoid& shape);
double thinnest_radius(const Torus& shape);
double thinnest_radius(const Cone& shape);
double thinnest_radius(const Polyhedron& shape);
double thinnest_radius(const Turned& shape);

/// Places on a way of length 1, the first 0 and the last 1, at about the steps wanted along it: `wanted`
/// holds them at the middles of equal parts, in the same unit as `way`. Steps change gradually, and are
/// smaller where any of the wanted ones says so.
std::vector<double> graded_places(std::vector<double> wanted, double way);

SurfaceSeed seed_surface(const Ellipsoid& shape, const Sizing& sizing);
SurfaceSeed seed_surface(const Torus& shape, const Sizing& sizing);
SurfaceSeed seed_surface(const Cone& shape, const Sizing& sizing);
SurfaceSeed seed_surface(const Polyhedron& shape, const Sizing& sizing);
SurfaceSeed seed_surface(const Turned& shape, const Sizing& sizing);

/// Of a primitive that shares its curved surface with others; the sizing is that of the reference.
SurfaceSeed seed_shared_surface(const Cone& shape, const Sizing& sizing, const SharedCone& shared);
SurfaceSeed seed_shared_surface(const Ellipsoid& sphere, const SharedSphere& shared);
/// Of an ellipsoid or torus.
SurfaceSeed seed_shared_surface(const Shape& shape, const Sizing& sizing, const Sizing& sizing_of_reference,
                                const SharedRound& shared);

/// Edges of a circle about the axis of an ellipsoid or torus, at that angle of its meridian in the frame.
int rim_count(const Shape& shape, const Eigen::Affine3d& frame, const Sizing& sizing, double angle);
/// Edges of a cone's lower or upper rim.
int rim_count(const Cone& cone, const Sizing& sizing, bool end);

/// Covers a planar face, whose boundary is the loops of points of the seed, with triangles of about that
/// size.
void fill_planar_face(SurfaceSeed& seed, const Plane& plane,
                      const std::vector<std::vector<std::uint32_t>>& loops, std::uint32_t surface,
                      double size);

}  // namespace maille::modeler
