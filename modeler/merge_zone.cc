#include "modeler/merge_zone.hh"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "modeler/arrange_classifier.hh"
#include "modeler/merge_interface.hh"
#include "modeler/merge_touch.hh"
#include "volmesh/union_find.hh"

namespace maille::modeler {
namespace {

using Eigen::Vector3d;
using volmesh::CellHandle;
using volmesh::HalffaceHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

class Chooser {
  public:
    Chooser(std::span<const Operand> operands, const CsgTree& tree, const FacetComplex& interface,
            const InterfaceTable& table)
        : operands_(operands),
          tree_(tree),
          classifier_(surfaces(operands)),
          touch_(operands, classifier_, interface, table) {}

    KeptPart choose(std::uint32_t operand) const {
        const TetMesh& mesh = operands_[operand].mesh;
        const TouchedCells touched = touch_.find(operand);
        KeptPart part;
        part.is_kept.assign(mesh.n_cells(), 1);
        remove_foreign(operand, touched, part.is_kept);
        for (const CellHandle c : touched.near) part.is_kept[c.idx()] = 0;
        for (std::uint32_t c = 0; c < part.is_kept.size(); ++c)
            if (!part.is_kept[c]) part.gone.emplace_back(c);
        part.n_cells = mesh.n_cells() - part.gone.size();
        for (const HalffaceHandle face : touched.boundary)
            if (part.is_kept[TetMesh::incident_cell(face).idx()]) part.sides.push_back(face);
        for (const CellHandle c : part.gone)
            for (int k = 0; k < 4; ++k) {
                const HalffaceHandle beyond = mesh.opposite_halfface_handle(TetMesh::halfface(c, k));
                if (beyond.is_valid() && part.is_kept[TetMesh::incident_cell(beyond).idx()])
                    part.sides.push_back(beyond);
            }
        std::ranges::sort(part.sides);
        return part;
    }

  private:
    static std::vector<ClosedSurface> surfaces(std::span<const Operand> operands) {
        std::vector<ClosedSurface> result;
        for (const Operand& operand : operands) result.push_back(operand.surface);
        return result;
    }

    /// Takes out what lies in other regions. Untouched cells that hang together lie in one: one query tells
    /// which. It is asked where they border on touched ones, and only cells that have to go are visited
    /// beyond.
    void remove_foreign(std::uint32_t operand, const TouchedCells& touched,
                        std::vector<std::uint8_t>& is_kept) const {
        const TetMesh& mesh = operands_[operand].mesh;
        std::vector<bool> seen(mesh.n_cells()), is_at_rim(mesh.n_cells());
        for (const CellHandle c : touched.cells) seen[c.idx()] = true;
        const std::vector<CellHandle> rim = rim_cells(operand, touched);
        for (const CellHandle c : rim) is_at_rim[c.idx()] = true;
        for (const CellHandle start : rim) {
            if (seen[start.idx()]) continue;
            seen[start.idx()] = true;
            const bool is_owned = owner_at(mesh.cell_points(start)) == operand;
            std::vector<CellHandle> component{start};
            for (std::size_t i = 0; i < component.size(); ++i) {
                constexpr std::size_t ahead = 16;  // cells are scattered in memory
                if (i + ahead < component.size())
                    __builtin_prefetch(&mesh.cell_vertex_indices()[component[i + ahead].idx()]);
                is_kept[component[i].idx()] = is_owned;
                for (int k = 0; k < 4; ++k) {
                    const HalffaceHandle beyond =
                        mesh.opposite_halfface_handle(TetMesh::halfface(component[i], k));
                    if (!beyond.is_valid()) continue;
                    const CellHandle next = TetMesh::incident_cell(beyond);
                    if (seen[next.idx()] || (is_owned && !is_at_rim[next.idx()])) continue;
                    seen[next.idx()] = true;
                    component.push_back(next);
                }
            }
        }
    }

    /// Cells at vertices of no touched cell: some in every part that hangs together by faces and has such a
    /// vertex. Where a part borders on touched cells, it has some beside those; else it is bounded by whole
    /// components of the surface.
    std::vector<CellHandle> rim_cells(std::uint32_t operand, const TouchedCells& touched) const {
        const Operand& of = operands_[operand];
        std::vector<bool> is_done(touched.vertices.size());
        for (std::size_t v = 0; v < is_done.size(); ++v) is_done[v] = touched.vertices[v] != 0;
        std::vector<CellHandle> cells;
        const auto add_cells_at = [&](VertexHandle v) {
            if (is_done[v.idx()]) return;
            is_done[v.idx()] = true;
            std::ranges::copy(of.mesh.vc_range(v), std::back_inserter(cells));
        };
        for (const CellHandle c : touched.near) std::ranges::for_each(of.mesh.cell_vertices(c), add_cells_at);
        std::ranges::for_each(untouched_components(of.surface, touched.vertices), add_cells_at);
        return cells;
    }

    /// A vertex of each component of the surface of which no touched cell has one.
    static std::vector<VertexHandle> untouched_components(const ClosedSurface& surface,
                                                          const std::vector<std::uint8_t>& is_touched) {
        volmesh::UnionFind joined(surface.points.size());
        for (const auto& [a, b, c] : surface.triangles) {
            joined.unite(a, b);
            joined.unite(a, c);
        }
        std::vector<bool> has_touched(surface.points.size());
        for (std::uint32_t v = 0; v < has_touched.size() && v < is_touched.size(); ++v)
            if (is_touched[v]) has_touched[joined.find(v)] = true;
        std::vector<VertexHandle> vertices;
        for (std::uint32_t v = 0; v < has_touched.size() && v < is_touched.size(); ++v)
            if (joined.find(v) == v && !has_touched[v]) vertices.emplace_back(v);
        return vertices;
    }

    std::optional<std::uint32_t> owner_at(const std::array<Vector3d, 4>& cell) const {
        const Containment place = classifier_.locate((cell[0] + cell[1] + cell[2] + cell[3]) / 4);
        return owner(tree_, [&](std::uint32_t i) { return std::ranges::binary_search(place.inside, i); });
    }

    std::span<const Operand> operands_;
    const CsgTree& tree_;
    SolidClassifier classifier_;
    TouchFinder touch_;
};

/// Adds the points of faces to a complex, each place once.
class ZoneBuilder {
  public:
    ZoneBuilder(const FacetComplex& interface, const InterfaceTable& table, std::uint32_t shell_surface)
        : complex_(interface), table_(table), shell_surface_(shell_surface) {}

    /// The faces between kept cells of the operand and others or nothing.
    void add_sides(Region operand, const TetMesh& mesh, std::span<const HalffaceHandle> sides) {
        std::vector<std::uint32_t> numbers(mesh.n_vertices(), TetMesh::none);
        for (const HalffaceHandle side : sides) {
            Triple corners{};
            for (int k = 0; const VertexHandle v : mesh.halfface_vertices(side)) {
                std::uint32_t& number = numbers[v.idx()];
                if (number == TetMesh::none) number = number_at(mesh.point(v));
                corners[k++] = number;
            }
            add_side(operand, corners);
        }
    }

    FacetComplex take() { return std::move(complex_); }

  private:
    std::uint32_t number_at(const Vector3d& place) {
        if (const auto known = table_.vertex(place)) return *known;
        const auto next = static_cast<std::uint32_t>(complex_.points.size());
        const std::uint32_t number = points_.insert(place, next);
        if (number == next) complex_.points.push_back(place);
        return number;
    }

    /// Seen from outside the kept cell.
    void add_side(Region operand, const Triple& corners) {
        if (const auto number = table_.facet(corners)) {
            Facet& facet = complex_.facets[*number];
            facet.frozen = true;
            (same_turn(facet.vertices, corners) ? facet.back : facet.front) = kept_part;
        } else {
            complex_.facets.push_back({corners, shell_surface_, operand, kept_part, true});
        }
    }

    FacetComplex complex_;
    const InterfaceTable& table_;
    PointIndex points_;  ///< that are none of the interface's
    std::uint32_t shell_surface_;
};

}  // namespace

std::vector<KeptPart> choose_kept_cells(std::span<const Operand> operands, const CsgTree& tree,
                                        const FacetComplex& interface, const InterfaceTable& table) {
    const Chooser chooser(operands, tree, interface, table);
    std::vector<KeptPart> kept;
    for (std::uint32_t i = 0; i < operands.size(); ++i) kept.push_back(chooser.choose(i));
    return kept;
}

FacetComplex zone_complex(std::span<const Operand> operands, std::span<const KeptPart> kept,
                          const FacetComplex& interface, const InterfaceTable& table,
                          std::uint32_t shell_surface) {
    ZoneBuilder builder(interface, table, shell_surface);
    for (std::uint32_t i = 0; i < operands.size(); ++i)
        builder.add_sides(static_cast<Region>(i), operands[i].mesh, kept[i].sides);
    return builder.take();
}

}  // namespace maille::modeler
