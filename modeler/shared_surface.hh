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

struct SharedSurface {
    std::variant<SharedCone, SharedSphere> cut;
};

/// Finds the round surfaces that have to be cut with regard to others: cones, cylinders and spheres on which
/// several primitives lie get the same triangles; spheres and cylinders that touch along a circle, and cones
/// that end in one circle, the same points on it; cylinders that touch planes or cylinders along a line, an
/// edge there. By primitive; null where there is no other. Primitives that share a surface, or a circle of a
/// sphere, get one size, the smallest of theirs.
std::vector<std::shared_ptr<const SharedSurface>> find_shared_surfaces(std::span<const Primitive> primitives,
                                                                       std::span<double> sizes,
                                                                       double chord_tolerance);

}  // namespace maille::modeler
