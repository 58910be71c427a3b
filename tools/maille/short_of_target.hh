#pragma once

#include "quality/projection_result.hh"
#include "tools/maille/progress.hh"

namespace maille::tools {

/// Says on stderr which vertices are not on all their surfaces, if there are any.
void warn_of_short(const quality::ProjectionResult& projection, Progress& progress);

}  // namespace maille::tools
