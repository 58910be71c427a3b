#include "volmesh/set_algebra.hh"

#include <algorithm>
#include <stdexcept>

namespace maille::volmesh {
namespace {

EntityKind kind_of(const TetMesh& mesh, SetHandle set) {
    if (set.idx() >= mesh.n_sets()) throw std::invalid_argument("there is no such set in the mesh");
    return mesh.set_info(set).kind;
}

void require_kind(const TetMesh& mesh, SetHandle set, EntityKind kind) {
    if (kind_of(mesh, set) != kind)
        throw std::invalid_argument("set '" + mesh.set_info(set).name +
                                    "' is of another kind than is wanted");
}

/// Calls for each member with what `contains` and `insert` take.
template <class Action>
void for_each_member(const TetMesh& mesh, SetHandle set, const Action& action) {
    switch (kind_of(mesh, set)) {
        case EntityKind::vertex:
            for (VertexHandle v : mesh.vertex_members(set)) action(v);
            break;
        case EntityKind::edge:
            for (const auto& [c, local] : mesh.edge_members(set)) action(c, local);
            break;
        case EntityKind::face:
            for (HalffaceHandle hf : mesh.face_members(set)) action(hf);
            break;
        case EntityKind::cell:
            for (CellHandle c : mesh.cell_members(set)) action(c);
            break;
    }
}

/// A new set of the kind of all those given, of which there must be one.
SetHandle add_like(TetMesh& mesh, const std::string& name, const std::vector<SetHandle>& sets) {
    if (sets.empty()) throw std::invalid_argument("set '" + name + "': is to be made of no set at all");
    for (SetHandle set : sets) require_kind(mesh, set, kind_of(mesh, sets.front()));
    return mesh.add_set(name, kind_of(mesh, sets.front()));
}

/// The members of the first that are, or are not, in all the others.
SetHandle add_filtered(TetMesh& mesh, const std::string& name, const std::vector<SetHandle>& sets,
                       bool is_in_others) {
    const SetHandle made = add_like(mesh, name, sets);
    for_each_member(mesh, sets.front(), [&](auto... member) {
        if (std::all_of(sets.begin() + 1, sets.end(),
                        [&](SetHandle set) { return mesh.contains(set, member...) == is_in_others; }))
            mesh.insert(made, member...);
    });
    return made;
}

void insert_parts(TetMesh& mesh, SetHandle made, EntityKind wanted, CellHandle c, const auto& vertices,
                  const auto& edges) {
    if (wanted == EntityKind::vertex)
        for (int v : vertices) mesh.insert(made, mesh.cell_vertex(c, v));
    if (wanted == EntityKind::edge)
        for (int e : edges) mesh.insert(made, c, e);
}

}  // namespace

SetHandle set_union(TetMesh& mesh, const std::string& name, const std::vector<SetHandle>& sets) {
    const SetHandle made = add_like(mesh, name, sets);
    for (SetHandle set : sets)
        for_each_member(mesh, set, [&](auto... member) { mesh.insert(made, member...); });
    return made;
}

SetHandle set_intersection(TetMesh& mesh, const std::string& name, const std::vector<SetHandle>& sets) {
    return add_filtered(mesh, name, sets, true);
}

SetHandle set_difference(TetMesh& mesh, const std::string& name, SetHandle from,
                         const std::vector<SetHandle>& others) {
    std::vector<SetHandle> sets{from};
    sets.insert(sets.end(), others.begin(), others.end());
    return add_filtered(mesh, name, sets, false);
}

SetHandle set_closure(TetMesh& mesh, const std::string& name, SetHandle of, EntityKind wanted) {
    if (wanted >= kind_of(mesh, of))
        throw std::invalid_argument("set '" + name + "': a closure is of a lower kind than its set");
    const SetHandle made = mesh.add_set(name, wanted);
    switch (kind_of(mesh, of)) {
        case EntityKind::vertex:
            break;
        case EntityKind::edge:
            for (const auto& [c, local] : mesh.edge_members(of))
                for (int v : tet::edge_vertices[local]) mesh.insert(made, mesh.cell_vertex(c, v));
            break;
        case EntityKind::face:
            for (HalffaceHandle hf : mesh.face_members(of)) {
                const int f = TetMesh::local_face(hf);
                insert_parts(mesh, made, wanted, TetMesh::incident_cell(hf), tet::face_vertices[f],
                             tet::face_edges[f]);
            }
            break;
        case EntityKind::cell:
            for (CellHandle c : mesh.cell_members(of)) {
                insert_parts(mesh, made, wanted, c, std::array{0, 1, 2, 3}, std::array{0, 1, 2, 3, 4, 5});
                if (wanted == EntityKind::face)
                    for (int f = 0; f < 4; ++f) mesh.insert(made, TetMesh::halfface(c, f));
            }
            break;
    }
    return made;
}

SetHandle set_boundary(TetMesh& mesh, const std::string& name, SetHandle cells) {
    require_kind(mesh, cells, EntityKind::cell);
    const SetHandle made = mesh.add_set(name, EntityKind::face);
    for (CellHandle c : mesh.cell_members(cells))
        for (int f = 0; f < 4; ++f) {
            const HalffaceHandle hf = TetMesh::halfface(c, f);
            const HalffaceHandle other = mesh.opposite_halfface_handle(hf);
            if (!other.is_valid() || !mesh.contains(cells, TetMesh::incident_cell(other)))
                mesh.insert(made, hf);
        }
    return made;
}

SetHandle set_skin(TetMesh& mesh, const std::string& name, SetHandle a, SetHandle b) {
    require_kind(mesh, a, EntityKind::cell);
    require_kind(mesh, b, EntityKind::cell);
    const SetHandle made = mesh.add_set(name, EntityKind::face);
    for (CellHandle c : mesh.cell_members(a)) {
        if (mesh.contains(b, c)) continue;
        for (int f = 0; f < 4; ++f) {
            const HalffaceHandle other = mesh.opposite_halfface_handle(TetMesh::halfface(c, f));
            if (!other.is_valid()) continue;
            const CellHandle beyond = TetMesh::incident_cell(other);
            if (mesh.contains(b, beyond) && !mesh.contains(a, beyond)) mesh.insert(made, other);
        }
    }
    return made;
}

}  // namespace maille::volmesh
