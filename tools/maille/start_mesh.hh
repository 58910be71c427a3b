#pragma once

#include <optional>

#include "modeler/model.hh"
#include "refine/size_field.hh"
#include "tools/maille/progress.hh"
#include "tools/maille/summary.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::tools {

inline constexpr const char* start_size_help =
    "Size of the start mesh, where the model gives none: a length, an expression of x, y, z and r (the "
    "distance from "
    "the origin), or FILE:FIELD; a twentieth of the model's diagonal if not given";

/// Meshes the model. Where the size varies, the mesh is made at the largest size and then refined.
volmesh::TetMesh start_mesh(const modeler::Model& model, const std::optional<refine::SizeField>& size,
                            int threads, Progress& progress, Summary& summary);

}  // namespace maille::tools
