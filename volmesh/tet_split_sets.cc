#include <algorithm>

#include "volmesh/tet_mesh.hh"
#include "volmesh/tet_split.hh"

// What a split passes on to named sets.

namespace maille::volmesh {

void TetMesh::split_sets(const Split& split) {
    for (std::size_t r = 0; r < split.ring.size(); ++r) {
        const Index c = split.ring[r].idx();
        const auto& local = split.locals[r];
        auto [first, second] = sets_.split(cell_rows_[c], local.edge());
        if (local.a > local.b)
            std::swap(first, second);  // the first child keeps the edge's lower local number
        cell_rows_[c] = first;
        cell_rows_.push_back(second);
    }
}

// The vertex sets that m is in by rule, looked up before the split.
CombinationId TetMesh::born_combination(const Split& split) {
    if (vertex_combinations_.empty() && cell_rows_.empty()) return 0;

    // The sets that the edge lies in: its own, and those of the faces and cells round it.
    std::vector<SetHandle> around;
    const auto add = [&](CombinationId id) {
        around.insert(around.end(), sets_of(id).begin(), sets_of(id).end());
    };
    add(combination(split.ring.front(), split.locals.front().edge()));
    for (std::size_t r = 0; r < split.ring.size(); ++r) {
        const NamedSets::Row& row = this->row(split.ring[r]);
        add(row.cell);
        add(row.faces[split.locals[r].k]);
        add(row.faces[split.locals[r].l]);
    }

    std::vector<SetHandle> born;
    for (SetHandle source : around) std::ranges::copy(sets_.born_from(source), std::back_inserter(born));
    for (SetHandle set : sets_of(combination(split.a))) {
        const SetRule& rule = set_info(set).rule;
        if (rule.kind != SetRule::Kind::both_ends || !contains(set, split.b)) continue;
        if (!rule.source.is_valid() || std::ranges::find(around, rule.source) != around.end())
            born.push_back(set);
    }
    return born.empty() ? 0 : sets_.intern(std::move(born));
}

// So far custom sets have passed to every child of a member; now their functions say which stay.
void TetMesh::apply_custom_rules(const Split& split) {
    for (SetHandle set : sets_.custom()) {
        const auto is_member = [&](std::vector<VertexHandle> entity) {
            std::ranges::sort(entity);
            return set_info(set).rule.function(*this, entity, split.a, split.b, split.m);
        };
        const EntityKind kind = set_info(set).kind;
        if (kind == EntityKind::vertex) {
            if (is_member({split.m})) insert(set, split.m);
            continue;
        }
        for (std::size_t r = 0; r < split.ring.size(); ++r) {
            const auto& local = split.locals[r];
            for (CellHandle c : {split.ring[r], CellHandle(split.new_cell(r))}) {
                if (kind == EntityKind::cell && contains(set, c)) {
                    const auto v = cell_vertices(c);
                    if (!is_member({v.begin(), v.end()})) erase(set, c);
                } else if (kind == EntityKind::edge && contains(set, c, local.edge())) {
                    if (!is_member({cell_vertex(c, local.a), cell_vertex(c, local.b)}))
                        erase(set, c, local.edge());
                } else if (kind == EntityKind::face) {
                    for (int side : {local.k, local.l}) {
                        const auto v = halfface_vertices(halfface(c, side));
                        if (contains(set, halfface(c, side)) && !is_member({v.begin(), v.end()}))
                            erase(set, halfface(c, side));
                    }
                }
            }
        }
    }
}

}  // namespace maille::volmesh
