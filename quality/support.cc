#include "quality/support.hh"

#include <algorithm>
#include <map>

namespace maille::quality {
namespace {

using volmesh::CellHandle;
using volmesh::CombinationId;
using volmesh::EntityKind;
using volmesh::HalffaceHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

/// The projector's surfaces among the face sets of a combination; looked up once for each combination.
class SurfacesOfFaces {
  public:
    SurfacesOfFaces(const TetMesh& mesh, const volmesh::Projector* projector)
        : mesh_(mesh), by_set_(mesh.n_sets()) {
        if (!projector) return;
        for (std::uint32_t s = 0; s < projector->surfaces.size(); ++s)
            if (const auto set = mesh.find_set(projector->surfaces[s], EntityKind::face); set.is_valid())
                by_set_[set.idx()].push_back(s);
    }

    const Surfaces& operator()(CombinationId id) {
        const auto [place, is_new] = by_combination_.try_emplace(id);
        Surfaces& surfaces = place->second;
        if (is_new) {
            for (volmesh::SetHandle set : mesh_.sets_of(id))
                surfaces.insert(surfaces.end(), by_set_[set.idx()].begin(), by_set_[set.idx()].end());
            std::sort(surfaces.begin(), surfaces.end());
            surfaces.erase(std::unique(surfaces.begin(), surfaces.end()), surfaces.end());
        }
        return surfaces;
    }

  private:
    const TetMesh& mesh_;
    std::vector<Surfaces> by_set_;
    std::map<CombinationId, Surfaces> by_combination_;
};

/// Whether the face bounds anything: the mesh, a material or a face set.
bool is_interface(const TetMesh& mesh, HalffaceHandle hf) {
    const HalffaceHandle other = mesh.opposite_halfface_handle(hf);
    return !other.is_valid() || mesh.combination(hf) != 0 ||
           mesh.combination(TetMesh::incident_cell(hf)) != mesh.combination(TetMesh::incident_cell(other));
}

/// Combinations of the faces met at each vertex so far, to tell where two parts of one surface meet.
using CombinationsAt = std::vector<boost::container::small_vector<CombinationId, 3>>;

void add_face(Freedom& freedom, boost::container::small_vector<CombinationId, 3>& met, CombinationId id,
              SurfacesOfFaces& surfaces_of) {
    if (freedom.is_fixed || std::find(met.begin(), met.end(), id) != met.end()) return;
    const Surfaces& surfaces = surfaces_of(id);
    freedom.is_fixed = surfaces.empty() || std::any_of(met.begin(), met.end(), [&](CombinationId earlier) {
                           return surfaces_of(earlier) == surfaces;
                       });
    met.push_back(id);
    for (std::uint32_t s : surfaces) {
        const auto place = std::lower_bound(freedom.surfaces.begin(), freedom.surfaces.end(), s);
        if (place == freedom.surfaces.end() || *place != s) freedom.surfaces.insert(place, s);
    }
}

}  // namespace

std::vector<Freedom> freedoms(const TetMesh& mesh, const volmesh::Projector* projector) {
    std::vector<Freedom> result(mesh.n_vertices());
    CombinationsAt met(mesh.n_vertices());
    SurfacesOfFaces surfaces_of(mesh, projector);
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
            for (VertexHandle v : mesh.halfface_vertices(hf))
                add_face(result[v.idx()], met[v.idx()], mesh.combination(hf), surfaces_of);
        }
    }
    return result;
}

}  // namespace maille::quality
