#pragma once

#include <concepts>
#include <string>
#include <vector>

#include "volmesh/tet_mesh.hh"

/// New named sets from others, or from what is asked of each entity. A new set has its kind's default rule
/// and is independent of those that it came from. Each costs what the members of the
/// sets that it looks at do, set_where a pass over the mesh. All throw std::invalid_argument where the kind
/// has a set of that name already, or a set is of another kind than is said.
namespace maille::volmesh {

///@{
/// Of one or more sets of one kind: what is in any of them; in all of them.
SetHandle set_union(TetMesh& mesh, const std::string& name, const std::vector<SetHandle>& sets);
SetHandle set_intersection(TetMesh& mesh, const std::string& name, const std::vector<SetHandle>& sets);
///@}
/// What is in the first but in none of the others, all of one kind.
SetHandle set_difference(TetMesh& mesh, const std::string& name, SetHandle from,
                         const std::vector<SetHandle>& others);

/// The vertices, edges or faces of a set's members: of edges their ends, of faces their corners and sides, of
/// cells all. The kind wanted is lower than the set's.
SetHandle set_closure(TetMesh& mesh, const std::string& name, SetHandle of, EntityKind wanted);

/// The faces that have a cell of the set on one side only, those on the mesh's boundary included.
SetHandle set_boundary(TetMesh& mesh, const std::string& name, SetHandle cells);

/// The faces between two sets of cells: with a cell of `a` that is not in `b` on one side, and one of `b`
/// that is not in `a` on the other.
SetHandle set_skin(TetMesh& mesh, const std::string& name, SetHandle a, SetHandle b);

/// The entities, of the kind of the handle, for which the predicate is true. It is asked once for each, in
/// ascending order, with a smart handle. Edges and faces get numbers, if they have none.
template <class Entity, std::predicate<SmartHandle<Entity>> Predicate>
SetHandle set_where(TetMesh& mesh, const std::string& name, const Predicate& is_member) {
    const auto fill = [&](EntityKind kind, const auto& entities) {
        const SetHandle set = mesh.add_set(name, kind);
        for (const auto h : entities)
            if (is_member(h)) mesh.insert(set, Entity(h));
        return set;
    };
    if constexpr (std::same_as<Entity, VertexHandle>) return fill(EntityKind::vertex, mesh.vertices());
    if constexpr (std::same_as<Entity, EdgeHandle>) return fill(EntityKind::edge, mesh.edges());
    if constexpr (std::same_as<Entity, FaceHandle>) return fill(EntityKind::face, mesh.faces());
    if constexpr (std::same_as<Entity, CellHandle>) return fill(EntityKind::cell, mesh.cells());
}

}  // namespace maille::volmesh
