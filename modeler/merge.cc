#include "modeler/merge.hh"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "modeler/merge_operand.hh"
#include "modeler/merge_planes.hh"
#include "modeler/merge_regions.hh"
#include "modeler/merge_sets.hh"
#include "modeler/phase_timer.hh"
#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

RemeshGeometry planar_geometry(const MeshRegions& regions) {
    std::vector<Plane> planes;
    for (const MeshSurface& surface : regions.surfaces) planes.push_back(surface.plane);
    std::vector<double> sizes;
    for (const Operand& operand : regions.operands) sizes.push_back(operand.size);
    return {
        .project =
            [planes](std::span<const std::uint32_t> surfaces, const Eigen::Vector3d& p) {
                std::vector<Plane> wanted;
                for (const std::uint32_t surface : surfaces) wanted.push_back(planes[surface]);
                return nearest_on_planes(wanted, p);
            },
        .normal = [planes](std::uint32_t surface, const Eigen::Vector3d&) { return planes[surface].normal; },
        .planar = [](std::uint32_t) { return true; },
        .size =
            [sizes, largest = std::ranges::max(sizes)](const Eigen::Vector3d&, Region front, Region back) {
                double size = largest;
                for (const Region region : {front, back})
                    if (region >= 0) size = std::min(size, sizes[region]);
                return size;
            }};
}

}  // namespace

volmesh::TetMesh merge(std::span<const volmesh::TetMesh> meshes, const CsgTree& tree,
                       const MergeOptions& options, BuildReport* report) {
    BuildReport unwanted;
    BuildReport& told = report != nullptr ? *report : unwanted;
    const PhaseTimer timer(told.merge);
    if (meshes.empty()) throw InputError("there are no meshes to merge");
    if (options.size < 0) throw InputError(fmt::format("the size has to be positive, not {}", options.size));
    MeshRegions regions = take_apart(meshes, tree, options.size);
    Merged merged = merge_operands(
        regions.operands, regions.tree, planar_geometry(regions),
        static_cast<std::uint32_t>(regions.surfaces.size()),
        {.keep_cells = options.keep_cells, .time_limit = options.time_limit, .may_take_mesh = true},
        told.warnings);
    told.kept_cells = merged.kept_cells.size();
    told.new_cells = merged.mesh.n_cells() - told.kept_cells;
    carry_sets_over(meshes, regions, merged);
    return std::move(merged.mesh);
}

}  // namespace maille::modeler
