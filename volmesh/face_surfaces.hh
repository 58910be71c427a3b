#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <boost/container/small_vector.hpp>

#include "volmesh/projector.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// Numbers of a projector's surfaces, ascending: one for what lies on a face, two for a curve, three or more
/// for a corner.
using Surfaces = boost::container::small_vector<std::uint32_t, 4>;

/// Unites them.
void add(Surfaces& to, const Surfaces& more);

/// Which of a projector's surfaces the faces of a mesh lie on: those that bear the names of the face's sets.
///
/// Where several surfaces bear one name (two holes called "hole"), it is the one that the face's corners and
/// centroid are nearest to. Nothing is stored in the mesh: the face sets, which refinement keeps true, and
/// the points say it all.
class FaceSurfaces {
  public:
    /// Without a projector no face lies on any surface. Mesh and projector must outlive this; the mesh may be
    /// edited, but for new sets.
    FaceSurfaces(const TetMesh& mesh, const Projector* projector);

    /// Whatever the projector throws passes through. Cost: a look-up; where surfaces share a name, a few
    /// projections, but as many as there are such surfaces for a face on none that was met at its vertices.
    Surfaces operator()(HalffaceHandle hf);

  private:
    /// The surfaces of one name.
    using Namesakes = std::vector<std::uint32_t>;

    const std::vector<SetHandle>& sets_with_surfaces(CombinationId id);
    std::uint32_t surface_among(const Namesakes& surfaces, HalffaceHandle hf);
    std::uint32_t nearest(const Namesakes& surfaces, const std::array<Point, 3>& corners) const;
    bool lies_on(std::uint32_t surface, const std::array<Point, 3>& corners) const;

    const TetMesh& mesh_;
    const Projector* projector_;
    std::vector<Namesakes> of_set_;
    std::vector<std::optional<std::vector<SetHandle>>> of_combination_;  ///< filled as they are met
    /// Those found for faces at each vertex: where hundreds share a name, the next face is mostly on one of
    /// them too.
    std::vector<Surfaces> met_;
};

}  // namespace maille::volmesh
