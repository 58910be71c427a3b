#include "volmesh/tet_replace.hh"

#include <algorithm>

#include "volmesh/fans.hh"
#include "volmesh/measure.hh"

// Local edits: some cells go, others fill their place.

namespace maille::volmesh {
namespace {

using Index = TetMesh::Index;
using Corners = std::array<Index, 4>;

FaceKey sorted(FaceKey v) {
    if (v[0] > v[1]) std::swap(v[0], v[1]);
    if (v[1] > v[2]) std::swap(v[1], v[2]);
    if (v[0] > v[1]) std::swap(v[0], v[1]);
    return v;
}

FaceKey face_key(const Corners& cell, int face) {
    const auto& local = tet::face_vertices[face];
    return sorted({cell[local[0]], cell[local[1]], cell[local[2]]});
}

template <class Parts, class Key>
auto find_part(Parts& parts, const Key& key) {
    return std::find_if(parts.begin(), parts.end(), [&](const auto& part) { return part.key == key; });
}

template <class Parts, class Key>
CombinationId sets_of_part(const Parts& parts, const Key& key) {
    const auto at = find_part(parts, key);
    return at == parts.end() ? 0 : at->sets;
}

bool is_among(const CellList& cells, CellHandle c) {
    return std::ranges::find(cells, c) != cells.end();
}

/// Keys of faces and edges as they will be after a collapse: the end that goes is renamed to its heir, but
/// not in what vanishes with it.
class KeysAfter {
  public:
    KeysAfter(const TetMesh& mesh, const Retriangulation& change)
        : gone_(change.gone.idx()), heir_(change.heir.idx()) {
        if (!change.gone.is_valid()) return;
        for (CellHandle c : change.old_cells) {
            const int heir = mesh.local_vertex(c, change.heir);
            if (heir < 0) continue;
            const Corners& cell = mesh.cell_vertex_indices()[c.idx()];
            vanishing_.push_back(face_key(cell, heir));
            ring_.insert(ring_.end(), cell.begin(), cell.end());
        }
    }

    FaceKey face(const Corners& cell, int f) const {
        FaceKey key = face_key(cell, f);
        const auto gone = std::ranges::find(key, gone_);
        if (gone == key.end() || std::ranges::find(key, heir_) != key.end() ||
            std::ranges::find(vanishing_, key) != vanishing_.end())
            return key;
        *gone = heir_;
        return sorted(key);
    }

    std::uint64_t edge(const Corners& cell, int e) const {
        auto [i, j] = tet::edge_vertices[e];
        if (cell[i] != gone_) std::swap(i, j);
        const bool is_renamed = cell[i] == gone_ && std::ranges::find(ring_, cell[j]) == ring_.end();
        return edge_key(is_renamed ? heir_ : cell[i], cell[j]);
    }

  private:
    Index gone_, heir_;
    boost::container::small_vector<FaceKey, 12> vanishing_;
    boost::container::small_vector<Index, 48> ring_;
};

/// Which values go from what vanishes to what is born, or else to what stays, in the same sets.
template <class Part>
std::vector<Inheritance> inheritances(const CavityParts<Part>& before, const CavityParts<Part>& after) {
    struct Group {
        CombinationId sets;
        Inheritance to_born, to_kept;
    };
    std::vector<Group> groups;
    const auto group_of = [&](CombinationId sets) -> Group& {
        const auto at = std::ranges::find(groups, sets, &Group::sets);
        return at == groups.end() ? groups.emplace_back(Group{sets, {}, {}}) : *at;
    };
    for (const Part& part : before)
        if (find_part(after, part.key) == after.end())
            group_of(part.group).to_born.olds.push_back(part.number);
    for (const Part& part : after) {
        Group& group = group_of(part.group);
        const bool is_kept = find_part(before, part.key) != before.end();
        (is_kept ? group.to_kept : group.to_born).heirs.push_back({part.number, part.parent, part.measure});
    }
    std::vector<Inheritance> result;
    for (Group& group : groups) {
        if (!group.to_born.heirs.empty()) {
            result.push_back(std::move(group.to_born));
        } else if (!group.to_born.olds.empty()) {
            group.to_kept.olds = std::move(group.to_born.olds);
            for (const auto& heir : group.to_kept.heirs) group.to_kept.olds.push_back(heir.index);
            result.push_back(std::move(group.to_kept));
        }
    }
    return result;
}

/// Gives the new cells' faces, or edges, their numbers. `place` holds one place of each number. Returns
/// whether any has vanished.
template <class Part, std::size_t n, class KeyOf, class MeasureOf>
bool renumber(const CavityParts<Part>& before, const CavityParts<Part>& born, const Cavity& cavity,
              std::vector<std::array<Index, n>>& of_cell, std::vector<Index>& place, Index stride,
              PropertyList& properties, const KeyOf& key_of, const MeasureOf& measure_of) {
    CavityParts<Part> after;
    for (Index slot : cavity.slots)
        for (Index local = 0; local < n; ++local) {
            const auto key = key_of(slot, static_cast<int>(local));
            auto at = find_part(after, key);
            if (at == after.end()) {
                Part part{key, 0, 0, static_cast<Index>(place.size()), TetMesh::none, 0};
                if (const auto old = find_part(before, key); old != before.end()) {
                    part = *old;
                } else {
                    if (const auto with_parent = find_part(born, key); with_parent != born.end()) {
                        part = *with_parent;
                        part.number = static_cast<Index>(place.size());
                    }
                    place.push_back(TetMesh::none);
                }
                part.measure = measure_of(slot, static_cast<int>(local));
                after.push_back(part);
                at = after.end() - 1;
            }
            of_cell[slot][local] = at->number;
            place[at->number] = stride * slot + local;
        }
    bool has_vanished = false;
    for (const Part& part : before)
        if (find_part(after, part.key) == after.end()) {
            place[part.number] = TetMesh::none;
            has_vanished = true;
        }
    const auto passed = properties.empty() ? std::vector<Inheritance>{} : inheritances(before, after);
    properties.for_each([&](BaseProperty& property) {
        property.resize(place.size());
        property.pass_on(passed);
    });
    return has_vanished;
}

}  // namespace

void TetMesh::replace_cells(const Retriangulation& change) {
    Cavity cavity = look_into(change);
    members_.forget();
    relink(change, cavity);
    const auto cells = cell_vertex_indices();
    bool has_vanished = change.old_cells.size() > change.new_cells.size() || change.gone.is_valid();
    if (edges_) {
        edges_->of_cell.resize(cells_.size());
        has_vanished |= renumber(
            cavity.edges, {}, cavity, edges_->of_cell, edges_->place, 8, properties_of(EntityKind::edge),
            [&](Index c, int e) {
                const auto [i, j] = tet::edge_vertices[e];
                return edge_key(cells[c][i], cells[c][j]);
            },
            [&](Index c, int e) {
                const auto [i, j] = tet::edge_vertices[e];
                return (points_[cells[c][i]] - points_[cells[c][j]]).norm();
            });
    }
    if (faces_) {
        faces_->of_cell.resize(cells_.size());
        has_vanished |= renumber(
            cavity.faces, cavity.born_faces, cavity, faces_->of_cell, faces_->halfface, 4,
            properties_of(EntityKind::face), [&](Index c, int f) { return face_key(cells[c], f); },
            [&](Index c, int f) { return area(*this, halfface(CellHandle(c), f)); });
    }
    pass_on_cell_values(change, cavity);
    if (!cell_rows_.empty()) give_rows(change, cavity);

    if (has_vanished && deleted_cells_.empty()) deleted_cells_.resize(cells_.size(), 0);
    for (std::size_t r = change.new_cells.size(); r < change.old_cells.size(); ++r)
        deleted_cells_[change.old_cells[r].idx()] = 1;
    if (change.gone.is_valid()) {
        if (deleted_vertices_.empty()) deleted_vertices_.resize(points_.size(), 0);
        deleted_vertices_[change.gone.idx()] = 1;
        vertex_cells_[change.gone.idx()] = none;
    }
    if (!cavity.hinges.empty()) repair_hinges(change, cavity);
}

Cavity TetMesh::look_into(const Retriangulation& change) const {
    Cavity cavity;
    const KeysAfter keys(*this, change);
    for (CellHandle c : change.old_cells) {
        const Corners& cell = cells_[c.idx()].vertices;
        const auto& neighbors = cells_[c.idx()].neighbors;
        for (int f = 0; f < 4; ++f)
            if (neighbors[f] != none && !is_among(change.old_cells, CellHandle(neighbors[f] / 4)))
                cavity.outside.push_back({face_key(cell, f), neighbors[f]});
        if (!cell_rows_.empty()) cavity.rows.push_back(cell_rows_[c.idx()]);
        if (!faces_ && !edges_ && row(c).has_cell_sets_only()) continue;
        for (int f = 0; f < 4; ++f) {
            const CombinationId sets = combination(halfface(c, f));
            const FaceKey key = keys.face(cell, f);
            if ((sets == 0 && !faces_) || find_part(cavity.faces, key) != cavity.faces.end()) continue;
            const Index number = faces_ ? faces_->of_cell[c.idx()][f] : none;
            cavity.faces.push_back({key, sets, sets, number, number, 0});
        }
        for (int e = 0; e < 6; ++e) {
            const CombinationId sets = combination(c, e);
            const std::uint64_t key = keys.edge(cell, e);
            if ((sets == 0 && !edges_) || find_part(cavity.edges, key) != cavity.edges.end()) continue;
            const Index number = edges_ ? edges_->of_cell[c.idx()][e] : none;
            cavity.edges.push_back({key, sets, sets, number, number, 0});
        }
    }
    for (const auto& face : change.new_faces) {
        const CombinationId sets = combination(face.parent);
        const Index parent = faces_ ? faces_->of_cell[face.parent.idx() / 4][face.parent.idx() % 4] : none;
        const FaceKey key = sorted({face.vertices[0].idx(), face.vertices[1].idx(), face.vertices[2].idx()});
        cavity.born_faces.push_back({key, sets, sets, none, parent, 0});
    }
    if (!vertex_fans_.empty() || !edge_fans_.empty()) look_for_hinges(change, cavity);
    return cavity;
}

void TetMesh::look_for_hinges(const Retriangulation& change, Cavity& cavity) const {
    bool has_fans = false;
    for (CellHandle c : change.old_cells) {
        const Corners& cell = cells_[c.idx()].vertices;
        for (Index v : cell) {
            has_fans |= vertex_fans_.contains(v);
            if (std::ranges::find(cavity.hinges, VertexHandle(v)) == cavity.hinges.end())
                cavity.hinges.emplace_back(v);
        }
        for (const auto& [i, j] : tet::edge_vertices)
            has_fans |= edge_fans_.contains(edge_key(cell[i], cell[j]));
    }
    if (!has_fans) return cavity.hinges.clear();
    for (VertexHandle v : cavity.hinges) cavity.cells_at.push_back(vc_range(v));
}

void TetMesh::relink(const Retriangulation& change, Cavity& cavity) {
    for (CellHandle c : change.old_cells)
        for (Index& neighbor : cells_[c.idx()].neighbors) {
            if (neighbor == none) --n_boundary_;
            neighbor = none;
        }
    for (std::size_t r = 0; r < change.new_cells.size(); ++r) {
        const Index slot = r < change.old_cells.size() ? change.old_cells[r].idx() : n_cells();
        cavity.slots.push_back(slot);
        if (slot == n_cells()) {
            cells_.push_back({{}, {none, none, none, none}});
            if (!deleted_cells_.empty()) deleted_cells_.push_back(0);
            if (!cell_rows_.empty()) cell_rows_.push_back(0);
        }
        for (int i = 0; i < 4; ++i) {
            const Index v = change.new_cells[r].vertices[i].idx();
            cells_[slot].vertices[i] = v;
            vertex_cells_[v] = slot;
        }
    }

    boost::container::small_vector<Cavity::Outside, 48> open;  // new half-faces that wait for the other one
    const auto link = [&](Index one, Index other) {
        cells_[one / 4].neighbors[one % 4] = other;
        cells_[other / 4].neighbors[other % 4] = one;
    };
    for (Index slot : cavity.slots)
        for (int f = 0; f < 4; ++f) {
            const FaceKey key = face_key(cells_[slot].vertices, f);
            const auto at = find_part(open, key);
            if (at == open.end()) {
                open.push_back({key, 4 * slot + f});
                continue;
            }
            link(at->halfface, 4 * slot + f);
            *at = open.back();
            open.pop_back();
        }
    for (const auto& [key, halfface] : open) {
        const auto beyond = find_part(cavity.outside, key);
        if (beyond == cavity.outside.end())
            ++n_boundary_;
        else
            link(beyond->halfface, halfface);
    }
}

void TetMesh::give_rows(const Retriangulation& change, const Cavity& cavity) {
    const bool is_plain = cavity.faces.empty() && cavity.edges.empty() && change.new_faces.empty();
    for (std::size_t r = 0; r < cavity.slots.size(); ++r) {
        const auto parent = std::ranges::find(change.old_cells, change.new_cells[r].parent);
        const NamedSets::RowId old = cavity.rows[static_cast<std::size_t>(parent - change.old_cells.begin())];
        if (is_plain && !change.divides) {
            cell_rows_[cavity.slots[r]] = old;
            continue;
        }
        const Corners& cell = cells_[cavity.slots[r]].vertices;
        const auto passed = [&](CombinationId id) { return change.divides ? sets_.inherited(id) : id; };
        NamedSets::Row row;
        row.cell = passed(sets_.row(old).cell);
        for (int f = 0; f < 4; ++f) {
            const FaceKey key = face_key(cell, f);
            row.faces[f] = sets_of_part(cavity.faces, key);
            if (row.faces[f] == 0) row.faces[f] = passed(sets_of_part(cavity.born_faces, key));
        }
        for (int e = 0; e < 6; ++e) {
            const auto [i, j] = tet::edge_vertices[e];
            row.edges[e] = sets_of_part(cavity.edges, edge_key(cell[i], cell[j]));
        }
        cell_rows_[cavity.slots[r]] = sets_.intern(row);
    }
}

void TetMesh::pass_on_cell_values(const Retriangulation& change, const Cavity& cavity) {
    PropertyList& properties = properties_of(EntityKind::cell);
    if (properties.empty()) return;
    std::vector<std::pair<CombinationId, Inheritance>> groups;
    const auto group_of = [&](CellHandle old) -> Inheritance& {
        // The rows are as they were.
        CombinationId sets = 0;
        if (!cavity.rows.empty())
            sets = sets_.row(cavity.rows[std::ranges::find(change.old_cells, old) - change.old_cells.begin()])
                       .cell;
        for (auto& [of, group] : groups)
            if (of == sets) return group;
        return groups.emplace_back(sets, Inheritance{}).second;
    };
    for (CellHandle old : change.old_cells) group_of(old).olds.push_back(old.idx());
    for (std::size_t r = 0; r < cavity.slots.size(); ++r) {
        const CellHandle parent = change.new_cells[r].parent;
        group_of(parent).heirs.push_back(
            {cavity.slots[r], parent.idx(), volume(*this, CellHandle(cavity.slots[r]))});
    }
    std::vector<Inheritance> passed;
    for (auto& [sets, group] : groups) passed.push_back(std::move(group));
    properties.for_each([&](BaseProperty& property) {
        property.resize(cells_.size());
        property.pass_on(passed);
    });
}

void TetMesh::repair_hinges(const Retriangulation& change, Cavity& cavity) {
    for (std::size_t i = 0; i < cavity.hinges.size(); ++i) {
        CellList& cells = cavity.cells_at[i];
        const auto is_old = [&](CellHandle c) { return is_among(change.old_cells, c); };
        cells.erase(std::remove_if(cells.begin(), cells.end(), is_old), cells.end());
        for (Index slot : cavity.slots)
            if (local_vertex(CellHandle(slot), cavity.hinges[i]) >= 0) cells.push_back(CellHandle(slot));
    }
    repair_fans(cavity.hinges, cavity.cells_at);
}

VertexHandle TetMesh::add_vertex(std::span<const VertexHandle> parents, std::span<const double> weights) {
    Point p = Point::Zero();
    std::vector<Index> indices;
    for (std::size_t i = 0; i < parents.size(); ++i) {
        p += weights[i] * point(parents[i]);
        indices.push_back(parents[i].idx());
    }
    points_.push_back(p);
    vertex_cells_.push_back(none);
    if (!deleted_vertices_.empty()) deleted_vertices_.push_back(0);
    if (!vertex_combinations_.empty()) vertex_combinations_.push_back(0);
    properties_of(EntityKind::vertex).for_each([&](BaseProperty& property) {
        property.push_among(indices, weights);
    });
    return VertexHandle(n_vertices() - 1);
}

}  // namespace maille::volmesh
