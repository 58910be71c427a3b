#pragma once

#include <string>

#include <CLI/App.hpp>

#include "refine/refine.hh"
#include "refine/uniform.hh"
#include "tools/maille/progress.hh"

namespace maille::tools {

const std::string& method_name(refine::Method method);
const std::string& order_name(refine::Order order);

/// The options --method --order --ratio --gradation --max-iterations --min-shape --smooth.
void add_refine_options(CLI::App& command, refine::RefineOptions& options);

/// Refines, with the passes told to `progress`, and says so on stderr where it was stopped before its end.
refine::RefineResult refine_with_progress(volmesh::TetMesh& mesh, const refine::SizeField& size,
                                          refine::RefineOptions options, const volmesh::Projector* projector,
                                          Progress& progress);
/// The same for uniform refinement.
refine::RefineResult refine_uniformly_with_progress(volmesh::TetMesh& mesh, refine::UniformOptions options,
                                                    const volmesh::Projector* projector, Progress& progress);

}  // namespace maille::tools
