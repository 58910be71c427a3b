#pragma once

#include <cstddef>

#include "volmesh/projector.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::quality {

struct ImproveOptions {
    int max_passes = 20;
    /// Vertices whose worst cell has at least this gamma stay where they are.
    double good_enough = 0.5;
};

struct ImproveResult {
    int passes = 0;
    std::size_t moves = 0;
    double worst_before = 0, worst_after = 0;  ///< least gamma of the mesh
};

/// Moves vertices so that the worst cells round them get better.
///
/// A vertex goes to where the least gamma of its cells is greatest nearby (steepest ascent of that minimum,
/// as in L. Freitag, C. Ollivier-Gooch, "Tetrahedral mesh improvement using swapping and smoothing", IJNME
/// 40, 1997). No move lowers the least gamma or the least sigma of the cells at the vertex, so neither of the
/// mesh's goes down, and an inverted cell may come right but none arises.
///
/// Interior vertices move freely. Those on the boundary, on faces of a face set or between cells of different
/// sets move only along their geometric support, the surfaces that their faces' sets name, where `projector`
/// knows these surfaces; without one they stay. So do vertices in a vertex set, on an edge of an edge set,
/// and where two different parts of one surface meet. Connectivity, sets and properties don't change. The
/// result depends on the mesh alone.
///
/// Whatever the projector throws passes through; the mesh is then valid and partly improved.
ImproveResult improve(volmesh::TetMesh& mesh, const ImproveOptions& options = {},
                      const volmesh::Projector* projector = nullptr);

}  // namespace maille::quality
