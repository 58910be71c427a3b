#include "volmesh/tet_split.hh"

#include <algorithm>
#include <cassert>

#include "volmesh/fans.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

namespace {

/// A few numbers by key, made by a counter when first asked for.
class NumberedOnce {
  public:
    explicit NumberedOnce(std::uint32_t first) : next_(first) {}
    std::uint32_t operator()(std::uint32_t key) {
        for (const auto& [known, number] : known_)
            if (known == key) return number;
        known_.emplace_back(key, next_);
        return next_++;
    }
    std::uint32_t end() const { return next_; }

  private:
    std::uint32_t next_;
    boost::container::small_vector<std::pair<std::uint32_t, std::uint32_t>, 16> known_;
};

}  // namespace

VertexHandle TetMesh::split_edge(CellHandle c, int local_edge, double ratio) {
    return split_edge(c, local_edge, ratio, cells_around(c, local_edge));
}

VertexHandle TetMesh::split_edge(CellHandle c, int local_edge, double ratio, const CellList& ring) {
    const auto [i, j] = tet::edge_vertices[local_edge];
    return split_between(cell_vertex(c, i), cell_vertex(c, j), ratio, ring);
}

VertexHandle TetMesh::split_edge(EdgeHandle e, double ratio) {
    const auto [a, b] = edge_vertices(e);
    return split_between(a, b, ratio, ec_range(e));
}

VertexHandle TetMesh::split_between(VertexHandle a, VertexHandle b, double ratio, const CellList& ring) {
    assert(ratio > 0 && ratio < 1);
    Split split{a, b, VertexHandle(n_vertices()), ratio, ring, n_cells(), {}};
    for (CellHandle c : ring) {
        const int i = local_vertex(c, a);
        const int j = local_vertex(c, b);
        const auto [k, l] = tet::edge_vertices[tet::opposite_edge(tet::edge_between[i][j])];
        split.locals.push_back({i, j, k, l});
    }

    const CombinationId born = born_combination(split);
    points_.push_back((1 - ratio) * points_[a.idx()] + ratio * points_[b.idx()]);
    vertex_cells_.push_back(ring.front().idx());
    if (!deleted_vertices_.empty()) deleted_vertices_.push_back(0);
    if (born != 0 && vertex_combinations_.empty()) vertex_combinations_.resize(points_.size() - 1, 0);
    if (born != 0 || !vertex_combinations_.empty()) vertex_combinations_.push_back(born);
    properties_of(EntityKind::vertex).for_each([&](BaseProperty& property) {
        property.push_between(a.idx(), b.idx(), ratio);
    });

    split_cells(split);
    if (edges_) split_edge_numbers(split);
    if (faces_) split_face_numbers(split);
    if (!edge_fans_.empty() || !vertex_fans_.empty()) split_pinches(split);
    if (!cell_rows_.empty()) split_sets(split);
    apply_custom_rules(split);
    return split.m;
}

void TetMesh::split_cells(const Split& split) {
    const std::size_t n = split.ring.size();
    for (std::size_t r = 0; r < n; ++r) {
        const Index c = split.ring[r].idx();
        const Index d = split.new_cell(r);
        const auto [a, b, k, l] = split.locals[r];

        std::array<Index, 4> vertices = cells_[c];
        vertices[a] = split.m.idx();
        cells_.push_back(vertices);
        cells_[c][b] = split.m.idx();

        std::array<Index, 4> neighbors = neighbors_[c];
        if (const Index beyond = neighbors[a]; beyond != none) neighbors_[beyond / 4][beyond % 4] = 4 * d + a;
        for (int side : {k, l}) {
            if (neighbors[side] == none) {
                ++n_boundary_;
                continue;
            }
            // The neighbour is the cell before or after in the ring, and is split alike.
            const Index next = neighbors[side] / 4;
            const std::size_t after = r + 1 < n ? r + 1 : 0;
            const std::size_t before = r > 0 ? r - 1 : n - 1;
            const std::size_t at = split.ring[after].idx() == next ? after : before;
            assert(split.ring[at].idx() == next);
            neighbors[side] = 4 * split.new_cell(at) + neighbors[side] % 4;
        }
        neighbors[b] = 4 * c + a;
        neighbors_.push_back(neighbors);
        neighbors_[c][a] = 4 * d + b;

        if (!deleted_cells_.empty()) deleted_cells_.push_back(0);
        properties_of(EntityKind::cell).for_each([&](BaseProperty& property) {
            property.push_child(c, split.ratio);
        });
    }
    Index& cell_of_b = vertex_cells_[split.b.idx()];
    cell_of_b = split.child_with_b(cell_of_b);
}

void TetMesh::split_edge_numbers(const Split& split) {
    auto& [of_cell, place] = *edges_;
    const auto half_of_b = static_cast<Index>(place.size());
    NumberedOnce spokes(half_of_b + 1);  // from m to each vertex round the edge
    Index whole = none;
    for (std::size_t r = 0; r < split.ring.size(); ++r) {
        const Index c = split.ring[r].idx();
        const Index d = split.new_cell(r);
        const auto& local = split.locals[r];
        whole = of_cell[c][local.edge()];
        of_cell.push_back(of_cell[c]);
        of_cell[d][local.edge()] = half_of_b;
        for (int side : {local.k, local.l}) {
            const Index spoke = spokes(cells_[c][side]);
            const int at_a = tet::edge_between[local.a][side];
            const int at_b = tet::edge_between[local.b][side];
            place[of_cell[d][at_b]] = 8 * d + at_b;
            of_cell[c][at_b] = spoke;
            of_cell[d][at_a] = spoke;
            place.resize(std::max<std::size_t>(place.size(), spokes.end()));
            place[spoke] = 8 * c + at_b;
        }
        place[half_of_b] = 8 * d + local.edge();
    }
    properties_of(EntityKind::edge).for_each([&](BaseProperty& property) {
        property.push_child(whole, split.ratio);
        property.resize(place.size());
    });
}

void TetMesh::split_face_numbers(const Split& split) {
    auto& [of_cell, halfface] = *faces_;
    const auto before = static_cast<Index>(halfface.size());
    NumberedOnce halves(before);  // of the faces at the edge, by their third vertex: the half with b
    boost::container::small_vector<Index, 16> wholes;
    for (std::size_t r = 0; r < split.ring.size(); ++r) {
        const Index c = split.ring[r].idx();
        const Index d = split.new_cell(r);
        const auto& local = split.locals[r];
        of_cell.push_back(of_cell[c]);
        for (int side : {local.k, local.l}) {
            const Index half = halves(cells_[c][side == local.k ? local.l : local.k]);
            if (half == before + wholes.size()) wholes.push_back(of_cell[c][side]);
            halfface.resize(std::max<std::size_t>(halfface.size(), halves.end()));
            of_cell[d][side] = half;
            halfface[half] = 4 * d + side;
        }
    }
    for (std::size_t r = 0; r < split.ring.size(); ++r) {
        const Index c = split.ring[r].idx();
        const Index d = split.new_cell(r);
        const auto& local = split.locals[r];
        Index& outer = halfface[of_cell[d][local.a]];
        if (outer == 4 * c + local.a) outer = 4 * d + local.a;
        of_cell[c][local.a] = of_cell[d][local.b] = static_cast<Index>(halfface.size());
        halfface.push_back(4 * c + local.a);
    }
    properties_of(EntityKind::face).for_each([&](BaseProperty& property) {
        for (Index whole : wholes) property.push_child(whole, split.ratio);
        property.resize(halfface.size());
    });
}

void TetMesh::split_pinches(const Split& split) {
    if (const auto at_b = vertex_fans_.find(split.b.idx()); at_b != vertex_fans_.end())
        for (Index& first : at_b->second) first = split.child_with_b(first);
    for (std::size_t r = 0; r < split.ring.size(); ++r)
        for (int side : {split.locals[r].k, split.locals[r].l}) {
            const Index other = cells_[split.ring[r].idx()][side];
            if (const auto fans = edge_fans_.find(edge_key(split.b.idx(), other)); fans != edge_fans_.end())
                for (Index& first : fans->second) first = split.child_with_b(first);
        }

    auto node = edge_fans_.extract(edge_key(split.a.idx(), split.b.idx()));
    if (node.empty()) return;
    const std::vector<Index> with_a = std::move(node.mapped());
    std::vector<Index> with_b;
    for (Index first : with_a) with_b.push_back(split.child_with_b(first));
    vertex_cells_[split.m.idx()] = with_a.front();
    vertex_fans_[split.m.idx()].assign(with_a.begin() + 1, with_a.end());
    edge_fans_[edge_key(split.a.idx(), split.m.idx())] = with_a;
    edge_fans_[edge_key(split.m.idx(), split.b.idx())] = std::move(with_b);
}

}  // namespace maille::volmesh
