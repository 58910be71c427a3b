#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "volmesh/tet_mesh.hh"

namespace maille::quality {

/// A vertex that could not be brought onto all its surfaces.
struct ShortOfTarget {
    volmesh::VertexHandle vertex;       ///< of the mesh as it is now
    volmesh::Point place;               ///< where it had to stay
    std::vector<std::string> surfaces;  ///< the names of all that it should lie on
    std::optional<double> distance;     ///< to go; nothing where the surfaces have no common point nearby
    double off = 0;                     ///< distance from that of the surfaces which is farthest
};

/// What bringing vertices onto the true surfaces has come to.
struct ProjectionResult {
    std::size_t moved = 0;                       ///< vertices, whether all the way or not
    std::vector<ShortOfTarget> short_of_target;  ///< by vertex, ascending
};

}  // namespace maille::quality
