#include "volmesh/named_sets.hh"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "volmesh/tet_topology.hh"

namespace maille::volmesh {
namespace {

void check_rule(const SetInfo& info) {
    const bool is_vertex = info.kind == EntityKind::vertex;
    using Kind = SetRule::Kind;
    const Kind rule = info.rule.kind;
    const bool is_vertex_rule =
        rule == Kind::both_ends || rule == Kind::from_edges || rule == Kind::from_faces;
    if (is_vertex ? rule == Kind::copy : is_vertex_rule)
        throw std::invalid_argument("set '" + info.name + "': a " +
                                    (is_vertex ? "vertex" : "cell, face or edge") +
                                    " set cannot have this rule");
    if ((rule == Kind::from_edges || rule == Kind::from_faces) && !info.rule.source.is_valid())
        throw std::invalid_argument("set '" + info.name + "': its rule needs a source set");
    if (rule == Kind::custom && !info.rule.function)
        throw std::invalid_argument("set '" + info.name + "': its rule needs a function");
}

}  // namespace

NamedSets::NamedSets() : combinations_(1), rows_(1), heritages_(1) {
    combination_ids_.emplace(std::vector<SetHandle>{}, 0);
    row_ids_.emplace(Row{}, 0);
}

SetHandle NamedSets::add(SetInfo info) {
    check_rule(info);
    const SetHandle handle(size());
    if (!by_name_.emplace(std::pair(info.name, info.kind), handle).second)
        throw std::invalid_argument("there is a set '" + info.name + "' of this kind already");
    const auto rule = info.rule.kind;
    if (rule == SetRule::Kind::custom) custom_.push_back(handle);
    if (rule == SetRule::Kind::from_edges || rule == SetRule::Kind::from_faces)
        born_from_[info.rule.source.idx()].push_back(handle);
    if (info.rule.source.is_valid()) is_source_[info.rule.source.idx()] = 1;
    born_from_.emplace_back();
    is_source_.push_back(0);
    infos_.push_back(std::move(info));
    heritages_.assign(rows_.size(), {});
    unions_.clear();
    births_.clear();
    return handle;
}

SetHandle NamedSets::find(const std::string& name, EntityKind kind) const {
    const auto found = by_name_.find({name, kind});
    return found == by_name_.end() ? SetHandle() : found->second;
}

bool NamedSets::contains(CombinationId id, SetHandle set) const {
    return id != 0 && std::ranges::binary_search(combinations_[id], set);
}

CombinationId NamedSets::with(CombinationId id, SetHandle set) {
    std::vector<SetHandle> sets = combinations_[id];
    sets.push_back(set);
    return intern(std::move(sets));
}

CombinationId NamedSets::without(CombinationId id, SetHandle set) {
    std::vector<SetHandle> sets = combinations_[id];
    std::erase(sets, set);
    return intern(std::move(sets));
}

CombinationId NamedSets::intern(std::vector<SetHandle> sets) {
    std::ranges::sort(sets);
    sets.erase(std::unique(sets.begin(), sets.end()), sets.end());
    const auto [place, is_new] =
        combination_ids_.try_emplace(sets, static_cast<CombinationId>(combinations_.size()));
    if (is_new) combinations_.push_back(std::move(sets));
    return place->second;
}

NamedSets::RowId NamedSets::intern(const Row& row) {
    const auto [place, is_new] = row_ids_.try_emplace(row, n_rows());
    if (is_new) {
        rows_.push_back(row);
        heritages_.emplace_back();
    }
    return place->second;
}

const NamedSets::Heritage& NamedSets::heritage(RowId id, int local_edge) {
    if (heritages_[id][local_edge].is_known()) return heritages_[id][local_edge];
    const auto [i, j] = tet::edge_vertices[local_edge];
    const int opposite = tet::opposite_edge(local_edge);
    const auto [k, l] = tet::edge_vertices[opposite];

    // What the split passes through: the cell, the edge, and the two faces at the edge. The rest stays as it
    // is, and each child has one new face, opposite the end that it lost, and two new edges, from m to k and
    // l.
    Row first = rows_[id];
    first.cell = inherited(first.cell);
    first.edges[local_edge] = inherited(first.edges[local_edge]);
    first.faces[k] = inherited(first.faces[k]);
    first.faces[l] = inherited(first.faces[l]);
    Row second = first;
    first.faces[i] = 0;
    first.edges[tet::edge_between[j][k]] = 0;
    first.edges[tet::edge_between[j][l]] = 0;
    second.faces[j] = 0;
    second.edges[tet::edge_between[i][k]] = 0;
    second.edges[tet::edge_between[i][l]] = 0;

    const CombinationId sources = sources_at(rows_[id], local_edge);
    const std::pair children(intern(first), intern(second));
    return heritages_[id][local_edge] = {children, sources};
}

CombinationId NamedSets::sources_at(const Row& row, int local_edge) {
    const auto [k, l] = tet::edge_vertices[tet::opposite_edge(local_edge)];
    std::vector<SetHandle> sources;
    for (const CombinationId id : {row.cell, row.faces[k], row.faces[l], row.edges[local_edge]})
        std::ranges::copy_if(combination(id), std::back_inserter(sources),
                             [&](SetHandle set) { return is_source_[set.idx()] != 0; });
    return intern(std::move(sources));
}

CombinationId NamedSets::unite(CombinationId a, CombinationId b) const {
    if (a == b || b == 0) return a;
    if (a == 0) return b;
    const auto known = unions_.find(std::minmax(a, b));
    return known == unions_.end() ? unknown : known->second;
}

CombinationId NamedSets::unite(CombinationId a, CombinationId b) {
    const CombinationId known = std::as_const(*this).unite(a, b);
    if (known != unknown) return known;
    std::vector<SetHandle> sets = combinations_[a];
    std::ranges::copy(combinations_[b], std::back_inserter(sets));
    return unions_[std::minmax(a, b)] = intern(std::move(sets));
}

CombinationId NamedSets::born(const Birth& birth) const {
    if (birth.sources == 0 && (birth.at_a == 0 || birth.at_b == 0)) return 0;
    const auto known = births_.find(birth);
    return known == births_.end() ? unknown : known->second;
}

CombinationId NamedSets::born(const Birth& birth) {
    const CombinationId known = std::as_const(*this).born(birth);
    if (known != unknown) return known;
    std::vector<SetHandle> sets;
    for (SetHandle source : combination(birth.sources))
        std::ranges::copy(born_from_[source.idx()], std::back_inserter(sets));
    for (SetHandle set : combination(birth.at_a)) {
        const SetRule& rule = info(set).rule;
        if (rule.kind != SetRule::Kind::both_ends || !contains(birth.at_b, set)) continue;
        if (!rule.source.is_valid() || contains(birth.sources, rule.source)) sets.push_back(set);
    }
    return births_[birth] = intern(std::move(sets));
}

CombinationId NamedSets::inherited(CombinationId id) {
    std::vector<SetHandle> sets = combinations_[id];
    std::erase_if(sets, [&](SetHandle set) { return info(set).rule.kind == SetRule::Kind::none; });
    return intern(std::move(sets));
}

}  // namespace maille::volmesh
