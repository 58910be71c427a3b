#include "modeler/merge_zone.hh"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "modeler/arrange_classifier.hh"
#include "modeler/merge_interface.hh"
#include "modeler/merge_touch.hh"

namespace maille::modeler {
namespace {

using Eigen::Vector3d;
using volmesh::CellHandle;
using volmesh::HalffaceHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

class Chooser {
  public:
    Chooser(std::span<const Operand> operands, const CsgTree& tree, const FacetComplex& interface)
        : operands_(operands),
          tree_(tree),
          table_(interface),
          classifier_(surfaces(operands)),
          touch_(operands, classifier_, interface, table_) {}

    std::vector<std::uint8_t> choose(std::uint32_t operand) const {
        const TetMesh& mesh = operands_[operand].mesh;
        const TouchedCells touched = touch_.find(operand);
        std::vector<std::uint8_t> kept(mesh.n_cells(), 1);
        remove_foreign(operand, touched, kept);
        for (const CellHandle c : touched.near) kept[c.idx()] = 0;
        return kept;
    }

  private:
    static std::vector<ClosedSurface> surfaces(std::span<const Operand> operands) {
        std::vector<ClosedSurface> result;
        for (const Operand& operand : operands) result.push_back(operand.surface);
        return result;
    }

    /// Takes out what lies in other regions. Untouched cells that hang together lie in one: one query tells
    /// which. It is asked where they border on others or on the outside, and only cells that have to go are
    /// visited beyond.
    void remove_foreign(std::uint32_t operand, const TouchedCells& touched,
                        std::vector<std::uint8_t>& kept) const {
        const TetMesh& mesh = operands_[operand].mesh;
        std::vector<std::uint8_t> seen(mesh.n_cells()), is_at_rim(mesh.n_cells());
        for (const CellHandle c : touched.cells) seen[c.idx()] = 1;
        const std::vector<CellHandle> rim = rim_cells(operand, touched);
        for (const CellHandle c : rim) is_at_rim[c.idx()] = 1;
        for (const CellHandle start : rim) {
            if (std::exchange(seen[start.idx()], 1)) continue;
            const bool is_owned = owner_at(mesh.cell_points(start)) == operand;
            std::vector<CellHandle> component{start};
            for (std::size_t i = 0; i < component.size(); ++i) {
                kept[component[i].idx()] = is_owned;
                for (const CellHandle next : mesh.cc_range(component[i]))
                    if ((!is_owned || is_at_rim[next.idx()]) && !std::exchange(seen[next.idx()], 1))
                        component.push_back(next);
            }
        }
    }

    /// The cells at vertices of no touched cell that are on the mesh's surface or beside touched cells. Some
    /// are in every part that hangs together and has such a vertex.
    std::vector<CellHandle> rim_cells(std::uint32_t operand, const TouchedCells& touched) const {
        const Operand& of = operands_[operand];
        std::vector<std::uint8_t> is_done = touched.vertices;
        std::vector<CellHandle> cells;
        const auto add_cells_at = [&](VertexHandle v) {
            if (!std::exchange(is_done[v.idx()], 1))
                std::ranges::copy(of.mesh.vc_range(v), std::back_inserter(cells));
        };
        for (const CellHandle c : touched.near) std::ranges::for_each(of.mesh.cell_vertices(c), add_cells_at);
        for (std::uint32_t v = 0; v < is_done.size() && v < of.surface.points.size(); ++v)
            add_cells_at(VertexHandle(v));
        return cells;
    }

    std::optional<std::uint32_t> owner_at(const std::array<Vector3d, 4>& cell) const {
        const Containment place = classifier_.locate((cell[0] + cell[1] + cell[2] + cell[3]) / 4);
        return owner(tree_, [&](std::uint32_t i) { return std::ranges::binary_search(place.inside, i); });
    }

    std::span<const Operand> operands_;
    const CsgTree& tree_;
    InterfaceTable table_;
    SolidClassifier classifier_;
    TouchFinder touch_;
};

/// The faces between kept cells and others or nothing, seen from the kept ones, ascending.
std::vector<HalffaceHandle> sides_of_kept(const TetMesh& mesh, const std::vector<std::uint8_t>& kept) {
    std::vector<HalffaceHandle> sides;
    for (const HalffaceHandle face : mesh.boundary_halffaces())
        if (kept[TetMesh::incident_cell(face).idx()]) sides.push_back(face);
    for (std::uint32_t c = 0; c < kept.size(); ++c) {
        if (kept[c]) continue;
        for (int k = 0; k < 4; ++k) {
            const HalffaceHandle beyond = mesh.opposite_halfface_handle(TetMesh::halfface(CellHandle(c), k));
            if (beyond.is_valid() && kept[TetMesh::incident_cell(beyond).idx()]) sides.push_back(beyond);
        }
    }
    std::ranges::sort(sides);
    return sides;
}

/// Adds the points of faces to a complex, each place once.
class ZoneBuilder {
  public:
    ZoneBuilder(const FacetComplex& interface, std::uint32_t shell_surface)
        : complex_(interface), table_(interface), shell_surface_(shell_surface) {
        for (std::uint32_t v = 0; v < interface.points.size(); ++v) points_.insert(interface.points[v], v);
    }

    /// A face between a kept cell of the operand and what isn't one, seen from outside the cell.
    void add_kept_side(Region operand, const std::array<Vector3d, 3>& face) {
        if (const auto number = table_.facet(face)) {
            Facet& facet = complex_.facets[*number];
            facet.frozen = true;
            (same_turn(facet.vertices, *table_.vertices(face)) ? facet.back : facet.front) = kept_part;
            return;
        }
        Facet facet{{}, shell_surface_, operand, kept_part, true};
        for (int k = 0; k < 3; ++k) {
            const auto next = static_cast<std::uint32_t>(complex_.points.size());
            facet.vertices[k] = points_.insert(face[k], next);
            if (facet.vertices[k] == next) complex_.points.push_back(face[k]);
        }
        complex_.facets.push_back(facet);
    }

    FacetComplex take() { return std::move(complex_); }

  private:
    FacetComplex complex_;
    InterfaceTable table_;
    PointIndex points_;
    std::uint32_t shell_surface_;
};

}  // namespace

KeptCells choose_kept_cells(std::span<const Operand> operands, const CsgTree& tree,
                            const FacetComplex& interface) {
    const Chooser chooser(operands, tree, interface);
    KeptCells kept;
    for (std::uint32_t i = 0; i < operands.size(); ++i) kept.push_back(chooser.choose(i));
    return kept;
}

FacetComplex zone_complex(std::span<const Operand> operands, const KeptCells& kept,
                          const FacetComplex& interface, std::uint32_t shell_surface) {
    ZoneBuilder builder(interface, shell_surface);
    for (std::uint32_t i = 0; i < operands.size(); ++i) {
        const TetMesh& mesh = operands[i].mesh;
        for (const HalffaceHandle face : sides_of_kept(mesh, kept[i]))
            builder.add_kept_side(static_cast<Region>(i), face_points(mesh, face));
    }
    return builder.take();
}

}  // namespace maille::modeler
