#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace maille::volmesh {

/// How a mesh asks its model for the nearest point on the true geometry.
///
/// A surface is known by its number, its place in `surfaces`; the name there is the name of the face set
/// whose members lie on it. Several face sets may lie on one surface, as a boundary and an inner interface
/// do; and several surfaces may bear one name, their faces being in one set: face_surfaces.hh tells them
/// apart.
struct Projector {
    /// Name of the face set of each surface, by surface number.
    std::vector<std::string> surfaces;

    /// The point nearest to `p` that lies on all the surfaces given (one: a face, two: a curve, three or
    /// more: a corner); nothing where they have no common point near `p`. Thread-safe.
    std::function<std::optional<Eigen::Vector3d>(std::span<const std::uint32_t> surfaces,
                                                 const Eigen::Vector3d& p)>
        project;

    /// Size of the model: the diagonal of its bounding box.
    double model_size = 0;

    /// The largest curvature (one over a radius) of a surface at its point nearest to `p`, 0 where it is
    /// flat. Thread-safe. May be missing.
    std::function<double(std::uint32_t surface, const Eigen::Vector3d& p)> curvature{};
};

}  // namespace maille::volmesh
