#include "quality/mean_moves.hh"

#include <algorithm>
#include <atomic>
#include <bit>
#include <span>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "volmesh/cell_table.hh"
#include "volmesh/strata.hh"

namespace maille::quality {
namespace {

using volmesh::CellHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;
using VertexCells = volmesh::CellTable<VertexHandle>;
using Cells = std::span<const CellHandle>;
using Shapes = boost::container::small_vector<Shape, 48>;

/// How the sum of beta bends on a line, for each cell, the shortest edge being 1: by experience nearly always
/// within a factor of 1.6. It gives the first step, the sum there the bend for a better one.
constexpr double usual_bend = 0.3;
/// Longest step, in lengths of the shortest edge.
constexpr double longest_step = 0.3;
/// A slope on which the sum would rise by less than this over the shortest edge isn't worth a step.
constexpr double least_slope = 1e-2;

/// By vertex, 1 where it is on no interface and in no set, nor on an edge that is in one.
std::vector<std::uint8_t> free_vertices(const TetMesh& mesh) {
    std::vector<std::uint8_t> is_free(mesh.n_vertices(), 1);
    const auto bind = [&](VertexHandle v) {
        std::atomic_ref(is_free[v.idx()]).store(0, std::memory_order_relaxed);
    };
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, mesh.n_cells(), 4096), [&](const auto& range) {
        for (std::uint32_t i = range.begin(); i < range.end(); ++i) {
            const CellHandle c(i);
            if (mesh.is_deleted(c)) continue;
            for (int f = 0; f < 4; ++f) {
                const auto hf = TetMesh::halfface(c, f);
                if (volmesh::is_interface(mesh, hf)) std::ranges::for_each(mesh.halfface_vertices(hf), bind);
            }
            for (int e = 0; e < 6; ++e) {
                if (mesh.combination(c, e) == 0) continue;
                for (const int end : volmesh::tet::edge_vertices[e]) bind(mesh.cell_vertex(c, end));
            }
        }
    });
    for (std::uint32_t i = 0; i < mesh.n_vertices(); ++i)
        if (mesh.combination(VertexHandle(i)) != 0) is_free[i] = 0;
    return is_free;
}

/// The vertices in groups, no two of one group with a cell in common but in the last group, which is for the
/// few that have too many neighbours.
std::vector<std::vector<VertexHandle>> independent_groups(const TetMesh& mesh, const VertexCells& cells_of,
                                                          const std::vector<std::uint8_t>& is_wanted) {
    constexpr std::uint8_t none = 65;
    std::vector<std::uint8_t> group_of(mesh.n_vertices(), none);
    std::vector<std::vector<VertexHandle>> groups(65);
    for (std::uint32_t i = 0; i < mesh.n_vertices(); ++i) {
        if (is_wanted[i] == 0) continue;
        std::uint64_t taken = 0;
        for (const CellHandle c : cells_of[VertexHandle(i)])
            for (const std::uint32_t w : mesh.cell_vertex_indices()[c.idx()])
                if (group_of[w] < 64) taken |= std::uint64_t{1} << group_of[w];
        group_of[i] = static_cast<std::uint8_t>(std::countr_one(taken));
        groups[group_of[i]].emplace_back(i);
    }
    return groups;
}

/// A vertex among its cells.
class Climb {
  public:
    Climb(TetMesh& mesh, VertexHandle v, Cells cells, std::vector<Shape>& shapes, double good_enough,
          const SizeLimit& limit)
        : mesh_(mesh),
          v_(v),
          cells_(cells),
          shapes_(shapes),
          limit_(limit),
          start_(mesh.point(v)),
          floor_(good_enough) {
        for (const CellHandle c : cells) {
            const auto face = mesh.halfface_vertices(TetMesh::halfface(c, mesh.local_vertex(c, v)));
            bases_.push_back({mesh.point(face[0]), mesh.point(face[1]), mesh.point(face[2])});
            floor_ = std::min(floor_, shapes[c.idx()].objective);
            before_ += shapes[c.idx()].beta;
        }
    }

    /// Returns whether the vertex moved.
    bool run() {
        Point slope = Point::Zero();
        double reach = std::numeric_limits<double>::infinity();
        for (const Base& base : bases_) {
            slope += beta_slope(start_, base).gradient;
            for (const Point& q : base) reach = std::min(reach, (q - start_).squaredNorm());
        }
        reach = std::sqrt(reach);
        const double steepness = slope.norm();
        if (!(steepness * reach > least_slope)) return false;
        const Point direction = slope / steepness;
        const double n_cells = static_cast<double>(cells_.size());
        double step = std::min(longest_step * reach, steepness * reach * reach / (2 * usual_bend * n_cells));
        for (int trial = 0; trial < 3; ++trial) {
            const std::optional<double> gain = try_at(start_ + step * direction);
            if (!gain) {
                if (is_better_) break;
                step *= 0.3;
                continue;
            }
            // The top of the parabola through what is known.
            const double bend = (steepness * step - *gain) / (step * step);
            if (!(bend > 0)) break;
            const double best = std::min(steepness / (2 * bend), 2 * step);
            const bool is_near = best > 0.7 * step && best < 1.4 * step;
            if (is_better_ && (is_near || trial > 0)) break;
            step = best;
        }
        if (!is_better_) return false;
        mesh_.set_point(v_, place_);
        for (std::size_t k = 0; k < cells_.size(); ++k) shapes_[cells_[k].idx()] = best_[k];
        return true;
    }

  private:
    /// By how much the sum would rise; nothing where the vertex may not be there. Keeps the best place.
    std::optional<double> try_at(const Point& p) {
        tried_.clear();
        double sum = 0;
        for (const Base& base : bases_) {
            tried_.push_back(shape(p, base[0], base[1], base[2]));
            if (!(tried_.back().objective > floor_)) return std::nullopt;
            sum += tried_.back().beta;
        }
        if (!keeps_size(p)) return std::nullopt;
        const double gain = sum - before_;
        if (gain > best_gain_) {
            best_gain_ = gain;
            place_ = p;
            best_.swap(tried_);
            is_better_ = true;
        }
        return gain;
    }

    bool keeps_size(const Point& p) const {
        if (!limit_.exists()) return true;
        double before = 1;
        double after = 1;
        for (const Base& base : bases_)
            after = std::max(after, limit_.excess({p, base[0], base[1], base[2]}));
        if (after <= 1) return true;
        for (const Base& base : bases_)
            before = std::max(before, limit_.excess({start_, base[0], base[1], base[2]}));
        return after <= before;
    }

    TetMesh& mesh_;
    VertexHandle v_;
    Cells cells_;
    std::vector<Shape>& shapes_;
    const SizeLimit& limit_;
    Bases bases_;
    Point start_, place_;
    double floor_;
    double before_ = 0;
    double best_gain_ = 0;
    bool is_better_ = false;
    Shapes tried_, best_;
};

}  // namespace

std::size_t move_for_mean(TetMesh& mesh, std::vector<Shape>& shapes, double good_enough,
                          const SizeLimit& limit) {
    const VertexCells cells_of = volmesh::vertex_cells(mesh);
    std::atomic<std::size_t> n_moves = 0;
    const auto groups = independent_groups(mesh, cells_of, free_vertices(mesh));
    for (const auto& group : groups) {
        const std::size_t grain = &group == &groups.back() ? group.size() + 1 : 256;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, group.size(), grain), [&](const auto& range) {
            std::size_t n = 0;
            for (std::size_t i = range.begin(); i < range.end(); ++i)
                n += Climb(mesh, group[i], cells_of[group[i]], shapes, good_enough, limit).run();
            n_moves += n;
        });
    }
    return n_moves;
}

}  // namespace maille::quality
