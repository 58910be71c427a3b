#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace maille::modeler {

/// A place, in the unit of length that the user chose.
using Point = Eigen::Vector3d;

/// A smooth surface that bounds a primitive. Several may bear one name: the facets of a `side` that stays
/// polyhedral, for example.
struct PrimitiveFace {
    std::string name;     ///< "x-", "side", "surface", "face3", ...
    bool planar = false;  ///< whether it lies in a plane
};

/// The shape of a primitive in space: immutable, any affine image of a standard solid. Thread-safe.
class Shape {
  public:
    virtual ~Shape() = default;

    /// All that bounds it; their places are the numbers below.
    virtual std::span<const PrimitiveFace> faces() const = 0;
    /// In space, as tight as is easily told.
    virtual Eigen::AlignedBox3d bounding_box() const = 0;

    /// Negative inside, zero on the boundary, positive outside; grows about as the distance does near the
    /// boundary.
    virtual double implicit(const Point& p) const = 0;

    /// The same for the one unbounded surface that carries the face: zero exactly on the surface.
    virtual double face_implicit(std::uint32_t face, const Point& p) const = 0;
    /// Unit normal of that surface at the point of it nearest to p, pointing out of the solid.
    virtual Point face_normal(std::uint32_t face, const Point& p) const = 0;
    /// The point nearest to p on the unbounded surface that carries the face.
    virtual Point project(std::uint32_t face, const Point& p) const = 0;
    /// How that normal turns along the surface, at the same point: the symmetric matrix dn/dx, whose
    /// eigenvalues are the principal curvatures (positive where the solid bulges) and, along the normal, 0.
    virtual Eigen::Matrix3d face_curvature(std::uint32_t face, const Point& p) const = 0;
    /// The largest curvature (one over a radius) of the face; 0 where it is planar. The apex of a cone does
    /// not count: there it is the curvature of the rim.
    virtual double max_curvature(std::uint32_t face) const = 0;

    /// Whether the point is inside or on the boundary.
    bool contains(const Point& p) const { return implicit(p) <= 0; }
};

/// A named solid of the model, a leaf of its tree. A cheap value: copies share the shape.
struct Primitive {
    std::shared_ptr<const Shape> shape;  ///< where it is and how it is bounded
    std::string name;                    ///< given, or "cube1", "sphere2", ...
    std::string material;                ///< empty where none was given
    double size = 0;                     ///< wanted edge length; 0 where none was given
    /// What the surfaces of its faces are called; "<name>/<face>" where none are given.
    std::vector<std::string> surface_names{};
    /// By surface number in the model: the face set of the boundary faces of its own cells that lie there,
    /// instead of the surface's name.
    std::map<std::uint32_t, std::string> boundary_names{};
};

}  // namespace maille::modeler
