#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "modeler/arrange_scene.hh"

namespace maille::modeler::detail {

/// Facets of one primitive that hang together in one plane and lie on one smooth surface.
struct Patch {
    Eigen::Vector3d normal;
    std::vector<std::uint32_t> facets;  ///< rising
};

/// A straight line of edges between two patches of one primitive.
struct Chain {
    std::vector<std::uint32_t> points;  ///< from end to end
};

/// A scene with its planar faces in as few triangles as their outlines allow, and what they were cut into
/// before.
struct CoarseScene {
    Scene scene;                              ///< the same points; not all are used
    std::vector<Patch> patches;               ///< of facets of the scene before
    std::vector<std::uint32_t> patch_of;      ///< of each facet of the scene before
    std::vector<Chain> chains;                ///< those of more than one edge, now one edge each
    std::vector<std::uint32_t> inner_points;  ///< inside patches, now left out
};

/// Arranging costs by the number of facets that meet, and a planar face needs no more of them than its
/// outline tells. Points within `tolerance` of a plane or a line count as on it.
CoarseScene coarsen(const Scene& scene, double tolerance);

}  // namespace maille::modeler::detail
