#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "volmesh/cell_exchange.hh"
#include "volmesh/error.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {
namespace {

using Index = TetMesh::Index;

/// How the last of a list move into the gaps that others leave.
class Moves {
  public:
    /// Of so many, those marked go.
    Moves(const std::vector<bool>& is_gone, std::size_t n_gone)
        : n_left_(static_cast<Index>(is_gone.size() - n_gone)), to_(n_gone, TetMesh::none) {
        Index gap = 0;
        for (std::size_t i = n_left_; i < is_gone.size(); ++i) {
            if (is_gone[i]) continue;
            while (!is_gone[gap]) ++gap;
            to_[i - n_left_] = gap++;
        }
    }

    Index n_left() const { return n_left_; }
    Index operator()(Index i) const { return i < n_left_ ? i : to_[i - n_left_]; }
    Index of_halfface(Index hf) const { return hf / 4 < n_left_ ? hf : 4 * to_[hf / 4 - n_left_] + hf % 4; }

    template <class Values>
    void apply(Values& values) const {
        if (values.empty()) return;
        for (std::size_t i = 0; i < to_.size(); ++i)
            if (to_[i] != TetMesh::none) values[to_[i]] = values[n_left_ + i];
    }
    void apply(PropertyList& properties, std::size_t n_after) const {
        if (properties.empty()) return;
        std::vector<Index> from(n_left_);
        for (Index i = 0; i < n_left_; ++i) from[i] = i;
        for (std::size_t i = 0; i < to_.size(); ++i)
            if (to_[i] != TetMesh::none) from[to_[i]] = n_left_ + static_cast<Index>(i);
        properties.for_each([&](BaseProperty& property) {
            property.gather(from);
            property.resize(n_after);
        });
    }
    std::vector<Index> take() { return std::move(to_); }

  private:
    Index n_left_;
    std::vector<Index> to_;  ///< by number, from n_left_ on
};

void resize_ids(Column<std::uint32_t>& ids, std::size_t n_left, std::size_t n) {
    if (ids.empty()) return;
    ids.grow(n_left);
    ids.resize(n, 0);
}

}  // namespace

/// An exchange step by step.
class TetMesh::Exchange {
  public:
    Exchange(TetMesh& mesh, const CellExchange& change)
        : mesh_(mesh),
          change_(change),
          n_vertices_before_(mesh.n_vertices()),
          is_gone_(mesh.n_cells()),
          is_isolated_(mesh.n_vertices()) {
        for (const CellHandle c : change.gone) is_gone_[c.idx()] = true;
    }

    ExchangedNumbers run() {
        const std::size_t n_isolated = take_out();
        Moves cells(is_gone_, change_.gone.size()), vertices(is_isolated_, n_isolated);
        move_up(cells, vertices);
        std::vector<Index> unlinked = renumber(cells, vertices);
        put_in(cells, vertices, unlinked);
        mesh_.find_pinches(mesh_.link(std::move(unlinked)));
        for (Index c = cells.n_left(); c < mesh_.n_cells(); ++c)
            mesh_.inherit_sets_from_neighbors(CellHandle(c));
        return {vertices.n_left(), cells.n_left(), vertices.take(), cells.take()};
    }

  private:
    /// Parts what stays from what goes, and returns how many vertices go. A vertex stays where a face between
    /// the two has it; where cells part into several fans at it, where any cell of these stays.
    std::size_t take_out() {
        std::vector<bool> stays(n_vertices_before_);
        for (const auto& [v, fans] : mesh_.vertex_fans_)
            for (const CellHandle c : mesh_.vc_range(VertexHandle(v)))
                if (!is_gone_[c.idx()]) {
                    stays[v] = true;
                    mesh_.vertex_cells_[v] = c.idx();
                }
        for (const CellHandle c : change_.gone)
            for (const Index beyond : mesh_.cells_[c.idx()].neighbors) {
                if (beyond == none || is_gone_[beyond / 4]) continue;
                mesh_.cells_[beyond / 4].neighbors[beyond % 4] = none;
                for (const VertexHandle v : mesh_.halfface_vertices(HalffaceHandle(beyond))) {
                    stays[v.idx()] = true;
                    mesh_.vertex_cells_[v.idx()] = beyond / 4;
                }
            }
        std::size_t n_isolated = 0;
        for (const CellHandle c : change_.gone)
            for (const Index v : mesh_.cells_[c.idx()].vertices)
                if (!stays[v] && !is_isolated_[v]) {
                    is_isolated_[v] = true;
                    ++n_isolated;
                }
        return n_isolated;
    }

    void move_up(const Moves& cells, const Moves& vertices) {
        const std::size_t n_cells = cells.n_left() + change_.cells.size(),
                          n_vertices = vertices.n_left() + change_.points.size();
        cells.apply(mesh_.cells_);
        cells.apply(mesh_.cell_rows_);
        vertices.apply(mesh_.points_);
        vertices.apply(mesh_.vertex_cells_);
        vertices.apply(mesh_.vertex_combinations_);
        cells.apply(mesh_.properties_of(EntityKind::cell), n_cells);
        vertices.apply(mesh_.properties_of(EntityKind::vertex), n_vertices);
        mesh_.cells_.grow(n_cells);
        mesh_.points_.grow(n_vertices);
        std::ranges::copy(change_.points, mesh_.points_.begin() + vertices.n_left());
        mesh_.vertex_cells_.grow(vertices.n_left());
        resize_ids(mesh_.cell_rows_, cells.n_left(), n_cells);
        resize_ids(mesh_.vertex_combinations_, vertices.n_left(), n_vertices);
        mesh_.cells_.trim();
        mesh_.points_.trim();
    }

    /// Brings what stays up to date, and returns its half-faces that have no neighbour.
    std::vector<Index> renumber(const Moves& cells, const Moves& vertices) {
        std::vector<Index> unlinked;
        for (Index c = 0; c < cells.n_left(); ++c) {
            Cell& cell = mesh_.cells_[c];
            for (Index& v : cell.vertices) v = vertices(v);
            for (int k = 0; k < 4; ++k)
                if (Index& hf = cell.neighbors[k]; hf == none)
                    unlinked.push_back(4 * c + k);
                else
                    hf = cells.of_halfface(hf);
        }
        for (Index& c : mesh_.vertex_cells_)
            if (c != none) c = cells(c);
        return unlinked;
    }

    void put_in(const Moves& cells, const Moves& vertices, std::vector<Index>& unlinked) {
        const Index first = cells.n_left(), n_vertices = static_cast<Index>(mesh_.points_.size());
        mesh_.vertex_cells_.resize(n_vertices, none);
        for (Index i = 0; i < change_.cells.size(); ++i) {
            const auto& [given, neighbors] = change_.cells[i];
            Cell& cell = mesh_.cells_[first + i];
            for (int k = 0; k < 4; ++k) {
                const bool is_old = given[k] < n_vertices_before_;
                const Index v =
                    is_old ? vertices(given[k]) : given[k] - n_vertices_before_ + vertices.n_left();
                if (is_old ? is_isolated_[given[k]] : v >= n_vertices)
                    throw std::invalid_argument(
                        fmt::format("cell {} to be put in has vertex {}, which is not there", i, given[k]));
                cell.vertices[k] = v;
                if (mesh_.vertex_cells_[v] == none) mesh_.vertex_cells_[v] = first + i;
                cell.neighbors[k] = neighbors[k] == none ? none : neighbors[k] + 4 * first;
                if (neighbors[k] == none) unlinked.push_back(4 * (first + i) + k);
            }
        }
    }

    TetMesh& mesh_;
    const CellExchange& change_;
    Index n_vertices_before_;
    std::vector<bool> is_gone_, is_isolated_;  ///< by cell; by vertex, that has no cell that stays
};

ExchangedNumbers TetMesh::exchange_cells(const CellExchange& change) {
    if (has_deleted()) throw std::logic_error("cells cannot be exchanged before deleted ones are collected");
    const std::size_t n = n_cells() - change.gone.size() + change.cells.size();
    if (n >= none / 8)
        throw InputError(fmt::format("a mesh of {} cells is too large: at most {} fit", n, none / 8 - 1));
    release_edges();
    release_faces();
    members_.forget();
    return Exchange(*this, change).run();
}

}  // namespace maille::volmesh
