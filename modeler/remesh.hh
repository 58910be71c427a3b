#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include <Eigen/Core>

#include "modeler/facet_complex.hh"

namespace maille::modeler {

/// The model as the surface remesher asks for it. Every function must be pure.
struct RemeshGeometry {
    /// The point near `p` that lies on all the smooth surfaces given (one: a face, two: a curve, three or
    /// more: a corner), or nothing where they have no common point near `p`.
    std::function<std::optional<Eigen::Vector3d>(std::span<const std::uint32_t> surfaces,
                                                 const Eigen::Vector3d& p)>
        project;
    /// A point near `p` where two of the surfaces touch, or nothing. Their curves can only meet there.
    std::function<std::optional<Eigen::Vector3d>(std::uint32_t a, std::uint32_t b, const Eigen::Vector3d& p)>
        touch = [](std::uint32_t, std::uint32_t, const Eigen::Vector3d&) { return std::nullopt; };
    /// Unit normal of the surface at its point nearest to `p`. Which way it points must not change along the
    /// surface; a facet's own normal may be opposite.
    std::function<Eigen::Vector3d(std::uint32_t surface, const Eigen::Vector3d& p)> normal;
    std::function<bool(std::uint32_t surface)> planar;
    /// The wanted edge length at `p` of facets between the two regions. Positive.
    std::function<double(const Eigen::Vector3d& p, Region front, Region back)> size;
};

struct RemeshOptions {
    int rounds = 10;            ///< at most so many rounds of collapse, split, flip and smoothing
    double min_angle = 30;      ///< degrees: facets with a smaller angle are worked at
    double smallest_gap = 0.2;  ///< thin sheets make the size smaller, down to so many times the wanted one
    /// Thin sheets make the size smaller only as far as there come to be about so many times the facets that
    /// there were and those that the wanted size makes, together.
    double most_growth = 1;
};

/// What the remesher did. Angles are in degrees, over the facets that are not frozen.
struct RemeshReport {
    std::size_t collapses = 0;
    std::size_t flips = 0;
    std::size_t splits = 0;
    std::size_t snaps = 0;             ///< vertices drawn onto a curve that ran too close by them
    std::size_t smoothings = 0;        ///< moves along the surface
    std::size_t projections = 0;       ///< moves onto the surface
    std::size_t clearings = 0;         ///< the same, with neighbours that were in the way, or without
    std::size_t short_of_surface = 0;  ///< vertices that could not be moved onto all their surfaces
    double smallest_angle_before = 0;
    double smallest_angle_after = 0;
    /// The result intersected itself where the input did not: the complex was left as it was.
    bool rolled_back = false;
};

/// Gives the facets good shapes and the wanted size and moves their vertices onto the true surfaces, keeping
/// the topology: every region, the surface of every facet, the curves where the surface or the pair of
/// regions changes or other than two facets meet, and the corners where such curves end, branch or turn
/// sharply.
///
/// Frozen facets, their vertices and their edges stay bit by bit; no facet ever comes to intersect another,
/// so that a complex free of self-intersections stays so. Vertices that nothing uses any more are dropped;
/// those that stay keep their order, new ones follow. The facets keep their front and back, but not their
/// places or number.
///
/// Precondition: facets name existing vertices, three different ones each; no vertex lies twice in the
/// points.
RemeshReport remesh(FacetComplex& complex, const RemeshGeometry& geometry, const RemeshOptions& options = {});

}  // namespace maille::modeler
