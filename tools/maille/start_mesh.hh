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

/// What start meshes are made of and how.
struct StartMeshOptions {
    std::optional<refine::SizeField> size{};
    bool improve = true;
    int threads = 0;  ///< 0: as many as the machine has
};

/// Meshes the model. Where the size varies, the mesh is made at the largest size and then refined.
volmesh::TetMesh start_mesh(const modeler::Model& model, const volmesh::Projector& projector,
                            const StartMeshOptions& options, Progress& progress, Summary& summary);

}  // namespace maille::tools
