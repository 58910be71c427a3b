#include "quality/mean_moves.hh"

#include <algorithm>
#include <atomic>
#include <bit>
#include <limits>
#include <span>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "quality/smooth.hh"
#include "volmesh/cell_table.hh"

namespace maille::quality {
namespace {

using volmesh::CellHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;
using VertexCells = volmesh::CellTable<VertexHandle>;
using Cells = std::span<const CellHandle>;

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

/// Moves a vertex that may go anywhere, if that is worth while; returns whether it was.
bool move(TetMesh& mesh, VertexHandle v, Cells cells, std::vector<Shape>& shapes, const SizeLimit& limit) {
    Bases bases;
    double floor = std::numeric_limits<double>::infinity();
    for (const CellHandle c : cells) {
        const auto face = mesh.halfface_vertices(TetMesh::halfface(c, mesh.local_vertex(c, v)));
        bases.push_back({mesh.point(face[0]), mesh.point(face[1]), mesh.point(face[2])});
        floor = std::min(floor, shapes[c.idx()].objective);
    }
    const Point start = mesh.point(v);
    const auto keeps_size = [&](const Point& p) { return limit.keeps(bases, start, p); };
    const Freedom anywhere;
    const auto found = higher_place(bases, start, floor, Constraint(anywhere, start, nullptr), keeps_size);
    if (!found) return false;
    mesh.set_point(v, found->point);
    for (std::size_t k = 0; k < cells.size(); ++k) shapes[cells[k].idx()] = found->shapes[k];
    return true;
}

}  // namespace

std::size_t move_for_mean(TetMesh& mesh, std::vector<Shape>& shapes, const SizeLimit& limit,
                          const std::vector<std::uint8_t>& is_free) {
    const VertexCells cells_of = volmesh::vertex_cells(mesh);
    std::atomic<std::size_t> n_moves = 0;
    const auto groups = independent_groups(mesh, cells_of, is_free);
    for (const auto& group : groups) {
        const std::size_t grain = &group == &groups.back() ? group.size() + 1 : 256;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, group.size(), grain), [&](const auto& range) {
            std::size_t n = 0;
            for (std::size_t i = range.begin(); i < range.end(); ++i)
                n += move(mesh, group[i], cells_of[group[i]], shapes, limit);
            n_moves += n;
        });
    }
    return n_moves;
}

}  // namespace maille::quality
