#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "quality/projection_result.hh"
#include "refine/lineage.hh"
#include "refine/marking.hh"
#include "refine/size_field.hh"
#include "volmesh/projector.hh"
#include "volmesh/tet_mesh.hh"

/// Refinement of tetrahedral meshes after "3D mesh refinement procedure using the bisection and Rivara
/// algorithms with mesh quality assessment" ("the paper" in this folder).
namespace maille::refine {

/// What is done with an element that is to be refined.
enum class Method : std::uint8_t {
    rivara,    ///< every element is only ever bisected at its own longest edge (the paper, section 3.2)
    bisection  ///< an element's longest edge is split in all elements round it (section 3.1); it need not end
};

/// What has been done after a pass.
struct Progress {
    int iterations;       ///< passes until now
    std::size_t refined;  ///< elements that the pass had to refine
    std::uint32_t cells;  ///< that there are now
};

/// How to refine.
struct RefineOptions {
    Method method = Method::rivara;  ///< Rivara's ends and keeps shapes; the other one is for comparison
    /// Rivara's mesh does not depend on the order, but for the numbering: ties between edges are broken by a
    /// total order, which makes the closure of a pass unique. Plain bisection's does.
    Order order = Order::none;
    Ties ties = Ties::order;  ///< which of an element's longest edges is split
    double ratio =
        1.5;  ///< an element is refined while its longest edge is longer than this times the size wanted
    /// Lets the size grow by no more than this for each unit of length (`limit_growth`); 0: however it does.
    double gradation = 0;
    int max_iterations = 100;                 ///< passes
    std::uint32_t max_cells = 1'000'000'000;  ///< no pass begins with more
    bool project = true;                      ///< where a projector is given
    /// Lets new nodes inside the mesh move towards the centroid of the polyhedron round them where that
    /// betters the worst element. Nodes on an interface or in a set keep their places, and so does what was
    /// interpolated for them.
    bool smooth = false;
    /// No move onto a surface leaves an element with less shape (gamma) than this, unless one round the node
    /// had less before. Moves that leave less than 0.05 are the last resort.
    double min_shape = 0.0005;
    int threads = 0;  ///< 0: as many as the machine has; the result does not depend on it
    std::function<void(const Progress&)> progress{};  ///< called after each pass
};

/// Of the wall clock, by phase.
struct Seconds {
    double mark = 0;     ///< finding what is to be refined, and asking the size
    double split = 0;    ///< splitting edges, with all that passes on
    double project = 0;  ///< moving vertices onto the true surfaces
    double smooth = 0;   ///< moving new nodes inside the mesh
};

/// What refining has done.
struct RefineResult {
    int iterations = 0;  ///< passes that had an element to refine
    bool ended =
        true;  ///< false where elements are left to refine: a cap was hit, or they are too flat to be split
    std::uint32_t cells = 0;               ///< that there are now
    std::uint32_t vertices = 0;            ///< that there are now
    Lineage lineage;                       ///< where they come from
    quality::ProjectionResult projection;  ///< empty without a projector
    Seconds seconds;                       ///< that it took
};

/// Refines the mesh, in passes, until no element's longest edge is longer than `ratio` times the size at its
/// centroid.
///
/// The mesh conforms after every split; sets and properties pass on by their rules. With a projector,
/// vertices are moved onto the surfaces of their faces' sets after each pass, and no element is ever
/// inverted. Throws InputError where the size is not positive and finite or too small for doubles: the mesh
/// is then refined in part, and valid. Precondition: valid options, a mesh without deleted cells or vertices,
/// and if `ratio` is much below 1.5 the elements will be that much smaller than wanted.
RefineResult refine(volmesh::TetMesh& mesh, const SizeField& size, const RefineOptions& options = {},
                    const volmesh::Projector* projector = nullptr);

}  // namespace maille::refine
