#include "volmesh/io/mesh_draft.hh"

#include <utility>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "volmesh/error.hh"
#include "volmesh/orientation.hh"

namespace maille::volmesh::io {

namespace {

using Index = TetMesh::Index;

void turn_inverted_cells(MeshDraft& draft) {
    constexpr std::size_t ahead = 16;  // cells whose points are brought near in memory before they are asked
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, draft.cells.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            if (i + ahead < range.end())
                for (Index v : draft.cells[i + ahead]) __builtin_prefetch(&draft.points[v]);
            auto& cell = draft.cells[i];
            const auto point = [&](int k) -> const Point& { return draft.points[cell[k]]; };
            if (orientation(point(0), point(1), point(2), point(3)) < 0) std::swap(cell[2], cell[3]);
        }
    });
}

template <std::size_t N>
void require_vertices(const std::vector<std::array<Index, N>>& elements, std::size_t n_points,
                      const char* what) {
    for (std::size_t i = 0; i < elements.size(); ++i)
        for (Index v : elements[i])
            if (v >= n_points)
                throw InputError(
                    fmt::format("{} {} has vertex {}, but there are only {} vertices (all numbers from 0)",
                                what, i, v, n_points));
}

HalffaceHandle halfface_of(const TetMesh& mesh, const std::array<Index, 3>& face, const std::string& set) {
    const auto [a, b, c] = face;
    const HalffaceHandle hf = mesh.find_halfface(VertexHandle(a), VertexHandle(b), VertexHandle(c));
    if (!hf.is_valid())
        throw InputError(
            fmt::format("group '{}' has the triangle of vertices {} (from 0), which is no face of a "
                        "tetrahedron",
                        set, fmt::join(face, ", ")));
    return hf;
}

std::pair<CellHandle, int> edge_place_of(const TetMesh& mesh, const std::array<Index, 2>& edge,
                                         const std::string& set) {
    const VertexHandle a(edge[0]);
    const VertexHandle b(edge[1]);
    const CellList cells = mesh.cells_around(a, b);
    if (a == b || cells.empty())
        throw InputError(
            fmt::format("group '{}' has the line of vertices {} (from 0), which is no edge of a "
                        "tetrahedron",
                        set, fmt::join(edge, ", ")));
    return {cells.front(), mesh.local_edge(cells.front(), a, b)};
}

/// Makes the set, with its rule; before it the one that the rule looks at.
SetHandle made_set(TetMesh& mesh, const MeshDraft& draft, const MeshDraft::Set& set) {
    if (const SetHandle there = mesh.find_set(set.name, set.kind); there.is_valid()) return there;
    if (!set.rule) return mesh.add_set(set.name, set.kind);
    SetRule rule{set.rule->kind, {}, {}};
    if (const auto& named = set.rule->source) {
        const MeshDraft::Set* source = draft.find_set(named->second, named->first);
        // What a rule looks at is no set of vertices, and has no such rule itself.
        if (source == nullptr || source->kind == EntityKind::vertex)
            throw InputError(fmt::format("the rule of set '{}' looks at a set '{}', which there is not",
                                         set.name, named->second));
        rule.source = made_set(mesh, draft, *source);
    }
    try {
        return mesh.add_set(set.name, set.kind, rule);
    } catch (const std::invalid_argument& error) {
        throw InputError(error.what());
    }
}

void insert_members(TetMesh& mesh, const MeshDraft& draft, const MeshDraft::Set& set) {
    const SetHandle s = made_set(mesh, draft, set);
    switch (set.kind) {
        case EntityKind::vertex:
            mesh.insert(s, std::vector<VertexHandle>(set.members.begin(), set.members.end()));
            break;
        case EntityKind::edge:
            for (Index member : set.members) {
                const auto [cell, local_edge] = edge_place_of(mesh, draft.edges[member], set.name);
                mesh.insert(s, cell, local_edge);
            }
            break;
        case EntityKind::face:
            for (Index member : set.members) mesh.insert(s, halfface_of(mesh, draft.faces[member], set.name));
            break;
        case EntityKind::cell:
            mesh.insert(s, std::vector<CellHandle>(set.members.begin(), set.members.end()));
            break;
    }
}

}  // namespace

MeshDraft::Set& MeshDraft::set(const std::string& name, EntityKind kind) {
    const auto [at, is_new] = set_numbers_.try_emplace({name, kind}, sets.size());
    if (is_new) sets.push_back({name, kind, {}});
    return sets[at->second];
}

const MeshDraft::Set* MeshDraft::find_set(const std::string& name, EntityKind kind) const {
    const auto at = set_numbers_.find({name, kind});
    return at == set_numbers_.end() ? nullptr : &sets[at->second];
}

std::string group_name(long long number) {
    return fmt::format("group{}", number);
}

EntityKind kind_of_dimension(int dimension) {
    return static_cast<EntityKind>(dimension);
}

TetMesh assemble(MeshDraft draft, const std::filesystem::path& path) {
    try {
        require_vertices(draft.cells, draft.points.size(), "tetrahedron");
        require_vertices(draft.faces, draft.points.size(), "triangle");
        require_vertices(draft.edges, draft.points.size(), "line");
        turn_inverted_cells(draft);
        TetMesh mesh = TetMesh::from_cells(std::move(draft.points), std::move(draft.cells));
        for (const MeshDraft::Set& set : draft.sets) insert_members(mesh, draft, set);
        add_fields(mesh, draft.fields);
        add_mesh_values(mesh, draft.mesh_values);
        return mesh;
    } catch (const InputError& error) {
        throw InputError(path.string() + ": " + error.what());
    }
}

}  // namespace maille::volmesh::io
