#pragma once

#include "modeler/tetgen_protocol.hh"

namespace maille::modeler::tetgen {

/// Has TetGen told, in its next run in this process, which region each part of the space is in, as soon as it
/// has recovered the request's facets: that takes a place well within each part, which nobody knows before.
/// The request must outlive the run.
void tell_regions(const Request& request);

/// Whether TetGen has been told.
bool have_told_regions();

}  // namespace maille::modeler::tetgen
