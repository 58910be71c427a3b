#pragma once

#include <span>
#include <vector>

#include "quality/boundary_supports.hh"
#include "quality/projection_result.hh"
#include "volmesh/projector.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::quality {

/// An edge, by a cell and its local number there.
struct CellEdge {
    volmesh::CellHandle cell;
    int edge;
};

/// How far the vertex is from its surfaces, and what these are.
ShortOfTarget short_of_target(const volmesh::TetMesh& mesh, const volmesh::Projector& projector,
                              const VertexSupport& support);

/// Throws InputError where this is no least shape that a move may leave: it must be above 0 and at most 1.
void require_min_shape(double min_shape);

/// Moves vertices onto the true surfaces that they lie on, without ever inverting a cell or, to get there,
/// making one worse than the shape allowed.
///
/// A vertex that cannot go all the way goes as far as it can, the vertices inside the mesh round it make
/// room, and it tries again each time.
class BoundaryProjection {
  public:
    /// `min_shape`: the least shape (gamma) that a move may leave in a cell, unless one round the vertex had
    /// less before; as long as there is another way, none leaves less than 0.05.
    BoundaryProjection(volmesh::TetMesh& mesh, const volmesh::Projector& projector, double min_shape);

    /// From now on the first so many vertices of the mesh make no room for others: they stay.
    void hold(std::uint32_t n_vertices) { n_held_ = n_vertices; }

    /// Takes up the vertices from `first` on, with the surfaces that their faces' sets name; the cells given
    /// are all that have one of them, or more.
    void take_up(std::uint32_t first, std::span<const volmesh::CellHandle> cells);
    /// Takes up vertices of which the surfaces are known.
    void take_up(std::span<const VertexSupport> supports);

    /// Moves the vertices that are not on their surfaces yet. Returns the cells whose points have moved,
    /// ascending.
    std::vector<volmesh::CellHandle> run();
    /// The same with all patience: shapes down to the least allowed are accepted at last.
    std::vector<volmesh::CellHandle> insist();

    bool is_done() const { return waiting_.empty(); }
    /// Number of vertices that are not on all their surfaces.
    std::size_t n_waiting() const { return waiting_.size(); }
    /// Number of vertices that have been moved towards their surfaces.
    std::size_t n_moved() const { return n_moved_; }
    /// Those vertices, ascending.
    std::vector<ShortOfTarget> short_of_target() const;
    /// Edges whose split gives those vertices more room, one for each cell in their way: inside the mesh
    /// between two vertices of its boundary, which can't make room, if there is such an edge, or else the
    /// cell's longest.
    std::vector<CellEdge> blocking_edges() const;

  private:
    struct Waiting : VertexSupport {
        volmesh::Point target;
        bool has_target = false;
        bool has_moved = false;
    };

    void find_targets();
    bool sweep(double least_shape);
    bool approach(Waiting& waiting, double least_shape);
    bool make_room(const Waiting& waiting);
    void move(volmesh::VertexHandle v, const volmesh::Point& to);
    std::vector<volmesh::CellHandle> take_changed();

    volmesh::TetMesh& mesh_;
    const volmesh::Projector& projector_;
    volmesh::FaceSurfaces surfaces_of_;
    double min_shape_, good_shape_;
    double tolerance_;  ///< how near is on the surface
    std::vector<Waiting> waiting_;
    std::vector<volmesh::CellHandle> changed_;
    std::size_t n_moved_ = 0;
    std::uint32_t n_held_ = 0;
};

}  // namespace maille::quality
