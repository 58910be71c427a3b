#include "volmesh/collapse.hh"

#include <algorithm>

#include <Eigen/Geometry>

#include "volmesh/orientation.hh"
#include "volmesh/retriangulation.hh"
#include "volmesh/strata.hh"

namespace maille::volmesh {
namespace {

/// The edge that is to vanish, with the cells at its ends.
struct Collapse {
    const TetMesh& mesh;
    VertexHandle gone, heir;
    CellList at_gone, at_heir;

    bool has_heir(CellHandle c) const { return mesh.local_vertex(c, heir) >= 0; }
    /// Whether the edge from v to w has an interface face among the cells of v.
    bool is_on_interface(const CellList& cells, VertexHandle v, VertexHandle w) const {
        for (CellHandle c : cells) {
            const int i = mesh.local_vertex(c, v);
            const int j = mesh.local_vertex(c, w);
            if (j < 0) continue;
            for (int f = 0; f < 4; ++f)
                if (f != i && f != j && is_interface(mesh, TetMesh::halfface(c, f))) return true;
        }
        return false;
    }
};

VertexList neighbors(const TetMesh& mesh, const CellList& cells, VertexHandle v) {
    VertexList found;
    for (CellHandle c : cells)
        for (VertexHandle w : mesh.cell_vertices(c))
            if (w != v) found.push_back(w);
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

/// Vertices and edges that both links have are those of the edge's own link.
bool is_link_ok(const Collapse& edge, const VertexList& ring) {
    const TetMesh& mesh = edge.mesh;
    const VertexList at_gone = neighbors(mesh, edge.at_gone, edge.gone);
    const VertexList at_heir = neighbors(mesh, edge.at_heir, edge.heir);
    VertexList common;
    std::ranges::set_intersection(at_gone, at_heir, std::back_inserter(common));
    if (common != ring) return false;

    const auto is_in_ring = [&](VertexHandle v) { return std::ranges::binary_search(ring, v); };
    for (CellHandle c : edge.at_gone) {
        if (edge.has_heir(c)) continue;
        const int at = mesh.local_vertex(c, edge.gone);
        for (int f = 0; f < 4; ++f) {
            if (f == at) continue;
            VertexList others;
            for (int i = 0; i < 4; ++i)
                if (i != at && i != f) others.push_back(mesh.cell_vertex(c, i));
            if (!is_in_ring(others[0]) || !is_in_ring(others[1])) continue;
            const auto has_both = [&](CellHandle d) {
                return mesh.local_vertex(d, others[0]) >= 0 && mesh.local_vertex(d, others[1]) >= 0;
            };
            const bool heir_has_face = std::ranges::any_of(edge.at_heir, has_both);
            const bool edge_has_cell = std::ranges::any_of(
                edge.at_gone, [&](CellHandle d) { return edge.has_heir(d) && has_both(d); });
            if (heir_has_face && !edge_has_cell) return false;
        }
    }
    return true;
}

/// Nothing at the edge that merges with its counterpart is an interface or in a set, and interfaces don't
/// fold up: what is beside the edge on both its ends' interfaces is beside it on a face of an interface.
bool are_sets_ok(const Collapse& edge, const VertexList& ring) {
    const TetMesh& mesh = edge.mesh;
    for (CellHandle c : edge.at_gone) {
        if (!edge.has_heir(c)) continue;
        const int gone = mesh.local_vertex(c, edge.gone);
        const int heir = mesh.local_vertex(c, edge.heir);
        if (is_interface(mesh, TetMesh::halfface(c, heir))) return false;
        for (int i = 0; i < 4; ++i)
            if (i != gone && i != heir && mesh.combination(c, tet::edge_between[gone][i]) != 0) return false;
    }
    if (stratum(mesh, edge.gone, edge.at_gone) == 3) return true;
    for (VertexHandle v : ring) {
        if (!edge.is_on_interface(edge.at_gone, edge.gone, v) ||
            !edge.is_on_interface(edge.at_heir, edge.heir, v))
            continue;
        const bool has_face = std::ranges::any_of(edge.at_gone, [&](CellHandle c) {
            const int i = mesh.local_vertex(c, v);
            if (i < 0 || !edge.has_heir(c)) return false;
            const int rest = 6 - i - mesh.local_vertex(c, edge.gone) - mesh.local_vertex(c, edge.heir);
            return is_interface(mesh, TetMesh::halfface(c, rest));
        });
        if (!has_face) return false;
    }
    return true;
}

/// Whether the interfaces at the vertex that goes stay where they are.
bool is_flat(const Collapse& edge, double tolerance) {
    const TetMesh& mesh = edge.mesh;
    const Point& heir = mesh.point(edge.heir);
    for (CellHandle c : edge.at_gone) {
        const int at = mesh.local_vertex(c, edge.gone);
        for (int f = 0; f < 4; ++f) {
            const HalffaceHandle hf = TetMesh::halfface(c, f);
            if (f == at || !is_interface(mesh, hf)) continue;
            const auto v = mesh.halfface_vertices(hf);
            if (std::ranges::find(v, edge.heir) != v.end()) continue;
            const Point& p = mesh.point(v[0]);
            const Point normal = (mesh.point(v[1]) - p).cross(mesh.point(v[2]) - p).stableNormalized();
            if (!(std::abs(normal.dot(heir - p)) <= tolerance)) return false;
        }
    }
    return true;
}

/// The vertex after `gone` on the curve that comes from `heir`.
VertexHandle next_on_curve(const Collapse& edge) {
    for (CellHandle c : edge.at_gone) {
        const int at = edge.mesh.local_vertex(c, edge.gone);
        for (int i = 0; i < 4; ++i) {
            const VertexHandle v = edge.mesh.cell_vertex(c, i);
            if (i != at && v != edge.heir && stratum(edge.mesh, c, tet::edge_between[at][i]) == 1) return v;
        }
    }
    return {};
}

bool is_curve_ok(const Collapse& edge, const VertexList& ring, double tolerance) {
    const VertexHandle next = next_on_curve(edge);
    if (!next.is_valid() || std::ranges::binary_search(ring, next)) return false;
    const Point& heir = edge.mesh.point(edge.heir);
    const Point along = (edge.mesh.point(next) - heir).stableNormalized();
    return along.cross(edge.mesh.point(edge.gone) - heir).norm() <= tolerance;
}

bool are_new_cells_positive(const Collapse& edge) {
    const TetMesh& mesh = edge.mesh;
    return std::ranges::all_of(edge.at_gone, [&](CellHandle c) {
        if (edge.has_heir(c)) return true;
        auto p = mesh.cell_points(c);
        p[mesh.local_vertex(c, edge.gone)] = mesh.point(edge.heir);
        return orientation(p[0], p[1], p[2], p[3]) > 0;
    });
}

}  // namespace

bool is_collapse_ok(const TetMesh& mesh, VertexHandle gone, VertexHandle heir, double tolerance) {
    const Collapse edge{mesh, gone, heir, mesh.vc_range(gone), mesh.vc_range(heir)};
    CellList around;
    for (CellHandle c : edge.at_gone)
        if (edge.has_heir(c)) around.push_back(c);
    if (around.empty() || around.size() == edge.at_gone.size()) return false;
    const int at = stratum(mesh, gone, edge.at_gone);
    if (at == 0 || at != stratum(mesh, around.front(), mesh.local_edge(around.front(), gone, heir)))
        return false;
    VertexList ring = neighbors(mesh, around, gone);
    ring.erase(std::ranges::find(ring, heir));
    return are_new_cells_positive(edge) && is_link_ok(edge, ring) && are_sets_ok(edge, ring) &&
           (at == 3 || is_flat(edge, tolerance)) && (at != 1 || is_curve_ok(edge, ring, tolerance));
}

void collapse_edge(TetMesh& mesh, VertexHandle gone, VertexHandle heir) {
    Retriangulation change{
        .old_cells = mesh.vc_range(gone), .new_cells = {}, .new_faces = {}, .gone = gone, .heir = heir};
    for (CellHandle c : change.old_cells) {
        if (mesh.local_vertex(c, heir) >= 0) continue;
        auto vertices = mesh.cell_vertices(c);
        std::ranges::replace(vertices, gone, heir);
        change.new_cells.push_back({vertices, c});
    }
    mesh.replace_cells(change);
}

}  // namespace maille::volmesh
