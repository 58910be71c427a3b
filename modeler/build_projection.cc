#include "modeler/build_projection.hh"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "modeler/arrange_self_intersection.hh"
#include "quality/boundary_projection.hh"

namespace maille::modeler {
namespace {

using quality::VertexSupport;
using volmesh::HalffaceHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

/// No move leaves a cell of less shape (gamma) than that.
constexpr double least_shape = 0.0005;

std::vector<VertexSupport> supports_of_new_vertices(const Merged& merged) {
    const auto first = merged.kept_vertices.size();
    std::vector<volmesh::Surfaces> surfaces(merged.mesh.n_vertices() - first);
    for (const InterfaceFace& face : merged.faces)
        for (const VertexHandle v : merged.mesh.halfface_vertices(face.face))
            if (v.idx() >= first) volmesh::add(surfaces[v.idx() - first], {face.surface});
    std::vector<VertexSupport> supports;
    for (std::uint32_t i = 0; i < surfaces.size(); ++i)
        if (!surfaces[i].empty()) supports.push_back({VertexHandle(first + i), std::move(surfaces[i])});
    return supports;
}

/// By vertex, 1 where the boundary crosses itself at one of its faces.
std::vector<std::uint8_t> vertices_of_crossing_faces(const TetMesh& mesh) {
    FacetComplex boundary;
    std::vector<VertexHandle> vertices;
    std::vector<std::uint32_t> numbers(mesh.n_vertices(), TetMesh::none);
    for (const HalffaceHandle hf : mesh.boundary_halffaces()) {
        Facet& facet = boundary.facets.emplace_back();
        for (int k = 0; const VertexHandle v : mesh.halfface_vertices(hf)) {
            std::uint32_t& number = numbers[v.idx()];
            if (number == TetMesh::none) {
                number = static_cast<std::uint32_t>(vertices.size());
                vertices.push_back(v);
                boundary.points.push_back(mesh.point(v));
            }
            facet.vertices[k++] = number;
        }
    }
    std::vector<std::uint8_t> marks(mesh.n_vertices());
    for (const auto& [first, second] : find_self_intersections(boundary))
        for (const std::uint32_t facet : {first, second})
            for (const std::uint32_t v : boundary.facets[facet].vertices) marks[vertices[v].idx()] = 1;
    return marks;
}

/// Moves them as far as they can go.
quality::ProjectionResult project(TetMesh& mesh, const volmesh::Projector& projector,
                                  std::span<const VertexSupport> supports, std::uint32_t n_kept_vertices) {
    quality::BoundaryProjection projection(mesh, projector, least_shape);
    projection.hold(n_kept_vertices);
    projection.take_up(supports);
    projection.run();
    if (!projection.is_done()) projection.insist();
    return {projection.n_moved(), projection.short_of_target()};
}

}  // namespace

quality::ProjectionResult project_new_vertices(Merged& merged, const volmesh::Projector& projector) {
    TetMesh& mesh = merged.mesh;
    const auto n_kept = merged.kept_vertices.size();
    const std::vector<volmesh::Point> before(mesh.points().begin(), mesh.points().end());
    std::vector<VertexSupport> supports = supports_of_new_vertices(merged), left;
    quality::ProjectionResult result;
    while (true) {
        result = project(mesh, projector, supports, n_kept);
        if (result.moved == 0) break;
        // Cells are never inverted, but what is empty between two walls has none.
        const std::vector<std::uint8_t> crosses = vertices_of_crossing_faces(mesh);
        const auto stays = std::ranges::stable_partition(supports, [&](const VertexSupport& support) {
            return !crosses[support.vertex.idx()] ||
                   mesh.point(support.vertex) == before[support.vertex.idx()];
        });
        if (stays.empty()) break;
        std::ranges::move(stays, std::back_inserter(left));
        supports.erase(stays.begin(), stays.end());
        for (std::uint32_t i = 0; i < before.size(); ++i) mesh.set_point(VertexHandle(i), before[i]);
    }
    for (const VertexSupport& support : left)
        result.short_of_target.push_back(quality::short_of_target(mesh, projector, support));
    std::ranges::sort(result.short_of_target, {}, &quality::ShortOfTarget::vertex);
    return result;
}

}  // namespace maille::modeler
