#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "refine/simplex_tree.hh"
#include "refine/size_field.hh"
#include "volmesh/error.hh"

namespace maille::refine {
namespace {

using volmesh::TetMesh;
using volmesh::VertexHandle;

std::vector<double> sizes_at_vertices(const SizeField& size, const TetMesh& mesh) {
    std::vector<double> sizes(mesh.n_vertices());
    tbb::parallel_for(std::size_t{0}, sizes.size(), [&](std::size_t i) {
        const VertexHandle v(static_cast<std::uint32_t>(i));
        if (!mesh.is_deleted(v)) sizes[i] = size(mesh.point(v));
    });
    return sizes;
}

/// The vertices from which the size grows too fast along some edge.
std::vector<VertexHandle> find_sources(const TetMesh& mesh, std::span<const double> sizes, double growth) {
    std::vector<std::uint8_t> is_source(mesh.n_vertices());
    for (const auto c : mesh.cells())
        for (const auto& [i, j] : volmesh::tet::edge_vertices) {
            VertexHandle low = mesh.cell_vertex(c, i), high = mesh.cell_vertex(c, j);
            if (sizes[low.idx()] > sizes[high.idx()]) std::swap(low, high);
            const double allowed = growth * (mesh.point(low) - mesh.point(high)).norm();
            if (sizes[high.idx()] - sizes[low.idx()] > allowed) is_source[low.idx()] = 1;
        }
    std::vector<VertexHandle> sources;
    for (std::uint32_t i = 0; i < is_source.size(); ++i)
        if (is_source[i] != 0) sources.emplace_back(i);
    return sources;
}

/// Sources of about one size, in a tree of their own: from so far off that its least size has grown too large
/// none of them counts.
struct Sources {
    SimplexTree points;
    std::vector<double> sizes;
    double least;
};

std::vector<Sources> by_size(const TetMesh& mesh, std::span<const VertexHandle> sources,
                             std::span<const double> sizes) {
    std::map<int, std::vector<VertexHandle>> classes;
    for (const VertexHandle v : sources)
        classes[static_cast<int>(std::floor(4 * std::log2(sizes[v.idx()])))].push_back(v);
    std::vector<Sources> groups;
    for (const auto& [size_class, members] : classes) {
        std::vector<Simplex> points;
        std::vector<double> own;
        for (const VertexHandle v : members) {
            points.push_back({{mesh.point(v)}, 1});
            own.push_back(sizes[v.idx()]);
        }
        const double least = *std::ranges::min_element(own);
        groups.push_back({SimplexTree(std::move(points)), std::move(own), least});
    }
    return groups;
}

}  // namespace

SizeField limit_growth(const SizeField& size, const TetMesh& mesh, double growth) {
    if (!(growth > 0) || !std::isfinite(growth))
        throw InputError(fmt::format("the gradation must be positive, not {}", growth));
    const std::vector<double> sizes = sizes_at_vertices(size, mesh);
    const auto groups =
        std::make_shared<const std::vector<Sources>>(by_size(mesh, find_sources(mesh, sizes, growth), sizes));
    return SizeField(
        [size, groups, growth](const Point& p) {
            double limited = size(p);
            for (const auto& [points, own, least] : *groups) {
                if (least >= limited) continue;
                const double nearest = points.least(
                    p, [&](double distance) { return least + growth * distance; },
                    [&](std::uint32_t source) {
                        return own[source] + growth * (p - points[source].corners[0]).norm();
                    });
                limited = std::min(limited, nearest);
            }
            return limited;
        },
        "the size with limited growth");
}

}  // namespace maille::refine
