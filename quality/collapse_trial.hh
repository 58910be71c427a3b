#pragma once

#include <limits>
#include <optional>
#include <span>

#include "quality/objective.hh"
#include "quality/size_limit.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::quality {

/// What cells would be like if one of their vertices took another one's place, as it does when the edge
/// between them collapses.
class CollapseTrial {
  public:
    /// `cells` are those at `gone`. They, mesh and limit must outlive this.
    CollapseTrial(const volmesh::TetMesh& mesh, volmesh::VertexHandle gone,
                  std::span<const volmesh::CellHandle> cells, const SizeLimit& limit);

    /// Of the cells that stay.
    struct Outcome {
        double least_objective = std::numeric_limits<double>::infinity();
        double beta_sum = 0;
        std::size_t n_cells = 0;
    };
    /// Nothing where one has no objective above `floor`, a longer edge
    /// than there was, or comes farther beyond its size than any was.
    std::optional<Outcome> outcome(volmesh::VertexHandle heir, double floor) const;

  private:
    const volmesh::TetMesh& mesh_;
    volmesh::VertexHandle gone_;
    std::span<const volmesh::CellHandle> cells_;
    const SizeLimit& limit_;
    double longest_squared_ = 0, excess_ = 1;
};

}  // namespace maille::quality
