#include "volmesh/validate.hh"

#include <algorithm>
#include <tuple>
#include <unordered_map>

#include <fmt/format.h>

#include "volmesh/fans.hh"
#include "volmesh/orientation.hh"

namespace maille::volmesh {
namespace {

class Errors {
  public:
    explicit Errors(std::size_t most) : most_(most) {}

    template <class... Args>
    void add(fmt::format_string<Args...> format, Args&&... args) {
        if (++n_ <= most_) errors_.push_back(fmt::format(format, std::forward<Args>(args)...));
    }
    Validation take() {
        if (n_ > most_) errors_.push_back(fmt::format("and {} more", n_ - most_));
        return {std::move(errors_)};
    }

  private:
    std::size_t most_, n_ = 0;
    std::vector<std::string> errors_;
};

void check_geometry(const TetMesh& mesh, Errors& errors) {
    for (VertexHandle v : mesh.vertices())
        if (!mesh.point(v).allFinite()) errors.add("vertex {} is not at a finite place", v.idx());
    for (CellHandle c : mesh.cells()) {
        const auto p = mesh.cell_points(c);
        if (!(p[0] + p[1] + p[2] + p[3]).allFinite()) continue;
        const int sign = orientation(p[0], p[1], p[2], p[3]);
        if (sign <= 0) errors.add("cell {} is {}", c.idx(), sign == 0 ? "flat" : "inverted");
    }
}

void check_cells(const TetMesh& mesh, Errors& errors) {
    for (CellHandle c : mesh.cells()) {
        const auto v = mesh.cell_vertices(c);
        for (int i = 0; i < 4; ++i) {
            if (v[i].idx() >= mesh.n_vertices() || mesh.is_deleted(v[i]))
                errors.add("cell {} has vertex {}, which is not in the mesh", c.idx(), v[i].idx());
            for (int j = 0; j < i; ++j)
                if (v[i] == v[j]) errors.add("cell {} has vertex {} twice", c.idx(), v[i].idx());
        }
    }
}

// Links between neighbours, made anew from the vertices alone.
void check_neighbors(const TetMesh& mesh, Errors& errors) {
    struct Side {
        std::array<std::uint32_t, 3> vertices;
        HalffaceHandle halfface;
        bool operator<(const Side& other) const {
            return std::tie(vertices, halfface) < std::tie(other.vertices, other.halfface);
        }
    };
    std::vector<Side> sides;
    for (HalffaceHandle hf : mesh.halffaces()) {
        const auto v = mesh.halfface_vertices(hf);
        Side side{{v[0].idx(), v[1].idx(), v[2].idx()}, hf};
        std::ranges::sort(side.vertices);
        sides.push_back(side);
    }
    std::sort(sides.begin(), sides.end());
    std::size_t n_boundary = 0;
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t same = i + 1;
        while (same < sides.size() && sides[same].vertices == sides[i].vertices) ++same;
        const HalffaceHandle hf = sides[i].halfface;
        if (same - i > 2)
            errors.add("the face of cell {} opposite its vertex {} has {} cells", hf.idx() / 4, hf.idx() % 4,
                       same - i);
        const HalffaceHandle other = same - i == 2 ? sides[i + 1].halfface : HalffaceHandle();
        n_boundary += other.is_valid() ? 0 : 1;
        if (mesh.opposite_halfface_handle(hf) != other ||
            (other.is_valid() && mesh.opposite_halfface_handle(other) != hf))
            errors.add("cell {} does not know its neighbour opposite its vertex {}", hf.idx() / 4,
                       hf.idx() % 4);
        if (other.is_valid()) {
            const auto v = mesh.halfface_vertices(hf);
            const auto w = mesh.halfface_vertices(other);
            const auto at = std::ranges::find(w, v[0]) - w.begin();
            if (w[(at + 1) % 3] == v[1])
                errors.add("cells {} and {} are on the same side of their common face", hf.idx() / 4,
                           other.idx() / 4);
        }
        i = same;
    }
    if (n_boundary != mesh.n_boundary_faces())
        errors.add("there are {} boundary faces, not {}", n_boundary, mesh.n_boundary_faces());
}

// Each edge of the boundary has an even number of boundary faces, half of them turning either way.
void check_boundary_closed(const TetMesh& mesh, Errors& errors) {
    std::unordered_map<std::uint64_t, int> turning;
    for (HalffaceHandle hf : mesh.boundary_halffaces()) {
        const auto v = mesh.halfface_vertices(hf);
        for (int i = 0; i < 3; ++i) {
            const VertexHandle a = v[i];
            const VertexHandle b = v[(i + 1) % 3];
            turning[edge_key(a.idx(), b.idx())] += a < b ? 1 : -1;
        }
    }
    std::vector<std::uint64_t> open;
    for (const auto& [edge, sum] : turning)
        if (sum != 0) open.push_back(edge);
    std::ranges::sort(open);
    for (std::uint64_t edge : open)
        errors.add("the boundary is open at the edge of vertices {} and {}", edge >> 32U, edge & 0xffffffffU);
}

void check_vertex_cells(const TetMesh& mesh, Errors& errors) {
    std::vector<std::uint32_t> n_cells(mesh.n_vertices(), 0);
    for (CellHandle c : mesh.cells())
        for (VertexHandle v : mesh.cell_vertices(c)) ++n_cells[v.idx()];
    for (VertexHandle v : mesh.vertices()) {
        CellList found = mesh.vc_range(v);
        std::ranges::sort(found);
        const bool is_right = std::ranges::all_of(
            found, [&](CellHandle c) { return !mesh.is_deleted(c) && mesh.local_vertex(c, v) >= 0; });
        if (found.size() != n_cells[v.idx()] || !is_right || std::ranges::adjacent_find(found) != found.end())
            errors.add("vertex {} is in {} cells, but its incidences give {}", v.idx(), n_cells[v.idx()],
                       found.size());
    }
}

// Rings and the sets of edges and faces. Every edge is met once: in the lowest cell of its ring.
void check_edges(const TetMesh& mesh, Errors& errors) {
    std::unordered_map<std::uint64_t, std::uint32_t> n_cells;
    for (CellHandle c : mesh.cells())
        for (const auto& [i, j] : tet::edge_vertices)
            ++n_cells[edge_key(mesh.cell_vertex(c, i).idx(), mesh.cell_vertex(c, j).idx())];
    std::size_t n_edges = 0;
    for (CellHandle c : mesh.cells())
        for (int e = 0; e < 6; ++e) {
            const CellList ring = mesh.cells_around(c, e);
            if (std::ranges::min(ring) != c) continue;
            ++n_edges;
            const VertexHandle a = mesh.cell_vertex(c, tet::edge_vertices[e][0]);
            const VertexHandle b = mesh.cell_vertex(c, tet::edge_vertices[e][1]);
            if (ring.size() != n_cells[edge_key(a.idx(), b.idx())])
                errors.add("the edge of vertices {} and {} has {} cells round it, but turning finds {}",
                           a.idx(), b.idx(), n_cells[edge_key(a.idx(), b.idx())], ring.size());
            for (CellHandle around : ring) {
                const int local = mesh.local_edge(around, a, b);
                if (local < 0) {
                    errors.add("cell {} is no cell of the edge of vertices {} and {}", around.idx(), a.idx(),
                               b.idx());
                } else {
                    if (mesh.combination(around, local) != mesh.combination(c, e))
                        errors.add("cells {} and {} disagree on the sets of the edge of vertices {} and {}",
                                   c.idx(), around.idx(), a.idx(), b.idx());
                    if (mesh.has_edges() && mesh.edge_handle(around, local) != mesh.edge_handle(c, e))
                        errors.add("cells {} and {} disagree on the number of the edge of vertices {} and {}",
                                   c.idx(), around.idx(), a.idx(), b.idx());
                }
            }
        }
    if (mesh.has_edges()) {
        std::size_t n_numbered = 0;
        for (EdgeHandle e : mesh.edges()) {
            const auto [c, local] = mesh.edge_place(e);
            if (mesh.edge_handle(c, local) != e) errors.add("edge {} is not where its number says", e.idx());
            ++n_numbered;
        }
        if (n_numbered != n_edges) errors.add("there are {} edges, but {} numbers", n_edges, n_numbered);
    }
}

void check_faces(const TetMesh& mesh, Errors& errors) {
    for (HalffaceHandle hf : mesh.halffaces()) {
        const HalffaceHandle other = mesh.opposite_halfface_handle(hf);
        if (!other.is_valid()) continue;
        if (mesh.combination(hf) != mesh.combination(other))
            errors.add("cells {} and {} disagree on the sets of their common face", hf.idx() / 4,
                       other.idx() / 4);
        if (mesh.has_faces() && mesh.face_handle(hf) != mesh.face_handle(other))
            errors.add("cells {} and {} disagree on the number of their common face", hf.idx() / 4,
                       other.idx() / 4);
    }
    if (!mesh.has_faces()) return;
    std::size_t n_numbered = 0;
    for (FaceHandle f : mesh.faces()) {
        if (mesh.face_handle(mesh.halfface_handle(f, 0)) != f)
            errors.add("face {} is not where its number says", f.idx());
        ++n_numbered;
    }
    std::size_t n_faces = mesh.n_boundary_faces();
    for (HalffaceHandle hf : mesh.halffaces())
        if (mesh.opposite_halfface_handle(hf).is_valid() && hf < mesh.opposite_halfface_handle(hf)) ++n_faces;
    if (n_numbered != n_faces) errors.add("there are {} faces, but {} numbers", n_faces, n_numbered);
}

void check_properties(const TetMesh& mesh, Errors& errors) {
    const auto check = [&](EntityKind kind, std::size_t n) {
        for (const auto& property : mesh.properties(kind).all())
            if (property && property->size() != n)
                errors.add("property '{}' has {} values for {} entities", property->name(), property->size(),
                           n);
    };
    check(EntityKind::vertex, mesh.n_vertices());
    check(EntityKind::cell, mesh.n_cells());
    if (mesh.has_edges()) check(EntityKind::edge, mesh.n_edges());
    if (mesh.has_faces()) check(EntityKind::face, mesh.n_faces());
}

}  // namespace

Validation validate(const TetMesh& mesh, std::size_t max_errors) {
    Errors errors(max_errors);
    check_cells(mesh, errors);
    check_neighbors(mesh, errors);
    Validation broken = Errors(errors).take();
    if (!broken.ok()) return broken;  // nothing else can be asked of it
    check_geometry(mesh, errors);
    check_boundary_closed(mesh, errors);
    check_vertex_cells(mesh, errors);
    check_edges(mesh, errors);
    check_faces(mesh, errors);
    check_properties(mesh, errors);
    return errors.take();
}

}  // namespace maille::volmesh
