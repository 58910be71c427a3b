#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "quality/improve.hh"
#include "quality/objective.hh"
#include "quality/size_limit.hh"
#include "quality/smooth.hh"
#include "quality/support.hh"
#include "quality/surface_error.hh"
#include "volmesh/edge_removal.hh"

namespace maille::quality {

/// A mesh under improvement: the moves that better a bad cell, each applied only if the least objective of
/// the cells that it changes goes up.
class Improver {
  public:
    /// `shapes` are those of all cells. What is done is added to `result`.
    Improver(volmesh::TetMesh& mesh, std::vector<Shape> shapes, const ImproveOptions& options,
             const volmesh::Projector* projector, ImproveResult& result);

    /// Tries all cells that are not good enough and near which something has changed since they were last
    /// tried so, the worst first, and no more than `most_tries`. Vertices are added and taken out only with
    /// `all_moves`.
    struct Pass {
        std::size_t tries, edits;
    };
    Pass pass(bool all_moves, std::size_t most_tries);
    /// Raises the mean of beta by sweeps over the mesh.
    void raise_mean();

    /// Of the mesh: the mean of beta, and the least objective.
    double mean_beta() const;
    double worst() const;

  private:
    using CellHandle = volmesh::CellHandle;
    using CellList = volmesh::CellList;
    using HalffaceHandle = volmesh::HalffaceHandle;
    using VertexHandle = volmesh::VertexHandle;

    // improver.cc
    bool improve_cell(CellHandle c, bool all_moves);
    double quality(const CellList& cells) const;
    const Freedom& freedom(VertexHandle v, const CellList& cells);
    Bases bases_at(VertexHandle v, const CellList& cells) const;
    /// Notes the new shapes of cells that have changed and of those from first_new on.
    void settle(const CellList& changed, std::uint32_t first_new);
    void note_shape(CellHandle c, const Shape& shape);
    /// The greatest excess over the size.
    double excess(const CellList& cells) const;

    // improver_smooth.cc
    bool smooth(VertexHandle v);
    IsAllowed allowed_places(VertexHandle v, const CellList& cells, const Bases& bases,
                             const Freedom& freedom);

    // improver_mean.cc
    std::size_t slide_for_mean(const std::vector<std::uint8_t>& is_free);

    // improver_flips.cc
    struct EdgeRemoval {
        volmesh::EdgeRing ring;
        std::vector<volmesh::RingTriangle> triangles;
        double quality;
    };
    struct FaceRemoval {
        std::vector<HalffaceHandle> faces;
        double quality;
    };
    bool flip(CellHandle c);
    std::optional<EdgeRemoval> edge_removal(CellHandle c, int edge, double floor);
    std::optional<FaceRemoval> face_removal(CellHandle c, int face, double floor);
    double removal_tolerance(const EdgeRemoval& removal);
    bool keeps_size(const EdgeRemoval& removal) const;

    // improver_vertices.cc
    struct Collapse {
        VertexHandle gone, heir;
        double quality;
    };
    bool collapse(CellHandle c);
    std::optional<Collapse> collapse_of(VertexHandle gone, VertexHandle heir, double floor);
    bool split(CellHandle c);
    bool split(CellHandle c, int edge);

    volmesh::TetMesh& mesh_;
    const ImproveOptions& options_;
    SizeLimit limit_;
    const volmesh::Projector* projector_;
    volmesh::FaceSurfaces surfaces_of_;
    Freedoms freedoms_;
    /// Place in known_freedoms_ by vertex; 0: not known yet, 1: free.
    std::vector<std::uint32_t> freedom_at_;
    std::deque<Freedom> known_freedoms_;
    std::vector<Shape> shapes_;  ///< of each cell; perfect where it is deleted
    std::array<std::vector<std::uint32_t>, 2>
        tried_;                           ///< when each cell was last tried: by any moves, and by all of them
    std::vector<std::uint32_t> changed_;  ///< when a cell at each vertex last changed
    std::vector<std::uint32_t> smoothed_;  ///< when no better place was found for each vertex
    std::uint32_t now_ = 1;
    ImproveResult& result_;
};

}  // namespace maille::quality
