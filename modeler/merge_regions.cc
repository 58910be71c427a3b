#include "modeler/merge_regions.hh"

#include <algorithm>

#include <fmt/core.h>

#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

using volmesh::CellHandle;
using volmesh::HalffaceHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

constexpr std::uint32_t unnumbered = 0xffffffff;

/// Half-faces on the surfaces of regions, one of each face, ascending.
std::vector<HalffaceHandle> surface_faces(const TetMesh& mesh) {
    std::vector<HalffaceHandle> faces;
    for (const HalffaceHandle face : mesh.halffaces()) {
        const HalffaceHandle beyond = mesh.opposite_halfface_handle(face);
        if ((!beyond.is_valid() || face < beyond) && is_on_surface(mesh, face)) faces.push_back(face);
    }
    return faces;
}

double mean_edge(const ClosedSurface& surface) {
    double sum = 0;
    for (const auto& t : surface.triangles)
        for (int k = 0; k < 3; ++k) sum += (surface.points[t[k]] - surface.points[t[(k + 1) % 3]]).norm();
    return sum / (3 * static_cast<double>(surface.triangles.size()));
}

/// Makes the operands of one mesh.
class Taker {
  public:
    Taker(const TetMesh& mesh, std::uint32_t number, double size, MeshRegions& result)
        : mesh_(mesh), number_(number), size_(size), result_(result), faces_(surface_faces(mesh)) {
        patches_ = planar_patches(mesh, faces_);
        first_surface_ = static_cast<std::uint32_t>(result.surfaces.size());
        for (std::size_t i = 0; i < patches_.planes.size(); ++i)
            result.surfaces.push_back({number, patches_.planes[i], patches_.examples[i]});
    }

    /// Adds them, and returns the tree of them all.
    CsgTree take() {
        std::vector<std::vector<CellHandle>> regions;
        std::vector<std::uint32_t> region_of;  // by combination of sets
        for (const CellHandle c : mesh_.cells()) {
            const volmesh::CombinationId sets = mesh_.combination(c);
            if (sets >= region_of.size()) region_of.resize(sets + 1, unnumbered);
            if (region_of[sets] == unnumbered) {
                region_of[sets] = static_cast<std::uint32_t>(regions.size());
                regions.emplace_back();
            }
            regions[region_of[sets]].push_back(c);
        }
        CsgTree tree{Operation::fragment, 0, {}};
        for (auto& cells : regions) {
            tree.children.push_back(
                {Operation::leaf, static_cast<std::uint32_t>(result_.operands.size()), {}});
            add_region(std::move(cells));
        }
        return tree;
    }

  private:
    void add_region(std::vector<CellHandle> cells) {
        Operand operand;
        MeshRegion region{number_, std::move(cells), {}};
        std::vector<std::uint32_t> numbers(mesh_.n_vertices(), unnumbered);
        const auto number = [&](VertexHandle v) {
            if (numbers[v.idx()] == unnumbered) {
                numbers[v.idx()] = static_cast<std::uint32_t>(region.vertices.size());
                region.vertices.push_back(v);
            }
            return numbers[v.idx()];
        };
        for (const CellHandle c : region.cells)
            for (int k = 0; k < 4; ++k)
                if (const HalffaceHandle face = TetMesh::halfface(c, k); is_on_surface(mesh_, face)) {
                    const auto v = mesh_.halfface_vertices(face);
                    operand.surface.triangles.push_back({number(v[0]), number(v[1]), number(v[2])});
                    operand.surface.surfaces.push_back(surface_of(face));
                }
        for (const VertexHandle v : region.vertices) operand.surface.points.push_back(mesh_.point(v));
        operand.mesh = without_sets(region, number);
        operand.name = fmt::format("mesh {}", number_ + 1);
        operand.size = size_ > 0 ? size_ : mean_edge(operand.surface);
        result_.operands.push_back(std::move(operand));
        result_.regions.push_back(std::move(region));
    }

    /// The region's cells, their vertices numbered.
    template <class Number>
    TetMesh without_sets(const MeshRegion& region, const Number& number) const {
        std::vector<std::uint32_t> cell_numbers(mesh_.n_cells(), unnumbered);
        volmesh::Column<TetMesh::Cell> cells;
        cells.grow(region.cells.size());
        for (std::uint32_t i = 0; i < region.cells.size(); ++i) {
            cell_numbers[region.cells[i].idx()] = i;
            for (int k = 0; k < 4; ++k) cells[i].vertices[k] = number(mesh_.cell_vertex(region.cells[i], k));
        }
        for (std::uint32_t i = 0; i < region.cells.size(); ++i)
            for (int k = 0; k < 4; ++k) {
                const HalffaceHandle beyond =
                    mesh_.opposite_halfface_handle(TetMesh::halfface(region.cells[i], k));
                std::uint32_t& neighbor = cells[i].neighbors[k] = TetMesh::none;
                if (!beyond.is_valid()) continue;
                if (const std::uint32_t c = cell_numbers[TetMesh::incident_cell(beyond).idx()];
                    c != unnumbered)
                    neighbor = TetMesh::halfface(CellHandle(c), TetMesh::local_face(beyond)).idx();
            }
        std::vector<Eigen::Vector3d> points;
        for (const VertexHandle v : region.vertices) points.push_back(mesh_.point(v));
        return TetMesh::from_linked_cells(std::move(points), std::move(cells));
    }

    std::uint32_t surface_of(HalffaceHandle face) const {
        const HalffaceHandle beyond = mesh_.opposite_halfface_handle(face);
        const HalffaceHandle known = beyond.is_valid() ? std::min(face, beyond) : face;
        const auto place = std::ranges::lower_bound(faces_, known) - faces_.begin();
        return first_surface_ + patches_.patch_of_face[static_cast<std::size_t>(place)];
    }

    const TetMesh& mesh_;
    std::uint32_t number_;
    double size_;
    MeshRegions& result_;
    std::vector<HalffaceHandle> faces_;
    PlanarPatches patches_;
    std::uint32_t first_surface_ = 0;
};

CsgTree with_regions(const CsgTree& tree, const std::vector<CsgTree>& regions_of_mesh) {
    if (tree.operation == Operation::leaf) {
        if (tree.primitive >= regions_of_mesh.size())
            throw InputError(fmt::format("the tree names mesh {}, but there are {}", tree.primitive + 1,
                                         regions_of_mesh.size()));
        return regions_of_mesh[tree.primitive];
    }
    CsgTree result{tree.operation, 0, {}};
    for (const CsgTree& child : tree.children)
        result.children.push_back(with_regions(child, regions_of_mesh));
    return result;
}

}  // namespace

bool is_on_surface(const TetMesh& mesh, HalffaceHandle face) {
    const HalffaceHandle beyond = mesh.opposite_halfface_handle(face);
    return !beyond.is_valid() ||
           mesh.combination(TetMesh::incident_cell(face)) != mesh.combination(TetMesh::incident_cell(beyond));
}

MeshRegions take_apart(std::span<const TetMesh> meshes, const CsgTree& tree, double size) {
    MeshRegions result;
    std::vector<CsgTree> regions_of_mesh;
    for (std::uint32_t i = 0; i < meshes.size(); ++i) {
        if (meshes[i].cells().empty()) throw InputError(fmt::format("mesh {} has no cells", i + 1));
        regions_of_mesh.push_back(Taker(meshes[i], i, size, result).take());
    }
    result.tree = with_regions(tree, regions_of_mesh);
    return result;
}

}  // namespace maille::modeler
