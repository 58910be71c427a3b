#include "modeler/merge_interface.hh"

namespace maille::modeler {

using Eigen::Vector3d;

InterfaceTable::InterfaceTable(const FacetComplex& interface) {
    points_.reserve(interface.points.size());
    for (std::uint32_t v = 0; v < interface.points.size(); ++v) points_.insert(interface.points[v], v);
    facets_.reserve(interface.facets.size());
    for (std::uint32_t f = 0; f < interface.facets.size(); ++f)
        facets_.emplace(sorted(interface.facets[f].vertices), f);
}

std::optional<std::uint32_t> InterfaceTable::facet(const Triple& corners) const {
    const auto found = facets_.find(sorted(corners));
    return found == facets_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::uint32_t> InterfaceTable::facet(const std::array<Vector3d, 3>& triangle) const {
    Triple corners{};
    for (int k = 0; k < 3; ++k) {
        const auto found = vertex(triangle[k]);
        if (!found) return std::nullopt;
        corners[k] = *found;
    }
    return facet(corners);
}

std::array<Vector3d, 3> face_points(const volmesh::TetMesh& mesh, volmesh::HalffaceHandle face) {
    const auto [a, b, c] = mesh.halfface_vertices(face);
    return {mesh.point(a), mesh.point(b), mesh.point(c)};
}

std::array<Vector3d, 3> facet_points(const FacetComplex& complex, std::uint32_t facet) {
    const auto& [a, b, c] = complex.facets[facet].vertices;
    return {complex.points[a], complex.points[b], complex.points[c]};
}

}  // namespace maille::modeler
