#pragma once

#include "modeler/remesh.hh"
#include "modeler/remesh_net.hh"

namespace maille::modeler::remeshing {

/// What all operations work at.
struct Session {
    Net net;
    const RemeshGeometry& geometry;
    const RemeshOptions& options;
    RemeshReport report{};
    double good = 0.5;  ///< sine of the smallest angle that is good enough
    /// Sine of the smallest angle that may be left where a short edge goes. It is small at first, while flips
    /// and smoothing can still make up for it.
    double tolerated = 0.5;

    // When each pass began last: what has not been touched since need not be looked at again.
    std::uint64_t collapsed = 0;
    std::uint64_t flipped = 0;
    std::uint64_t snapped = 0;
    std::uint64_t smoothed = 0;

    std::vector<double> wanted_sizes{};  ///< by vertex, of the geometry; where `gap_sizes` are known
    std::vector<double> gap_sizes{};  ///< by vertex, as sheets and curves near it want them; 0: not known yet
    std::uint64_t sized = 0;          ///< when they were found
    double smallest_gap = options.smallest_gap;
};

}  // namespace maille::modeler::remeshing
