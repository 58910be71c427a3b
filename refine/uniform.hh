#pragma once

#include "refine/refine.hh"

namespace maille::refine {

/// How to refine uniformly.
struct UniformOptions {
    int levels = 1;             ///< how often every element is cut into eight
    bool project = true;        ///< where a projector is given
    double min_shape = 0.0005;  ///< as in RefineOptions
    int threads = 0;            ///< 0: as many as the machine has; the result does not depend on it
    std::function<void(const Progress&)> progress{};  ///< called after each level
};

/// Cuts every element into eight of equal volume, level by level (`volmesh::TetMesh::split_uniformly`): the
/// sizes become a half, a quarter and so on, as a study of convergence asks for. Much faster than `refine`,
/// and shapes hardly suffer.
///
/// Sets and properties pass on by their rules. With a projector, vertices are moved onto the surfaces of
/// their faces' sets after each level, and no element is ever inverted. The result's `iterations` are the
/// levels. Throws InputError where the mesh has deleted entities, the options are not valid or the mesh gets
/// too large.
RefineResult refine_uniformly(volmesh::TetMesh& mesh, const UniformOptions& options = {},
                              const volmesh::Projector* projector = nullptr);

}  // namespace maille::refine
