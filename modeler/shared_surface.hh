#pragma once

#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "modeler/primitive.hh"
#include "modeler/shape_cone.hh"

namespace maille::modeler {

/// A row of points around a cone.
struct ConeRim {
    double height;  ///< in the reference's coordinates
    int count;      ///< of edges, a multiple of 4
};

/// The side of cylinders or cones that lie on one another: cut into bands between all their ends, of rows
/// that begin on one generator. Each takes the bands that it covers, so that all have the same triangles.
struct SharedCone {
    Cone reference;             ///< tells coordinates; its x axis points to the first generator
    std::vector<ConeRim> rims;  ///< rising
    bool is_straight = false;   ///< all rows begin on that generator; else every other one half a step on
};

/// Equal spheres, and spheres that touch cylinders of the same radius along great circles: cut along the
/// three great circles that are normal to the axes, each of which has `count` edges, a multiple of 4.
struct SharedSphere {
    Eigen::Matrix3d axes;  ///< orthonormal, in columns
    int count;
};

/// A circle about the axis of a surface of revolution.
struct RoundRim {
    double angle;  ///< of the surface's meridian in the reference's coordinates
    int count;     ///< of edges, a multiple of 4
};

/// An ellipsoid or torus that touches others along circles about one axis, or has their rims on it: cut into
/// rows about that axis, some of which are these circles. It is a surface of revolution in the coordinates of
/// the reference.
struct SharedRound {
    Cone reference;              ///< tells coordinates; its x axis points to the first point of each circle
    std::vector<RoundRim> rims;  ///< rising in angle; at least one
};

struct SharedSurface {
    std::variant<SharedCone, SharedSphere, SharedRound> cut;
};

/// Finds the round surfaces that have to be cut with regard to others: cones, cylinders and spheres on which
/// several primitives lie get the same triangles; surfaces of revolution on one axis (ellipsoids, cylinders,
/// cones and tori, or images of such under one affine map) that touch along a circle, or on which another's
/// rim lies, the same points on it; so do cones that end in one circle; cylinders that touch planes or
/// cylinders along a line, or on which a straight edge lies, get an edge there. By primitive; null where
/// there is no other. Primitives that share a surface, or a circle of an ellipsoid or torus, get one size,
/// the smallest of theirs.
std::vector<std::shared_ptr<const SharedSurface>> find_shared_surfaces(std::span<const Primitive> primitives,
                                                                       std::span<double> sizes,
                                                                       double chord_tolerance);

}  // namespace maille::modeler
