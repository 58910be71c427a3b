#pragma once

namespace maille::modeler::tetgen {

/// Exit status of the worker where TetGen throws its error number n: this plus n.
inline constexpr int tetgen_error_status = 100;

}  // namespace maille::modeler::tetgen
