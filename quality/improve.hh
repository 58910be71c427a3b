#pragma once

#include <cstddef>
#include <functional>

#include "quality/report.hh"
#include "volmesh/projector.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::quality {

/// How far to go.
struct ImproveOptions {
    int max_passes = 12;  ///< over the worst cells
    ///@{
    /// The passes try so many cells at most, and for each cell of the mesh so many more; one pass tries a
    /// quarter of that, the worst first. Only meshes that are bad all over reach it, where more tries gain
    /// little.
    std::size_t base_tries = 40'000;
    double tries_per_cell = 0.75;
    ///@}
    /// Cells whose objective (objective.hh) is at least this are left as they are; .5 stands for angles of 30
    /// and 125 degrees and beta = .58.
    double good_enough = 0.5;
    /// Whether connectivity may change: by flips, removal of edges and faces, edge collapse and edge split.
    bool may_change_cells = true;
    /// Most sweeps to raise the mean of beta: each removes and collapses edges inside the mesh where the mean
    /// is below `good_mean`, and then moves vertices. They end when it is no longer, or gains little.
    int mean_sweeps = 8;
    double good_mean = 0.8;  ///< mean of beta over the cells of an edge
    /// Wanted edge lengths; a move makes no cell longer than `ratio` times the size at its centroid, unless
    /// it takes the place of one that is as far beyond.
    const WantedSize* size = nullptr;
    double ratio = 1.5;  ///< as refinement has it
};

/// What bettering a mesh has done.
struct ImproveResult {
    int passes = 0;  ///< over the worst cells
    ///@{
    /// Edits that were kept, by kind.
    std::size_t moves = 0, edge_removals = 0, face_removals = 0, collapses = 0, splits = 0;
    ///@}
    ///@{
    /// Least objective of the mesh, before and after.
    double worst_before = 0, worst_after = 0;
    ///@}
    bool is_cut_short = false;  ///< by the limit of tries

    /// Number of all edits.
    std::size_t edits() const { return moves + edge_removals + face_removals + collapses + splits; }
};

/// Betters a mesh: raises the mean of beta by sweeps over all of it, if that is low (mean_flips.hh,
/// mean_collapses.hh, mean_moves.hh); then betters the worst cells: moves vertices, removes edges and faces,
/// collapses and splits edges, the worst cell first, until a pass finds nothing. After B. M. Klingner, J. R.
/// Shewchuk, "Aggressive tetrahedral mesh improvement", 2007.
///
/// No move lowers the least objective of the cells that it changes. So the mesh's least never goes down, and
/// an inverted cell may come right but none arises. Sets and properties pass on by their rules, the volume of
/// each cell set and the area of each flat face set stay. Vertices keep to their geometric support: the
/// surfaces that their faces' sets name, where `projector` knows these; else the planes of their faces, where
/// these are flat; else they stay. So do vertices in a vertex set, on an edge of an edge set, and where two
/// different parts of one surface meet. Faces and curves come no farther from the true surfaces, measured in
/// their middles.
///
/// Cells and vertices are renumbered if connectivity may change. The result depends on the mesh and the
/// options alone, not on the number of threads. Whatever the projector or the size throws passes through; the
/// mesh is then valid and partly improved.
ImproveResult improve(volmesh::TetMesh& mesh, const ImproveOptions& options = {},
                      const volmesh::Projector* projector = nullptr);

}  // namespace maille::quality
