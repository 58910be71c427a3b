#include "volmesh/renumber.hh"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>
#include <tbb/parallel_sort.h>

namespace maille::volmesh {
namespace {

using Index = TetMesh::Index;

constexpr int bits = 21;  // three times that fit in 64

template <class H, class PlaceOf>
std::vector<H> along_curve(const std::vector<H>& handles, const Eigen::AlignedBox3d& box,
                           const PlaceOf& place_of) {
    std::vector<H> sorted;
    sorted.reserve(handles.size());
    for (const Index i :
         order_along_curve(handles.size(), box, [&](Index h) { return place_of(handles[h]); }))
        sorted.push_back(handles[i]);
    return sorted;
}

template <class H>
std::vector<Index> new_indices(std::size_t n, const std::vector<H>& olds) {
    std::vector<Index> news(n, TetMesh::none);
    for (std::size_t i = 0; i < olds.size(); ++i) news[olds[i].idx()] = static_cast<Index>(i);
    return news;
}

}  // namespace

std::uint64_t hilbert_index(const Point& place) {
    constexpr std::uint32_t n = 1U << bits;
    std::array<std::uint32_t, 3> x;
    for (int k = 0; k < 3; ++k)
        x[k] = static_cast<std::uint32_t>(std::clamp(std::floor(place[k] * n), 0.0, double{n - 1}));
    // Undo the curve's turns, from the coarsest cells to the finest.
    for (std::uint32_t q = n / 2; q > 1; q /= 2) {
        const std::uint32_t lower = q - 1;
        for (std::uint32_t& coordinate : x) {
            if ((coordinate & q) != 0) {
                x[0] ^= lower;
            } else {
                const std::uint32_t swapped = (x[0] ^ coordinate) & lower;
                x[0] ^= swapped;
                coordinate ^= swapped;
            }
        }
    }
    // Gray code.
    x[1] ^= x[0];
    x[2] ^= x[1];
    std::uint32_t flip = 0;
    for (std::uint32_t q = n / 2; q > 1; q /= 2)
        if ((x[2] & q) != 0) flip ^= q - 1;
    std::uint64_t index = 0;
    for (int bit = bits - 1; bit >= 0; --bit)
        for (std::uint32_t coordinate : x) index = index << 1U | ((coordinate ^ flip) >> bit & 1U);
    return index;
}

std::vector<Index> order_along_curve(std::size_t n, const Eigen::AlignedBox3d& box,
                                     const std::function<Point(Index)>& place_of) {
    const double size = n == 0 ? 1 : std::max(box.sizes().maxCoeff(), 1e-300);
    std::vector<std::pair<std::uint64_t, Index>> keys(n);
    for (Index i = 0; i < n; ++i) keys[i] = {hilbert_index((place_of(i) - box.min()) / size), i};
    tbb::parallel_sort(keys.begin(), keys.end());
    std::vector<Index> order(n);
    std::ranges::transform(keys, order.begin(), [](const auto& key) { return key.second; });
    return order;
}

IndexMaps renumber(TetMesh& mesh) {
    std::vector<VertexHandle> vertices;
    std::vector<CellHandle> cells;
    Eigen::AlignedBox3d box;
    for (const VertexHandle v : mesh.vertices()) {
        vertices.push_back(v);
        box.extend(mesh.point(v));
    }
    for (const CellHandle c : mesh.cells()) cells.push_back(c);
    vertices = along_curve(vertices, box, [&](VertexHandle v) { return mesh.point(v); });
    cells = along_curve(cells, box, [&](CellHandle c) {
        const auto p = mesh.cell_points(c);
        return Point((p[0] + p[1] + p[2] + p[3]) / 4);
    });

    TetMesh sorted = mesh.taken(vertices, cells);
    IndexMaps maps;
    maps.vertices = new_indices(mesh.n_vertices(), vertices);
    maps.cells = new_indices(mesh.n_cells(), cells);
    if (mesh.has_edges()) {
        std::vector<EdgeHandle> olds;
        for (const EdgeHandle e : sorted.edges()) {
            const auto [c, local] = sorted.edge_place(e);
            olds.push_back(mesh.edge_handle(cells[c.idx()], local));
        }
        maps.edges = new_indices(mesh.n_edges(), olds);
    }
    if (mesh.has_faces()) {
        std::vector<FaceHandle> olds;
        for (const FaceHandle f : sorted.faces()) {
            const HalffaceHandle hf = sorted.halfface_handle(f, 0);
            const CellHandle old_cell = cells[TetMesh::incident_cell(hf).idx()];
            olds.push_back(mesh.face_handle(TetMesh::halfface(old_cell, TetMesh::local_face(hf))));
        }
        maps.faces = new_indices(mesh.n_faces(), olds);
    }
    mesh = std::move(sorted);
    return maps;
}

}  // namespace maille::volmesh
