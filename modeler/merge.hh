#pragma once

#include <span>

#include "modeler/build_report.hh"
#include "modeler/csg_tree.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::modeler {

/// How to merge.
struct MergeOptions {
    /// Wanted edge length of new cells; 0: the mean length of the edges on the surfaces that they fill.
    double size = 0;
    /// Whether cells far from the other meshes' surfaces stay; else all is meshed anew.
    bool keep_cells = true;
    /// Seconds of processor time that one run of TetGen may take; 0: by the expected number of cells.
    double time_limit = 0;
};

/// A boolean operation between meshes, without a model: one conforming, verified mesh. Leaf i of the tree is
/// mesh i.
///
/// Cells that no other mesh's surface touches are kept, with one layer less; the rest is meshed anew. Where
/// meshes overlap, the first one that `owner` names has the place. The cells of a mesh that are in the same
/// sets are one region and stay one: new cells are in the same sets as those that had their place. A face set
/// goes on to the faces that lie where its members did on the surface of a region. Boundary faces that come
/// to lie between two regions are in `<set>/inner` instead. Other face sets, edge sets and vertex sets keep
/// those of their members that belong to kept cells. Properties are not carried over. Surfaces count as the
/// planes that their triangles span.
///
/// Throws InputError where the result is empty, an input has no cells or meshing fails.
volmesh::TetMesh merge(std::span<const volmesh::TetMesh> meshes, const CsgTree& tree,
                       const MergeOptions& options = {}, BuildReport* report = nullptr);

}  // namespace maille::modeler
