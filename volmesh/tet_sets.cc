#include <algorithm>
#include <stdexcept>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {
namespace {

SetRule default_rule(EntityKind kind) {
    return kind == EntityKind::vertex ? SetRule::none() : SetRule::copy();
}

}  // namespace

SetHandle TetMesh::add_set(const std::string& name, EntityKind kind, SetRule rule) {
    if (rule.source.is_valid()) {
        if (rule.source.idx() >= n_sets())
            throw std::invalid_argument("set '" + name + "': the source of its rule is no set of this mesh");
        const EntityKind source = set_info(rule.source).kind;
        if ((rule.kind == SetRule::Kind::from_edges && source != EntityKind::edge) ||
            (rule.kind == SetRule::Kind::from_faces && source != EntityKind::face) ||
            source == EntityKind::vertex)
            throw std::invalid_argument("set '" + name + "': the source of its rule is of the wrong kind");
    }
    return sets_.add({name, kind, std::move(rule)});
}

SetHandle TetMesh::add_set(const std::string& name, EntityKind kind) {
    return add_set(name, kind, default_rule(kind));
}

void TetMesh::require_kind(SetHandle s, EntityKind kind) const {
    if (s.idx() >= n_sets() || set_info(s).kind != kind)
        throw std::invalid_argument("the set is of another kind than its new member");
}

// ---- membership
// -----------------------------------------------------------------------------------------------------

template <class Change>
void TetMesh::change_row(CellHandle c, const Change& change) {
    if (cell_rows_.empty()) cell_rows_.resize(cells_.size(), 0);
    NamedSets::Row changed = sets_.row(cell_rows_[c.idx()]);
    change(changed);
    cell_rows_[c.idx()] = sets_.intern(changed);
}

void TetMesh::change_combination(SetHandle s, VertexHandle v, bool in) {
    require_kind(s, EntityKind::vertex);
    members_.forget(s.idx());
    if (vertex_combinations_.empty()) vertex_combinations_.resize(points_.size(), 0);
    CombinationId& id = vertex_combinations_[v.idx()];
    id = in ? sets_.with(id, s) : sets_.without(id, s);
}

void TetMesh::change_combination(SetHandle s, CellHandle c, bool in) {
    require_kind(s, EntityKind::cell);
    members_.forget(s.idx());
    change_row(c, [&](NamedSets::Row& row) {
        row.cell = in ? sets_.with(row.cell, s) : sets_.without(row.cell, s);
    });
}

void TetMesh::change_combination(SetHandle s, HalffaceHandle hf, bool in) {
    require_kind(s, EntityKind::face);
    members_.forget(s.idx());
    const CombinationId old = combination(hf);
    const CombinationId id = in ? sets_.with(old, s) : sets_.without(old, s);
    for (HalffaceHandle side : {hf, opposite_halfface_handle(hf)})
        if (side.is_valid())
            change_row(incident_cell(side), [&](NamedSets::Row& row) { row.faces[local_face(side)] = id; });
}

void TetMesh::change_combination(SetHandle s, CellHandle c, int local_edge, bool in) {
    require_kind(s, EntityKind::edge);
    members_.forget(s.idx());
    const CombinationId old = combination(c, local_edge);
    const CombinationId id = in ? sets_.with(old, s) : sets_.without(old, s);
    const auto [i, j] = tet::edge_vertices[local_edge];
    const VertexHandle a = cell_vertex(c, i);
    const VertexHandle b = cell_vertex(c, j);
    for (CellHandle around : cells_around(c, local_edge))
        change_row(around, [&](NamedSets::Row& row) { row.edges[this->local_edge(around, a, b)] = id; });
}

namespace {

/// Calls `compute` once for each number, and then remembers.
template <class Compute>
class Memory {
  public:
    explicit Memory(const Compute& compute) : compute_(compute) {}
    std::uint32_t operator()(std::uint32_t number) {
        if (number >= results_.size()) results_.resize(number + 1, NamedSets::unknown);
        if (results_[number] == NamedSets::unknown) results_[number] = compute_(number);
        return results_[number];
    }

  private:
    Compute compute_;
    std::vector<std::uint32_t> results_;
};

}  // namespace

void TetMesh::insert(SetHandle s, std::span<const VertexHandle> vertices) {
    require_kind(s, EntityKind::vertex);
    members_.forget(s.idx());
    if (vertex_combinations_.empty()) vertex_combinations_.resize(points_.size(), 0);
    Memory joined([&](CombinationId id) { return sets_.with(id, s); });
    for (VertexHandle v : vertices) vertex_combinations_[v.idx()] = joined(vertex_combinations_[v.idx()]);
}

void TetMesh::insert(SetHandle s, std::span<const CellHandle> cells) {
    require_kind(s, EntityKind::cell);
    members_.forget(s.idx());
    if (cell_rows_.empty()) cell_rows_.resize(cells_.size(), 0);
    Memory joined([&](NamedSets::RowId id) {
        NamedSets::Row row = sets_.row(id);
        row.cell = sets_.with(row.cell, s);
        return sets_.intern(row);
    });
    for (CellHandle c : cells) cell_rows_[c.idx()] = joined(cell_rows_[c.idx()]);
}

void TetMesh::insert(SetHandle s, VertexHandle v) {
    change_combination(s, v, true);
}
void TetMesh::insert(SetHandle s, CellHandle c) {
    change_combination(s, c, true);
}
void TetMesh::insert(SetHandle s, HalffaceHandle hf) {
    change_combination(s, hf, true);
}
void TetMesh::insert(SetHandle s, CellHandle c, int local_edge) {
    change_combination(s, c, local_edge, true);
}
void TetMesh::erase(SetHandle s, VertexHandle v) {
    change_combination(s, v, false);
}
void TetMesh::erase(SetHandle s, CellHandle c) {
    change_combination(s, c, false);
}
void TetMesh::erase(SetHandle s, HalffaceHandle hf) {
    change_combination(s, hf, false);
}
void TetMesh::erase(SetHandle s, CellHandle c, int local_edge) {
    change_combination(s, c, local_edge, false);
}

void TetMesh::insert(SetHandle s, EdgeHandle e) {
    const auto [c, local] = edge_place(e);
    insert(s, c, local);
}

void TetMesh::erase(SetHandle s, EdgeHandle e) {
    const auto [c, local] = edge_place(e);
    erase(s, c, local);
}

bool TetMesh::contains(SetHandle s, EdgeHandle e) const {
    const auto [c, local] = edge_place(e);
    return contains(s, c, local);
}

// A cell that has just been linked: its edges and faces that others have too are in the same sets there.
// Those of lower numbers: the others may not have any yet.
void TetMesh::inherit_sets_from_neighbors(CellHandle c) {
    if (cell_rows_.empty()) return;
    NamedSets::Row inherited;
    for (int f = 0; f < 4; ++f)
        if (const HalffaceHandle other = opposite_halfface_handle(halfface(c, f));
            other.is_valid() && incident_cell(other) < c)
            inherited.faces[f] = combination(other);
    for (int e = 0; e < 6; ++e) {
        const auto [i, j] = tet::edge_vertices[e];
        for (CellHandle around : cells_around(c, e))
            if (around < c)
                inherited.edges[e] =
                    combination(around, local_edge(around, cell_vertex(c, i), cell_vertex(c, j)));
    }
    cell_rows_[c.idx()] = sets_.intern(inherited);
}

}  // namespace maille::volmesh
