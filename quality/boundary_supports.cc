#include "quality/boundary_supports.hh"

#include <algorithm>

namespace maille::quality {

std::vector<VertexSupport> supports_from(const volmesh::TetMesh& mesh, volmesh::FaceSurfaces& surfaces_of,
                                         std::uint32_t first, std::span<const volmesh::CellHandle> cells) {
    std::vector<volmesh::Surfaces> supports(mesh.n_vertices() - first);
    for (const volmesh::CellHandle c : cells) {
        for (int face = 0; face < 4; ++face) {
            const auto hf = volmesh::TetMesh::halfface(c, face);
            if (mesh.combination(hf) == 0) continue;
            const auto vertices = mesh.halfface_vertices(hf);
            if (std::ranges::none_of(vertices, [&](const auto v) { return v.idx() >= first; })) continue;
            const volmesh::Surfaces surfaces = surfaces_of(hf);
            for (const volmesh::VertexHandle v : vertices)
                if (v.idx() >= first) volmesh::add(supports[v.idx() - first], surfaces);
        }
    }
    std::vector<VertexSupport> found;
    for (std::uint32_t i = 0; i < supports.size(); ++i)
        if (!supports[i].empty()) found.push_back({volmesh::VertexHandle(first + i), std::move(supports[i])});
    return found;
}

}  // namespace maille::quality
