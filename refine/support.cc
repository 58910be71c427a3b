#include "refine/support.hh"

#include <algorithm>

namespace maille::refine {
namespace {

void add(Support& to, const Support& more) {
    for (const std::uint32_t surface : more) {
        const auto place = std::ranges::lower_bound(to, surface);
        if (place == to.end() || *place != surface) to.insert(place, surface);
    }
}

}  // namespace

Supports::Supports(const volmesh::TetMesh& mesh, const volmesh::Projector& projector) : mesh_(mesh) {
    for (std::uint32_t i = 0; i < projector.surfaces.size(); ++i) {
        const auto set = mesh.find_set(projector.surfaces[i], volmesh::EntityKind::face);
        if (set.is_valid()) surface_of_set_.emplace(set, i);
    }
}

std::vector<std::pair<volmesh::VertexHandle, Support>> Supports::of_vertices_from(
    std::uint32_t first, std::span<const volmesh::CellHandle> cells) {
    std::vector<Support> supports(mesh_.n_vertices() - first);
    for (const volmesh::CellHandle c : cells) {
        for (int face = 0; face < 4; ++face) {
            const volmesh::CombinationId id = mesh_.combination(volmesh::TetMesh::halfface(c, face));
            if (id == 0) continue;
            for (const int local : volmesh::tet::face_vertices[face]) {
                const std::uint32_t v = mesh_.cell_vertex(c, local).idx();
                if (v >= first) add(supports[v - first], of_combination(id));
            }
        }
    }
    std::vector<std::pair<volmesh::VertexHandle, Support>> found;
    for (std::uint32_t i = 0; i < supports.size(); ++i)
        if (!supports[i].empty())
            found.emplace_back(volmesh::VertexHandle(first + i), std::move(supports[i]));
    return found;
}

const Support& Supports::of_combination(volmesh::CombinationId id) {
    const auto [place, is_new] = of_combination_.try_emplace(id);
    if (is_new) {
        for (const volmesh::SetHandle set : mesh_.sets_of(id)) {
            const auto surface = surface_of_set_.find(set);
            if (surface != surface_of_set_.end()) add(place->second, {surface->second});
        }
    }
    return place->second;
}

}  // namespace maille::refine
