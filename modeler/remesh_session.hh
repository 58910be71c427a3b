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
};

}  // namespace maille::modeler::remeshing
