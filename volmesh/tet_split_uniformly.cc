#include "volmesh/tet_split_uniformly.hh"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "volmesh/error.hh"

namespace maille::volmesh {
namespace {

template <class Action>
void for_each_index(std::size_t n, const Action& action) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 512), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) action(static_cast<std::uint32_t>(i));
    });
}

/// The diagonal that leaves the best worst child, by mean ratio. All have the same volume, so that counts by
/// the sum of the squared edges, and of this all that depends on the diagonal is compared here: a child has
/// twice the diagonal, once as its edge, and a half of one of the two edges that the diagonal joins.
int best_diagonal(const std::array<Point, 4>& p) {
    const auto square = [&](int d) {
        const auto [a, b] = tet::edge_vertices[d];
        const auto [c, e] = tet::edge_vertices[tet::opposite_edge(d)];
        return 1.5 * (p[a] + p[b] - p[c] - p[e]).squaredNorm() +
               std::max((p[a] - p[b]).squaredNorm(), (p[c] - p[e]).squaredNorm());
    };
    const std::array squares{square(0), square(1), square(2)};
    return static_cast<int>(std::ranges::min_element(squares) - squares.begin());
}

}  // namespace

std::vector<std::array<VertexHandle, 2>> TetMesh::split_uniformly() {
    if (has_deleted())
        throw InputError("the mesh has deleted entities: collect them (garbage_collection) first");
    if (n_cells() >= none / 64)
        throw InputError(
            fmt::format("eight cells for each of {} are too many: at most {} fit", n_cells(), none / 8 - 1));
    return UniformSplit(*this).run();
}

TetMesh::UniformSplit::UniformSplit(TetMesh& mesh)
    : mesh_(mesh), n_vertices_(mesh.n_vertices()), n_cells_(mesh.n_cells()), has_edges_(mesh.has_edges()) {
    mesh_.request_edges();
    n_edges_ = mesh_.n_edges();
    ends_.resize(n_edges_);
    for_each_index(n_edges_, [&](Index e) { ends_[e] = mesh_.edge_vertices(EdgeHandle(e)); });
    diagonals_.grow(n_cells_);
    for_each_index(n_cells_, [&](Index c) {
        diagonals_[c] = static_cast<std::uint8_t>(best_diagonal(mesh_.cell_points(CellHandle(c))));
    });
}

std::vector<std::array<VertexHandle, 2>> TetMesh::UniformSplit::run() {
    pass_on_vertex_sets();
    pass_on_rows();
    add_middles();
    mesh_.n_boundary_ *= 4;
    Column<Cell> parents;
    parents.swap(mesh_.cells_);
    mesh_.cells_.grow(8 * std::size_t{n_cells_});
    for_each_index(n_cells_, [&](Index c) { divide(c, parents); });
    for_each_index(n_vertices_, [&](Index v) {
        Index& cell = mesh_.vertex_cells_[v];
        if (cell != none) cell = 8 * cell + local(parents[cell], v);
    });
    pass_on_cell_values();
    if (mesh_.faces_) divide_faces(parents);
    if (has_edges_)
        divide_edges(parents);
    else
        mesh_.edges_.reset();
    if (!mesh_.vertex_fans_.empty() || !mesh_.edge_fans_.empty()) mesh_.find_pinches(mesh_.boundary_sides());
    apply_custom_rules();
    return std::move(ends_);
}

void TetMesh::UniformSplit::add_middles() {
    mesh_.points_.grow(std::size_t{n_vertices_} + n_edges_);
    mesh_.vertex_cells_.grow(std::size_t{n_vertices_} + n_edges_);
    for_each_index(n_edges_, [&](Index e) {
        const auto [a, b] = ends_[e];
        mesh_.points_[n_vertices_ + e] = 0.5 * mesh_.point(a) + 0.5 * mesh_.point(b);
        const auto [c, local_edge] = mesh_.edge_place(EdgeHandle(e));
        mesh_.vertex_cells_[n_vertices_ + e] = 8 * c.idx() + tet::edge_vertices[local_edge][0];
    });
    mesh_.properties_of(EntityKind::vertex).for_each([&](BaseProperty& property) {
        property.resize(mesh_.points_.size());
        for (Index e = 0; e < n_edges_; ++e) {
            const auto [a, b] = ends_[e];
            property.set_between(n_vertices_ + e, a.idx(), b.idx(), 0.5);
        }
    });
}

/// The eight children of a cell and what they are to each other and to the neighbours' children.
void TetMesh::UniformSplit::divide(Index c, const Column<Cell>& parents) {
    const tet::Octasection& cut = section(c);
    const Cell& parent = parents[c];
    const auto& edges = mesh_.edges_->of_cell[c];
    std::array<Index, 10> nodes;
    std::ranges::copy(parent.vertices, nodes.begin());
    for (int e = 0; e < 6; ++e) nodes[4 + e] = n_vertices_ + edges[e];
    for (int child = 0; child < 8; ++child) {
        Cell& cell = mesh_.cells_[8 * c + child];
        for (int i = 0; i < 4; ++i) cell.vertices[i] = nodes[cut.nodes[child][i]];
        for (int f = 0; f < 4; ++f) {
            const int face = cut.outer[child][f];
            if (face == tet::Octasection::no_face)
                cell.neighbors[f] = 32 * c + cut.inner[child][f];
            else
                cell.neighbors[f] = beyond(parent, child, face, parents);
        }
    }
}

/// The half-face opposite that of a child on a face of its parent.
TetMesh::Index TetMesh::UniformSplit::beyond(const Cell& parent, int child, int face,
                                             const Column<Cell>& parents) const {
    const Index opposite = parent.neighbors[face];
    if (opposite == none) return none;
    const Index other = opposite / 4;
    if (child >= 4) return 32 * other + section(other).middle[opposite % 4];
    return 4 * (8 * other + local(parents[other], parent.vertices[child])) + opposite % 4;
}

}  // namespace maille::volmesh
