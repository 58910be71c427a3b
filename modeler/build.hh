#pragma once

#include "modeler/build_report.hh"
#include "modeler/model.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::modeler {

/// How to build.
struct BuildOptions {
    /// Wanted edge length of primitives that have none of their own; 0: a twentieth of the model's diagonal.
    double size = 0;
    /// Greatest distance of a primitive's first triangles from its true surface; 0: no limit but eight edges
    /// to a circle.
    double chord_tolerance = 0;
    /// How many primitives are meshed at once. The mesh does not depend on it.
    unsigned threads = 1;
    /// Whether cells far from other primitives stay as the primitive's own mesh has them; else all are meshed
    /// together.
    bool keep_cells = true;
    /// Seconds of processor time that one run of TetGen may take; 0: by the expected number of cells.
    double time_limit = 0;
};

/// The tetrahedral mesh of a model: conforming, verified. Each place belongs to the primitive that `owner`
/// tells.
///
/// Cell sets: one for each primitive that owns cells, by its name, and one for each material. Face sets:
/// boundary faces are in `<primitive>/<face>`, the surface that they lie on; faces between two primitives'
/// cells are in the same with `inner_suffix`. Vertices on the boundary and on interfaces lie on all the true
/// surfaces of their faces, but for those that `BuildReport::projection` names; faces are flat.
///
/// Throws InputError where the model is empty or cannot be meshed, telling why and where.
volmesh::TetMesh build(const Model& model, const BuildOptions& options = {}, BuildReport* report = nullptr);

}  // namespace maille::modeler
