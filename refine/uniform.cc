#include "refine/uniform.hh"

#include <array>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "quality/boundary_projection.hh"
#include "refine/stopwatch.hh"
#include "refine/threads.hh"
#include "volmesh/error.hh"

namespace maille::refine {
namespace {

void require_valid(const TetMesh& mesh, const UniformOptions& options) {
    if (options.levels < 0) throw InputError("the number of levels cannot be negative");
    quality::require_min_shape(options.min_shape);
    double cells = mesh.n_cells();
    for (int level = 0; level < options.levels; ++level) cells *= 8;
    if (cells >= TetMesh::none / 8)
        throw InputError(fmt::format("{} levels make {:.3g} cells of {}, more than the {} that fit",
                                     options.levels, cells, mesh.n_cells(), TetMesh::none / 8 - 1));
}

/// Moves vertices from `first` on to their surfaces, if there are any.
void bring_home(const TetMesh& mesh, quality::BoundaryProjection& projection, std::uint32_t first) {
    std::vector<CellHandle> cells;
    for (const auto c : mesh.cells()) cells.push_back(c);
    projection.take_up(first, cells);
    projection.run();
    if (!projection.is_done()) projection.insist();
}

/// A level of the lineage: the children of a cell follow each other.
void pass_on(Lineage& lineage, const std::vector<std::array<VertexHandle, 2>>& ends) {
    const std::vector<std::uint32_t> before = std::exchange(lineage.cell_ancestors, {});
    lineage.cell_ancestors.reserve(8 * before.size());
    for (const std::uint32_t ancestor : before)
        lineage.cell_ancestors.insert(lineage.cell_ancestors.end(), 8, ancestor);
    for (const auto& [a, b] : ends) lineage.vertex_parents.push_back({a.idx(), b.idx()});
}

RefineResult refined(TetMesh& mesh, const UniformOptions& options, const volmesh::Projector* projector) {
    RefineResult result;
    result.lineage.n_vertices_before = mesh.n_vertices();
    result.lineage.cell_ancestors.resize(mesh.n_cells());
    std::iota(result.lineage.cell_ancestors.begin(), result.lineage.cell_ancestors.end(), 0U);
    std::optional<quality::BoundaryProjection> projection;
    if (projector != nullptr && options.project) projection.emplace(mesh, *projector, options.min_shape);
    const auto project = [&](std::uint32_t first) {
        const Stopwatch watch(result.seconds.project);
        if (projection) bring_home(mesh, *projection, first);
    };
    project(0);
    while (result.iterations < options.levels) {
        const std::uint32_t first_new = mesh.n_vertices();
        const std::size_t n_refined = mesh.n_cells();
        {
            const Stopwatch watch(result.seconds.split);
            pass_on(result.lineage, mesh.split_uniformly());
        }
        project(first_new);
        ++result.iterations;
        if (options.progress) options.progress({result.iterations, n_refined, mesh.n_cells()});
    }
    result.cells = mesh.n_cells();
    result.vertices = mesh.n_vertices();
    if (projection) result.projection = {projection->n_moved(), projection->short_of_target()};
    return result;
}

}  // namespace

RefineResult refine_uniformly(TetMesh& mesh, const UniformOptions& options,
                              const volmesh::Projector* projector) {
    require_valid(mesh, options);
    RefineResult result;
    with_threads(options.threads, [&] { result = refined(mesh, options, projector); });
    return result;
}

}  // namespace maille::refine
