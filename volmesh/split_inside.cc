#include "volmesh/split_inside.hh"

#include <algorithm>

#include "volmesh/orientation.hh"
#include "volmesh/retriangulation.hh"

namespace maille::volmesh {
namespace {

Point weighted_mean(const TetMesh& mesh, std::span<const VertexHandle> corners,
                    std::span<const double> weights) {
    Point p = Point::Zero();
    for (std::size_t i = 0; i < corners.size(); ++i) p += weights[i] * mesh.point(corners[i]);
    return p;
}

/// Whether the cell is cut into positive parts by this point, for the corners given by it in turn.
bool are_parts_positive(const TetMesh& mesh, CellHandle c, std::span<const VertexHandle> corners,
                        const Point& m) {
    return std::ranges::all_of(corners, [&](VertexHandle v) {
        auto p = mesh.cell_points(c);
        p[mesh.local_vertex(c, v)] = m;
        return orientation(p[0], p[1], p[2], p[3]) > 0;
    });
}

void append_parts(const TetMesh& mesh, CellHandle c, std::span<const VertexHandle> corners, VertexHandle m,
                  Retriangulation& change) {
    for (VertexHandle v : corners) {
        auto vertices = mesh.cell_vertices(c);
        std::ranges::replace(vertices, v, m);
        change.new_cells.push_back({vertices, c});
    }
}

using SetList = boost::container::small_vector<SetHandle, 8>;

void append_sets(const TetMesh& mesh, CombinationId id, SetList& sets) {
    const auto of = mesh.sets_of(id);
    sets.insert(sets.end(), of.begin(), of.end());
}

/// The vertex sets that a vertex between these corners is in by rule; `around` are the sets of what is split.
SetList born_sets(const TetMesh& mesh, std::span<const VertexHandle> corners, const SetList& around) {
    SetList born;
    for (std::uint32_t i = 0; i < mesh.n_sets(); ++i) {
        const SetHandle set(i);
        const SetInfo& info = mesh.set_info(set);
        if (info.kind != EntityKind::vertex) continue;
        const auto& rule = info.rule;
        const bool is_around = std::ranges::find(around, rule.source) != around.end();
        const bool has_all =
            std::ranges::all_of(corners, [&](VertexHandle v) { return mesh.contains(set, v); });
        if ((rule.kind == SetRule::Kind::both_ends && has_all && (is_around || !rule.source.is_valid())) ||
            (rule.kind == SetRule::Kind::from_faces && is_around))
            born.push_back(set);
    }
    return born;
}

VertexHandle split(TetMesh& mesh, std::span<const VertexHandle> corners, std::span<const double> weights,
                   const SetList& around, Retriangulation& change) {
    const SetList born = born_sets(mesh, corners, around);
    const VertexHandle m = mesh.add_vertex(corners, weights);
    for (CellHandle c : change.old_cells) append_parts(mesh, c, corners, m, change);
    mesh.replace_cells(change);
    for (SetHandle set : born) mesh.insert(set, m);
    return m;
}

}  // namespace

bool is_split_face_ok(const TetMesh& mesh, HalffaceHandle hf, const FaceWeights& weights) {
    const auto corners = mesh.halfface_vertices(hf);
    const Point m = weighted_mean(mesh, corners, weights);
    const HalffaceHandle beyond = mesh.opposite_halfface_handle(hf);
    return are_parts_positive(mesh, TetMesh::incident_cell(hf), corners, m) &&
           (!beyond.is_valid() || are_parts_positive(mesh, TetMesh::incident_cell(beyond), corners, m));
}

VertexHandle split_face(TetMesh& mesh, HalffaceHandle hf, const FaceWeights& weights) {
    const auto corners = mesh.halfface_vertices(hf);
    Retriangulation change{.old_cells = {TetMesh::incident_cell(hf)}, .new_cells = {}};
    if (const HalffaceHandle beyond = mesh.opposite_halfface_handle(hf); beyond.is_valid())
        change.old_cells.push_back(TetMesh::incident_cell(beyond));
    change.divides = true;
    const VertexHandle m(mesh.n_vertices());
    for (int i = 0; i < 3; ++i) change.new_faces.push_back({{m, corners[i], corners[(i + 1) % 3]}, hf});
    SetList around;
    append_sets(mesh, mesh.combination(hf), around);
    for (CellHandle c : change.old_cells) append_sets(mesh, mesh.combination(c), around);
    return split(mesh, corners, weights, around, change);
}

bool is_split_cell_ok(const TetMesh& mesh, CellHandle c, const CellWeights& weights) {
    const auto corners = mesh.cell_vertices(c);
    return are_parts_positive(mesh, c, corners, weighted_mean(mesh, corners, weights));
}

VertexHandle split_cell(TetMesh& mesh, CellHandle c, const CellWeights& weights) {
    Retriangulation change{.old_cells = {c}, .new_cells = {}};
    change.divides = true;
    SetList around;
    append_sets(mesh, mesh.combination(c), around);
    return split(mesh, mesh.cell_vertices(c), weights, around, change);
}

}  // namespace maille::volmesh
