#include <algorithm>
#include <utility>

#include "volmesh/tet_mesh.hh"

// Lists of the members of sets.

namespace maille::volmesh {

// Calls add(combination, number) for each cell, face or edge that is in sets, ascending.
template <class Add>
void TetMesh::for_each_in_rows(EntityKind kind, const Add& add) const {
    for (Index c = 0; c < cell_rows_.size(); ++c) {
        if (cell_rows_[c] == 0 || is_deleted(CellHandle(c))) continue;
        const NamedSets::Row& in = sets_.row(cell_rows_[c]);
        if (kind == EntityKind::cell) {
            add(in.cell, c);
        } else if (kind == EntityKind::face) {
            for (int f = 0; f < 4; ++f) {
                const HalffaceHandle hf = halfface(CellHandle(c), f);
                // The opposite of a boundary face is invalid, which is more than any other.
                if (in.faces[f] != 0 && hf < opposite_halfface_handle(hf)) add(in.faces[f], hf.idx());
            }
        } else {
            for (int e = 0; e < 6; ++e)
                if (in.edges[e] != 0 && std::ranges::min(cells_around(CellHandle(c), e)) == CellHandle(c))
                    add(in.edges[e], 8 * c + e);
        }
    }
}

// Lists all sets of the set's kind that aren't listed yet, as one pass over the mesh gives them all.
void TetMesh::list_members(EntityKind kind, MemberLists::Lists& lists) const {
    lists.resize(n_sets());
    MemberLists::Lists wanted(n_sets());
    for (Index s = 0; s < n_sets(); ++s)
        if (set_info(SetHandle(s)).kind == kind && !lists[s]) wanted[s].emplace();
    const auto add = [&](CombinationId id, Index member) {
        for (SetHandle s : sets_.combination(id))
            if (wanted[s.idx()]) wanted[s.idx()]->push_back(member);
    };
    if (kind == EntityKind::vertex) {
        for (Index v = 0; v < vertex_combinations_.size(); ++v)
            if (vertex_combinations_[v] != 0 && !is_deleted(VertexHandle(v))) add(vertex_combinations_[v], v);
    } else {
        for_each_in_rows(kind, add);
    }
    for (Index s = 0; s < n_sets(); ++s)
        if (wanted[s]) lists[s] = std::move(wanted[s]);
}

template <class Use>
auto TetMesh::with_members(SetHandle s, const Use& use) const {
    const EntityKind kind = set_info(s).kind;
    return members_.with(
        s.idx(), n_vertices(), [&](MemberLists::Lists& lists) { list_members(kind, lists); }, use);
}

template <class Member, class Make>
std::vector<Member> TetMesh::members(SetHandle s, EntityKind kind, const Make& make) const {
    if (!s.is_valid() || s.idx() >= n_sets() || set_info(s).kind != kind) return {};
    return with_members(s, [&](std::span<const Index> listed) {
        std::vector<Member> members;
        members.reserve(listed.size());
        for (Index member : listed) members.push_back(make(member));
        return members;
    });
}

std::vector<VertexHandle> TetMesh::vertex_members(SetHandle s) const {
    return members<VertexHandle>(s, EntityKind::vertex, [](Index v) { return VertexHandle(v); });
}

std::vector<CellHandle> TetMesh::cell_members(SetHandle s) const {
    return members<CellHandle>(s, EntityKind::cell, [](Index c) { return CellHandle(c); });
}

std::vector<HalffaceHandle> TetMesh::face_members(SetHandle s) const {
    return members<HalffaceHandle>(s, EntityKind::face, [](Index hf) { return HalffaceHandle(hf); });
}

std::vector<std::pair<CellHandle, int>> TetMesh::edge_members(SetHandle s) const {
    return members<std::pair<CellHandle, int>>(s, EntityKind::edge, [](Index place) {
        return std::pair(CellHandle(place / 8), static_cast<int>(place % 8));
    });
}

std::size_t TetMesh::set_size(SetHandle s) const {
    return with_members(s, [](std::span<const Index> members) { return members.size(); });
}

}  // namespace maille::volmesh
