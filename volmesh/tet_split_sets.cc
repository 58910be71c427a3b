#include <algorithm>
#include <utility>

#include <tbb/parallel_for.h>

#include "volmesh/tet_mesh.hh"
#include "volmesh/tet_split.hh"

// What a split passes on to named sets.

namespace maille::volmesh {

/// What NamedSets remembers of a split is looked up by many threads; what it hasn't met yet is worked out
/// afterwards, in order. Returns the combination of each new vertex; nothing where no vertex is born into a
/// set.
std::vector<CombinationId> TetMesh::prepare_sets(std::span<const Split> splits) {
    if (vertex_combinations_.empty() && cell_rows_.empty()) return {};
    std::vector<CombinationId> born(splits.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, splits.size(), 256), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            born[i] = plan_sets(std::as_const(sets_), splits[i]);
    });
    for (std::size_t i = 0; i < splits.size(); ++i)
        if (born[i] == NamedSets::unknown) born[i] = plan_sets(sets_, splits[i]);
    if (std::ranges::all_of(born, [](CombinationId id) { return id == 0; })) return {};
    if (vertex_combinations_.empty()) vertex_combinations_.resize(points_.size(), 0);
    return born;
}

/// The sets of the new vertex, looked up before the split. With sets that are constant, `unknown` where they
/// can't say what becomes of a cell of the ring or of the vertex; else they can from then on.
template <class Sets>
CombinationId TetMesh::plan_sets(Sets& sets, const Split& split) const {
    CombinationId around = 0;
    if (!cell_rows_.empty()) {
        for (std::size_t r = 0; r < split.ring.size(); ++r) {
            const NamedSets::RowId row = cell_rows_[split.ring[r].idx()];
            const NamedSets::Heritage& heritage = sets.heritage(row, split.locals[r].edge());
            if (!heritage.is_known()) return NamedSets::unknown;
            around = sets.unite(around, heritage.sources);
            if (around == NamedSets::unknown) return around;
        }
    }
    return sets.born({around, combination(split.a), combination(split.b)});
}

void TetMesh::split_sets(const Split& split) {
    for (std::size_t r = 0; r < split.ring.size(); ++r) {
        const Index c = split.ring[r].idx();
        const auto& local = split.locals[r];
        auto [first, second] = std::as_const(sets_).heritage(cell_rows_[c], local.edge()).children;
        if (local.a > local.b)
            std::swap(first, second);  // the first child keeps the edge's lower local number
        cell_rows_[c] = first;
        cell_rows_[split.new_cell(r)] = second;
    }
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
