#include <algorithm>
#include <array>

#include <tbb/parallel_for.h>

#include "volmesh/tet_split_uniformly.hh"

// What a split of all cells passes on to sets, properties and numbers.

namespace maille::volmesh {
namespace {

/// Divides the value of an entity, at index `first`, among as many as there are from there on, a power of
/// two, by halving again and again.
void halve(BaseProperty& property, std::uint32_t first, std::uint32_t n) {
    if (n == 1) return;
    property.set_child(first, first + n / 2, 0.5);
    halve(property, first, n / 2);
    halve(property, first + n / 2, n / 2);
}

}  // namespace

void TetMesh::UniformSplit::pass_on_vertex_sets() {
    NamedSets& sets = mesh_.sets_;
    if (mesh_.vertex_combinations_.empty() && mesh_.cell_rows_.empty()) return;
    std::vector<CombinationId> around(n_edges_, 0);  // what lies round each edge and brings vertices forth
    if (!mesh_.cell_rows_.empty())
        for (Index c = 0; c < n_cells_; ++c) {
            if (mesh_.cell_rows_[c] == 0) continue;
            for (int e = 0; e < 6; ++e) {
                CombinationId& all = around[mesh_.edges_->of_cell[c][e]];
                all = sets.unite(all, sets.heritage(mesh_.cell_rows_[c], e).sources);
            }
        }
    for (Index e = 0; e < n_edges_; ++e) {
        const auto [a, b] = ends_[e];
        around[e] = sets.born({around[e], mesh_.combination(a), mesh_.combination(b)});
    }
    auto& combinations = mesh_.vertex_combinations_;
    if (combinations.empty()) {
        if (std::ranges::all_of(around, [](CombinationId id) { return id == 0; })) return;
        combinations.resize(n_vertices_, 0);
    }
    combinations.grow(std::size_t{n_vertices_} + n_edges_);
    std::ranges::copy(around, combinations.begin() + n_vertices_);
}

NamedSets::RowId TetMesh::UniformSplit::child_row(const NamedSets::Row& parent, int diagonal, int child) {
    NamedSets& sets = mesh_.sets_;
    const tet::Octasection& cut = tet::octasections[diagonal];
    NamedSets::Row row;
    row.cell = sets.inherited(parent.cell);
    for (int f = 0; f < 4; ++f)
        if (const int face = cut.outer[child][f]; face != tet::Octasection::no_face)
            row.faces[f] = sets.inherited(parent.faces[face]);
    for (int e = 0; e < 6; ++e)
        if (const int edge = cut.halved[child][e]; edge != tet::Octasection::no_edge)
            row.edges[e] = sets.inherited(parent.edges[edge]);
    return sets.intern(row);
}

void TetMesh::UniformSplit::pass_on_rows() {
    if (mesh_.cell_rows_.empty()) return;
    // A row is divided in the same way in all cells that have it.
    std::vector<std::array<NamedSets::RowId, 8>> children(3 * std::size_t{mesh_.sets_.n_rows()});
    std::vector<std::uint8_t> is_known(children.size(), 0);
    const auto place = [&](Index c) { return 3 * std::size_t{mesh_.cell_rows_[c]} + diagonals_[c]; };
    for (Index c = 0; c < n_cells_; ++c) {
        if (is_known[place(c)]++ != 0) continue;
        const NamedSets::Row row = mesh_.sets_.row(mesh_.cell_rows_[c]);
        for (int child = 0; child < 8; ++child)
            children[place(c)][child] = child_row(row, diagonals_[c], child);
    }
    Column<NamedSets::RowId> rows;
    rows.grow(8 * std::size_t{n_cells_});
    tbb::parallel_for(Index{0}, n_cells_, [&](Index c) {
        std::ranges::copy(children[place(c)], rows.begin() + 8 * std::size_t{c});
    });
    mesh_.cell_rows_ = std::move(rows);
}

void TetMesh::UniformSplit::pass_on_cell_values() {
    PropertyList& properties = mesh_.properties_of(EntityKind::cell);
    if (properties.empty()) return;
    std::vector<Index> parents(8 * std::size_t{n_cells_});
    for (std::size_t i = 0; i < parents.size(); ++i) parents[i] = static_cast<Index>(i / 8);
    properties.for_each([&](BaseProperty& property) {
        property.gather(parents);
        for (Index c = 0; c < n_cells_; ++c) halve(property, 8 * c, 8);
    });
}

/// The half of edge e at its lower end keeps the number e, the other one gets n + e; edges inside faces and
/// cells come after those.
void TetMesh::UniformSplit::divide_edges(const Column<Cell>& parents) {
    const EdgeNumbers before = std::exchange(*mesh_.edges_, {});
    auto& [of_cell, place] = *mesh_.edges_;
    of_cell.assign(mesh_.cells_.size(), {none, none, none, none, none, none});
    place.resize(2 * std::size_t{n_edges_});
    for (Index c = 0; c < n_cells_; ++c)
        for (int child = 0; child < 4; ++child)
            for (int e = 0; e < 6; ++e) {
                const int halved = section(c).halved[child][e];
                if (halved == tet::Octasection::no_edge) continue;
                const auto [i, j] = tet::edge_vertices[halved];
                const int far = i == child ? j : i;
                const bool is_lower = parents[c].vertices[child] < parents[c].vertices[far];
                const Index number = before.of_cell[c][halved] + (is_lower ? 0 : n_edges_);
                of_cell[8 * c + child][e] = number;
                place[number] = 8 * (8 * c + child) + e;
            }
    mesh_.number_remaining_edges();
    mesh_.properties_of(EntityKind::edge).for_each([&](BaseProperty& property) {
        property.resize(place.size());
        for (Index e = 0; e < n_edges_; ++e) property.set_child(e, n_edges_ + e, 0.5);
    });
}

/// The quarter of face f at its lowest vertex keeps the number f; those at the two others, ascending, and the
/// one in the middle get n + 3 f and what follows.
void TetMesh::UniformSplit::divide_faces(const Column<Cell>& parents) {
    const FaceNumbers before = std::exchange(*mesh_.faces_, {});
    auto& [of_cell, halfface] = *mesh_.faces_;
    const auto n = static_cast<Index>(before.halfface.size());
    of_cell.assign(mesh_.cells_.size(), {none, none, none, none});
    halfface.resize(4 * std::size_t{n});
    for (Index c = 0; c < n_cells_; ++c)
        for (int child = 0; child < 8; ++child)
            for (int f = 0; f < 4; ++f) {
                const int face = section(c).outer[child][f];
                if (face == tet::Octasection::no_face) continue;
                Index quarter = 3;
                if (child < 4)
                    quarter = static_cast<Index>(std::ranges::count_if(tet::face_vertices[face], [&](int i) {
                        return parents[c].vertices[i] < parents[c].vertices[child];
                    }));
                const Index whole = before.of_cell[c][face];
                const Index number = quarter == 0 ? whole : n + 3 * whole + quarter - 1;
                of_cell[8 * c + child][f] = number;
                halfface[number] = 4 * (8 * c + child) + f;
            }
    mesh_.number_remaining_faces();
    mesh_.properties_of(EntityKind::face).for_each([&](BaseProperty& property) {
        property.resize(halfface.size());
        for (Index f = 0; f < n; ++f) {
            property.set_child(f, n + 3 * f, 0.5);
            property.set_child(f, n + 3 * f + 1, 0.5);
            property.set_child(n + 3 * f, n + 3 * f + 2, 0.5);
        }
    });
}

// So far custom sets have passed to every child of a member; now their functions say which stay.
void TetMesh::UniformSplit::apply_custom_rules() {
    for (const SetHandle set : mesh_.sets_.custom()) {
        // Of several edges that were cut, the one with the lowest middle stands for all.
        const auto is_member = [&](std::vector<VertexHandle> entity) {
            std::ranges::sort(entity);
            const VertexHandle m =
                *std::ranges::find_if(entity, [&](VertexHandle v) { return v.idx() >= n_vertices_; });
            const auto [a, b] = ends_[m.idx() - n_vertices_];
            return mesh_.set_info(set).rule.function(mesh_, entity, a, b, m);
        };
        switch (mesh_.set_info(set).kind) {
            case EntityKind::vertex:
                for (Index e = 0; e < n_edges_; ++e)
                    if (const VertexHandle m(n_vertices_ + e); is_member({m})) mesh_.insert(set, m);
                break;
            case EntityKind::cell:
                for (const CellHandle c : mesh_.cell_members(set)) {
                    const auto v = mesh_.cell_vertices(c);
                    if (!is_member({v.begin(), v.end()})) mesh_.erase(set, c);
                }
                break;
            case EntityKind::face:
                for (const HalffaceHandle hf : mesh_.face_members(set)) {
                    const auto v = mesh_.halfface_vertices(hf);
                    if (!is_member({v.begin(), v.end()})) mesh_.erase(set, hf);
                }
                break;
            case EntityKind::edge:
                for (const auto& [c, e] : mesh_.edge_members(set)) {
                    const auto [i, j] = tet::edge_vertices[e];
                    if (!is_member({mesh_.cell_vertex(c, i), mesh_.cell_vertex(c, j)}))
                        mesh_.erase(set, c, e);
                }
                break;
        }
    }
}

}  // namespace maille::volmesh
