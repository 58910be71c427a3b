#include "quality/support.hh"

#include <algorithm>

namespace maille::quality {
namespace {

using volmesh::CellHandle;
using volmesh::CombinationId;
using volmesh::HalffaceHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

/// Whether the face bounds anything: the mesh, a material or a face set.
bool is_interface(const TetMesh& mesh, HalffaceHandle hf) {
    const HalffaceHandle other = mesh.opposite_halfface_handle(hf);
    return !other.is_valid() || mesh.combination(hf) != 0 ||
           mesh.combination(TetMesh::incident_cell(hf)) != mesh.combination(TetMesh::incident_cell(other));
}

/// The faces met at a vertex so far, to tell where two parts of one surface meet: faces on the same surfaces
/// but in different sets.
struct FaceKind {
    CombinationId sets;
    Surfaces surfaces;
    friend bool operator==(const FaceKind&, const FaceKind&) = default;
};
using FaceKinds = boost::container::small_vector<FaceKind, 3>;

void add_face(Freedom& freedom, FaceKinds& met, const FaceKind& face) {
    if (freedom.is_fixed || std::find(met.begin(), met.end(), face) != met.end()) return;
    freedom.is_fixed = face.surfaces.empty() || std::any_of(met.begin(), met.end(), [&](const auto& earlier) {
                           return earlier.surfaces == face.surfaces;
                       });
    met.push_back(face);
    volmesh::add(freedom.surfaces, face.surfaces);
}

}  // namespace

std::vector<Freedom> freedoms(const TetMesh& mesh, const volmesh::Projector* projector) {
    std::vector<Freedom> result(mesh.n_vertices());
    std::vector<FaceKinds> met(mesh.n_vertices());
    volmesh::FaceSurfaces surfaces_of(mesh, projector);
    for (std::uint32_t v = 0; v < mesh.n_vertices(); ++v)
        result[v].is_fixed = mesh.is_deleted(VertexHandle(v)) || mesh.combination(VertexHandle(v)) != 0;

    for (std::uint32_t i = 0; i < mesh.n_cells(); ++i) {
        const CellHandle c(i);
        if (mesh.is_deleted(c)) continue;
        for (int edge = 0; edge < 6; ++edge)
            if (mesh.combination(c, edge) != 0)
                for (int end : volmesh::tet::edge_vertices[edge])
                    result[mesh.cell_vertex(c, end).idx()].is_fixed = true;
        for (int face = 0; face < 4; ++face) {
            const HalffaceHandle hf = TetMesh::halfface(c, face);
            if (!is_interface(mesh, hf)) continue;
            const FaceKind kind{mesh.combination(hf), surfaces_of(hf)};
            for (VertexHandle v : mesh.halfface_vertices(hf)) add_face(result[v.idx()], met[v.idx()], kind);
        }
    }
    return result;
}

}  // namespace maille::quality
