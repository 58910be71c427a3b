#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include <Eigen/Core>

#include "modeler/facet_complex.hh"
#include "modeler/point_index.hh"
#include "modeler/triple.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::modeler {

/// The facets of an interface, to be found by the points of a triangle.
class InterfaceTable {
  public:
    explicit InterfaceTable(const FacetComplex& interface);
    /// The interface's point at the place.
    std::optional<std::uint32_t> vertex(const Eigen::Vector3d& place) const { return points_.find(place); }
    /// The facet with these of the interface's points for corners, whichever way it turns.
    std::optional<std::uint32_t> facet(const Triple& corners) const;
    std::optional<std::uint32_t> facet(const std::array<Eigen::Vector3d, 3>& triangle) const;

  private:
    PointIndex points_;
    std::unordered_map<Triple, std::uint32_t, TripleHash> facets_;
};

/// Where a face's vertices are, counter-clockwise seen from outside its cell.
std::array<Eigen::Vector3d, 3> face_points(const volmesh::TetMesh& mesh, volmesh::HalffaceHandle face);

/// Where a facet's vertices are.
std::array<Eigen::Vector3d, 3> facet_points(const FacetComplex& complex, std::uint32_t facet);

}  // namespace maille::modeler
