#include <fmt/format.h>

#include "volmesh/error.hh"
#include "volmesh/fans.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {
namespace {

using Index = TetMesh::Index;

Index shifted(Index i, Index by) {
    return i == TetMesh::none ? i : i + by;
}

template <std::size_t N>
std::array<Index, N> shifted(std::array<Index, N> all, Index by) {
    for (Index& i : all) i = shifted(i, by);
    return all;
}

/// Marks of deletion, of which there are none at all where nothing is deleted.
void append_marks(std::vector<std::uint8_t>& to, std::size_t n, const std::vector<std::uint8_t>& more,
                  std::size_t n_more) {
    if (to.empty() && more.empty()) return;
    to.resize(n, 0);
    to.insert(to.end(), more.begin(), more.end());
    to.resize(n + n_more, 0);
}

/// The same for numbers of combinations or rows, each translated.
template <class Translate>
void append_ids(Column<std::uint32_t>& to, std::size_t n, const Column<std::uint32_t>& more,
                std::size_t n_more, const Translate& translated) {
    if (to.empty() && more.empty()) return;
    to.resize(n, 0);
    for (std::uint32_t id : more) to.push_back(translated(id));
    to.resize(n + n_more, 0);
}

const BaseProperty* find(const PropertyList& list, const std::string& name) {
    for (const auto& property : list.all())
        if (property && property->name() == name) return property.get();
    return nullptr;
}

void require_same_types(const PropertyList& here, const PropertyList& there) {
    for (const auto& property : here.all()) {
        if (!property) continue;
        const BaseProperty* other = find(there, property->name());
        if (other != nullptr && other->type() != property->type())
            throw InputError(
                fmt::format("property '{}' has values of different types in the two meshes: "
                            "remove or rename one",
                            property->name()));
    }
}

void append_list(PropertyList& here, std::size_t n, const PropertyList& there, std::size_t n_more) {
    for (const auto& other : there.all()) {
        if (!other || find(here, other->name()) != nullptr) continue;
        auto added = other->clone();
        added->gather({});
        added->resize(n);
        here.add(std::move(added));
    }
    here.for_each([&](BaseProperty& property) {
        if (const BaseProperty* other = find(there, property.name())) property.append(*other);
        property.resize(n + n_more);
    });
}

}  // namespace

void TetMesh::append(const TetMesh& other) {
    if (&other == this) return append(TetMesh(other));
    if (std::size_t{n_cells()} + other.n_cells() >= none / 8 ||
        std::size_t{n_vertices()} + other.n_vertices() >= none)
        throw InputError(fmt::format("the two meshes together have {} cells, more than fit in one",
                                     std::size_t{n_cells()} + other.n_cells()));
    for (int kind = 0; kind < 4; ++kind) require_same_types(properties_[kind], other.properties_[kind]);
    require_same_types(mesh_properties_, other.mesh_properties_);

    // What both have numbered keeps its numbers, the other's behind these.
    if (edges_ || other.edges_) {
        request_edges();
        other.request_edges();
    }
    if (faces_ || other.faces_) {
        request_faces();
        other.request_faces();
    }
    members_.forget();
    append_sets(other);
    append_properties(other);
    append_numbers(other);

    const Index v0 = n_vertices();
    const Index c0 = n_cells();
    append_marks(deleted_vertices_, v0, other.deleted_vertices_, other.n_vertices());
    append_marks(deleted_cells_, c0, other.deleted_cells_, other.n_cells());
    for (const Point& p : other.points_) points_.push_back(p);
    for (Index c : other.vertex_cells_) vertex_cells_.push_back(shifted(c, c0));
    for (const Cell& cell : other.cells_)
        cells_.push_back({shifted(cell.vertices, v0), shifted(cell.neighbors, 4 * c0)});
    n_boundary_ += other.n_boundary_;
    for (const auto& [v, fans] : other.vertex_fans_)
        for (Index c : fans) vertex_fans_[v + v0].push_back(c + c0);
    for (const auto& [key, fans] : other.edge_fans_)
        for (Index c : fans)
            edge_fans_[edge_key(static_cast<Index>(key >> 32U) + v0, static_cast<Index>(key) + v0)].push_back(
                c + c0);
}

void TetMesh::append_sets(const TetMesh& other) {
    std::vector<SetHandle> set_here;
    for (Index s = 0; s < other.n_sets(); ++s) {
        const SetInfo& info = other.set_info(SetHandle(s));
        SetHandle here = find_set(info.name, info.kind);
        if (!here.is_valid()) {
            SetRule rule = info.rule;
            if (rule.source.is_valid()) rule.source = set_here[rule.source.idx()];
            here = add_set(info.name, info.kind, std::move(rule));
        }
        set_here.push_back(here);
    }
    std::unordered_map<CombinationId, CombinationId> combinations;
    const auto combination_here = [&](CombinationId id) {
        const auto [at, is_new] = combinations.try_emplace(id, 0);
        if (is_new) {
            std::vector<SetHandle> sets;
            for (SetHandle s : other.sets_of(id)) sets.push_back(set_here[s.idx()]);
            at->second = sets_.intern(std::move(sets));
        }
        return at->second;
    };
    std::unordered_map<NamedSets::RowId, NamedSets::RowId> rows;
    const auto row_here = [&](NamedSets::RowId id) {
        const auto [at, is_new] = rows.try_emplace(id, 0);
        if (is_new) {
            NamedSets::Row row = other.sets_.row(id);
            row.cell = combination_here(row.cell);
            for (CombinationId& face : row.faces) face = combination_here(face);
            for (CombinationId& edge : row.edges) edge = combination_here(edge);
            at->second = sets_.intern(row);
        }
        return at->second;
    };
    append_ids(vertex_combinations_, points_.size(), other.vertex_combinations_, other.points_.size(),
               combination_here);
    append_ids(cell_rows_, cells_.size(), other.cell_rows_, other.cells_.size(), row_here);
}

void TetMesh::append_properties(const TetMesh& other) {
    for (const EntityKind kind : {EntityKind::vertex, EntityKind::edge, EntityKind::face, EntityKind::cell}) {
        const bool is_numbered = kind == EntityKind::edge   ? edges_.has_value()
                                 : kind == EntityKind::face ? faces_.has_value()
                                                            : true;
        if (is_numbered)
            append_list(properties_of(kind), n_indices(kind), other.properties_of(kind),
                        other.n_indices(kind));
    }
    for (const auto& property : other.mesh_properties_.all())
        if (property && find(mesh_properties_, property->name()) == nullptr)
            mesh_properties_.add(property->clone());
}

void TetMesh::append_numbers(const TetMesh& other) {
    const Index c0 = n_cells();
    if (edges_) {
        const auto e0 = static_cast<Index>(edges_->place.size());
        for (Index place : other.edges_->place) edges_->place.push_back(shifted(place, 8 * c0));
        for (const auto& numbers : other.edges_->of_cell) edges_->of_cell.push_back(shifted(numbers, e0));
    }
    if (faces_) {
        const auto f0 = static_cast<Index>(faces_->halfface.size());
        for (Index hf : other.faces_->halfface) faces_->halfface.push_back(shifted(hf, 4 * c0));
        for (const auto& numbers : other.faces_->of_cell) faces_->of_cell.push_back(shifted(numbers, f0));
    }
}

}  // namespace maille::volmesh
