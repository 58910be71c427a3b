#include "volmesh/set_members.hh"

#include <algorithm>

namespace maille::volmesh {

SetMembers::SetMembers(const TetMesh& mesh) : of_set_(mesh.n_sets()) {
    for (const VertexHandle v : mesh.vertices())
        for (SetHandle s : mesh.sets_of(mesh.combination(v))) of_set_[s.idx()].vertices.push_back(v);
    for (const CellHandle c : mesh.cells()) {
        for (SetHandle s : mesh.sets_of(mesh.combination(c))) of_set_[s.idx()].cells.push_back(c);
        for (int f = 0; f < 4; ++f) {
            const HalffaceHandle hf = TetMesh::halfface(c, f);
            // The opposite of a boundary face is invalid, which is more than any other.
            if (hf < mesh.opposite_halfface_handle(hf))
                for (SetHandle s : mesh.sets_of(mesh.combination(hf))) of_set_[s.idx()].faces.push_back(hf);
        }
        for (int e = 0; e < 6; ++e) {
            const CombinationId id = mesh.combination(c, e);
            if (id != 0 && std::ranges::min(mesh.cells_around(c, e)) == c)
                for (SetHandle s : mesh.sets_of(id)) of_set_[s.idx()].edges.emplace_back(c, e);
        }
    }
}

std::size_t SetMembers::size(SetHandle s) const {
    const Members& members = of_set_[s.idx()];
    return members.vertices.size() + members.edges.size() + members.faces.size() + members.cells.size();
}

}  // namespace maille::volmesh
