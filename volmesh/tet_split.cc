#include "volmesh/tet_split.hh"

#include <algorithm>
#include <atomic>
#include <cassert>

#include <tbb/parallel_for.h>

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
    boost::container::small_vector<SplitLocals, 16> locals;
    for (CellHandle c : ring) locals.push_back(locals_of(c, a, b));
    const Split split{a,
                      b,
                      VertexHandle(n_vertices()),
                      n_cells(),
                      ratio,
                      {ring.data(), ring.size()},
                      {locals.data(), locals.size()}};
    split_all({&split, 1});
    return split.m;
}

VertexHandle TetMesh::split_edges(const EdgeStars& stars) {
    const VertexHandle first(n_vertices());
    std::vector<SplitLocals> locals(stars.n_cells());
    std::vector<Split> splits(stars.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, stars.size(), 256), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const auto [a, b] = stars.edge(i);
            const auto ring = stars.ring(i);
            const std::span place(locals.begin() + stars.begin_of(i), ring.size());
            for (std::size_t r = 0; r < ring.size(); ++r) place[r] = locals_of(ring[r], a, b);
            splits[i] = {a,
                         b,
                         VertexHandle(first.idx() + static_cast<Index>(i)),
                         n_cells() + stars.begin_of(i),
                         0.5,
                         ring,
                         place};
        }
    });
    split_all(splits);
    return first;
}

TetMesh::SplitLocals TetMesh::locals_of(CellHandle c, VertexHandle a, VertexHandle b) const {
    const int i = local_vertex(c, a);
    const int j = local_vertex(c, b);
    const auto [k, l] = tet::edge_vertices[tet::opposite_edge(tet::edge_between[i][j])];
    return {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j), k, l};
}

/// Splits edges whose rings have no cell in common. What many threads do writes to the cells of one ring at a
/// time, and new indices are known beforehand, so the result is that of one split after another.
void TetMesh::split_all(std::span<const Split> splits) {
    if (splits.empty()) return;
    const auto for_each_split = [&](const auto& action) {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, splits.size(), 64), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) action(splits[i]);
        });
    };
    const Index first_vertex = splits.front().m.idx();
    const std::vector<CombinationId> born = prepare_sets(splits);
    grow(n_vertices() + splits.size(), splits.back().new_cell(splits.back().ring.size()));
    for_each_split([&](const Split& split) {
        points_[split.m.idx()] =
            (1 - split.ratio) * points_[split.a.idx()] + split.ratio * points_[split.b.idx()];
        split_cells(split);
        if (!cell_rows_.empty()) split_sets(split);
        if (!vertex_combinations_.empty())
            vertex_combinations_[split.m.idx()] = born.empty() ? 0 : born[split.m.idx() - first_vertex];
    });
    for_each_split([&](const Split& split) { link_to_others(split, first_vertex); });

    properties_of(EntityKind::vertex).for_each([&](BaseProperty& property) {
        for (const Split& split : splits)
            property.set_between(split.m.idx(), split.a.idx(), split.b.idx(), split.ratio);
    });
    properties_of(EntityKind::cell).for_each([&](BaseProperty& property) {
        for (const Split& split : splits)
            for (std::size_t r = 0; r < split.ring.size(); ++r)
                property.set_child(split.ring[r].idx(), split.new_cell(r), split.ratio);
    });
    for (const Split& split : splits) {
        if (edges_) split_edge_numbers(split);
        if (faces_) split_face_numbers(split);
        if (!edge_fans_.empty() || !vertex_fans_.empty()) split_pinches(split);
    }
    for (const Split& split : splits) apply_custom_rules(split);
}

/// Makes room for so many vertices and cells.
void TetMesh::grow(std::size_t n_vertices, std::size_t n_cells) {
    points_.grow(n_vertices);
    vertex_cells_.grow(n_vertices);
    if (!deleted_vertices_.empty()) deleted_vertices_.resize(n_vertices, 0);
    if (!vertex_combinations_.empty()) vertex_combinations_.grow(n_vertices);
    cells_.grow(n_cells);
    if (!deleted_cells_.empty()) deleted_cells_.resize(n_cells, 0);
    if (!cell_rows_.empty()) cell_rows_.grow(n_cells);
    properties_of(EntityKind::vertex).for_each([&](BaseProperty& property) { property.resize(n_vertices); });
    properties_of(EntityKind::cell).for_each([&](BaseProperty& property) { property.resize(n_cells); });
}

/// The cells of one ring, and what they are to each other.
void TetMesh::split_cells(const Split& split) {
    const std::size_t n = split.ring.size();
    const std::atomic_ref<Index> cell_of_b(vertex_cells_[split.b.idx()]);
    vertex_cells_[split.m.idx()] = split.ring.front().idx();
    Index n_halved_boundary_faces = 0;
    for (std::size_t r = 0; r < n; ++r) {
        const Index c = split.ring[r].idx();
        const Index d = split.new_cell(r);
        const auto [a, b, k, l] = split.locals[r];
        Cell& with_a = cells_[c];
        Cell with_b = with_a;
        with_b.vertices[a] = split.m.idx();
        with_a.vertices[b] = split.m.idx();
        // Only the ring that has a vertex's cell changes it, so others read what can't be one of theirs.
        if (cell_of_b.load(std::memory_order_relaxed) == c) cell_of_b.store(d, std::memory_order_relaxed);

        for (int side : {k, l}) {
            Index& neighbor = with_b.neighbors[side];
            if (neighbor == none) {
                ++n_halved_boundary_faces;
                continue;
            }
            // The neighbour is the cell before or after in the ring, and is split alike.
            const std::size_t after = r + 1 < n ? r + 1 : 0;
            const std::size_t before = r > 0 ? r - 1 : n - 1;
            const std::size_t at = split.ring[after].idx() == neighbor / 4 ? after : before;
            assert(split.ring[at].idx() == neighbor / 4);
            neighbor = 4 * split.new_cell(at) + neighbor % 4;
        }
        with_b.neighbors[b] = 4 * c + a;
        with_a.neighbors[a] = 4 * d + b;
        cells_[d] = with_b;
    }
    if (n_halved_boundary_faces > 0)
        std::atomic_ref(n_boundary_).fetch_add(n_halved_boundary_faces, std::memory_order_relaxed);
}

/// Links the outer faces of a ring, when all rings have been split. A cell that has been split has a vertex
/// from `first_vertex` on; of its outer faces one stays with it, the one opposite that vertex, and the other
/// is now its new child's.
void TetMesh::link_to_others(const Split& split, Index first_vertex) {
    const auto is_split = [&](Index cell) {
        return std::ranges::any_of(cells_[cell].vertices, [&](Index v) { return v >= first_vertex; });
    };
    const auto moved = [&](Index halfface) {
        const Index side = halfface % 4;
        const Cell& cell = cells_[halfface / 4];
        return cell.vertices[side] >= first_vertex ? halfface : cell.neighbors[side] / 4 * 4 + side;
    };
    for (std::size_t r = 0; r < split.ring.size(); ++r) {
        const auto& local = split.locals[r];
        const Index kept = 4 * split.ring[r].idx() + local.b;
        const Index given = 4 * split.new_cell(r) + local.a;
        for (const Index own : {kept, given}) {
            Index& opposite = cells_[own / 4].neighbors[own % 4];
            if (opposite == none) continue;
            if (is_split(opposite / 4))
                opposite = moved(opposite);
            else if (own == given)
                cells_[opposite / 4].neighbors[opposite % 4] = given;
        }
    }
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
            const Index spoke = spokes(cells_[c].vertices[side]);
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
        property.resize(place.size());
        property.set_child(whole, half_of_b, split.ratio);
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
            const Index half = halves(cells_[c].vertices[side == local.k ? local.l : local.k]);
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
        property.resize(halfface.size());
        for (Index i = 0; i < wholes.size(); ++i) property.set_child(wholes[i], before + i, split.ratio);
    });
}

void TetMesh::split_pinches(const Split& split) {
    if (const auto at_b = vertex_fans_.find(split.b.idx()); at_b != vertex_fans_.end())
        for (Index& first : at_b->second) first = split.child_with_b(first);
    for (std::size_t r = 0; r < split.ring.size(); ++r)
        for (int side : {split.locals[r].k, split.locals[r].l}) {
            const Index other = cells_[split.ring[r].idx()].vertices[side];
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
