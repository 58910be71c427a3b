#pragma once

#include <optional>
#include <vector>

#include "quality/measures.hh"
#include "volmesh/face_surfaces.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::quality {

using volmesh::Surfaces;

/// Where a vertex may go without a change to the geometry, the sets or the materials of the mesh: anywhere,
/// on surfaces of the projector, on one or two planes (where its faces lie on no known surface but are flat),
/// or nowhere.
struct Freedom {
    bool is_fixed = false;
    Surfaces surfaces{};
    boost::container::small_vector<Point, 2> normals{};  ///< of the planes

    bool is_free() const { return !is_fixed && surfaces.empty() && normals.empty(); }
};

/// The freedoms of a mesh's vertices. Mesh and projector must outlive it; the mesh may be edited, but for new
/// sets.
class Freedoms {
  public:
    Freedoms(const volmesh::TetMesh& mesh, const volmesh::Projector* projector)
        : mesh_(mesh), surfaces_of_(mesh, projector) {}

    /// `cells` are the cells at v. Cost: one pass over them, some look-ups for each face on a surface.
    Freedom operator()(volmesh::VertexHandle v, const volmesh::CellList& cells);

  private:
    const volmesh::TetMesh& mesh_;
    volmesh::FaceSurfaces surfaces_of_;
};

/// By vertex, 1 where it may go anywhere: where it is on no interface and in no set, nor on an edge that is
/// in one; as `Freedoms` tells of one vertex. Cost: one pass over the mesh, by many threads.
std::vector<std::uint8_t> free_vertices(const volmesh::TetMesh& mesh);

/// What binds a vertex at its present place.
class Constraint {
  public:
    Constraint(const Freedom& freedom, const Point& at, const volmesh::Projector* projector)
        : freedom_(freedom), at_(at), projector_(projector) {}

    /// The place nearest to p that the vertex may have; nothing where the projector finds none.
    std::optional<Point> nearest(const Point& p) const;

    /// Takes gradients at the present place into the tangent space. Nothing where the vertex isn't where it
    /// should be, or the surfaces have no tangent there. `reach` is a length to feel the surfaces out.
    std::optional<Eigen::Matrix3d> tangent(double reach) const;

  private:
    Eigen::Matrix3d onto_planes() const;

    const Freedom& freedom_;
    Point at_;
    const volmesh::Projector* projector_;
};

}  // namespace maille::quality
