#include "modeler/merge_zone.hh"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <unsupported/Eigen/BVH>

#include <Eigen/Geometry>

#include "modeler/arrange_classifier.hh"
#include "modeler/merge_contact.hh"
#include "modeler/point_index.hh"
#include "modeler/triple.hh"

namespace maille::modeler {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using volmesh::CellHandle;
using volmesh::HalffaceHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

using BoxTree = Eigen::KdBVH<double, 3, std::uint32_t>;

/// The facets of an interface, to be found by the points of a triangle.
class InterfaceTable {
  public:
    explicit InterfaceTable(const FacetComplex& interface) {
        points_.reserve(interface.points.size());
        for (std::uint32_t v = 0; v < interface.points.size(); ++v) points_.insert(interface.points[v], v);
        facets_.reserve(interface.facets.size());
        for (std::uint32_t f = 0; f < interface.facets.size(); ++f)
            facets_.emplace(sorted(interface.facets[f].vertices), f);
    }
    std::optional<Triple> vertices(const std::array<Vector3d, 3>& triangle) const {
        Triple result{};
        for (int k = 0; k < 3; ++k) {
            const auto found = points_.find(triangle[k]);
            if (!found) return std::nullopt;
            result[k] = *found;
        }
        return result;
    }
    std::optional<std::uint32_t> facet(const std::array<Vector3d, 3>& triangle) const {
        const auto corners = vertices(triangle);
        const auto found = corners ? facets_.find(sorted(*corners)) : facets_.end();
        return found == facets_.end() ? std::nullopt : std::optional(found->second);
    }

  private:
    PointIndex points_;
    std::unordered_map<Triple, std::uint32_t, TripleHash> facets_;
};

std::array<Vector3d, 3> face_points(const TetMesh& mesh, HalffaceHandle face) {
    std::array<Vector3d, 3> points;
    const auto vertices = mesh.halfface_vertices(face);
    for (int k = 0; k < 3; ++k) points[k] = mesh.point(vertices[k]);
    return points;
}

std::array<Vector3d, 3> facet_points(const FacetComplex& complex, std::uint32_t facet) {
    const auto& [a, b, c] = complex.facets[facet].vertices;
    return {complex.points[a], complex.points[b], complex.points[c]};
}

template <std::size_t N>
AlignedBox3d box_of(const std::array<Vector3d, N>& points) {
    AlignedBox3d box;
    for (const Vector3d& p : points) box.extend(p);
    return box;
}

/// Asks a tree of the interface's facets for any that may touch a cell.
struct ContactQuery {
    const FacetComplex& interface;
    const std::vector<std::uint8_t>& is_own;
    const std::array<Vector3d, 4>& cell;
    AlignedBox3d reach;
    double margin;
    bool found = false;

    bool intersectVolume(const AlignedBox3d& box) const { return reach.intersects(box); }
    bool intersectObject(std::uint32_t facet) {
        found = !is_own[facet] && may_touch(cell, facet_points(interface, facet), margin);
        return found;
    }
};

class Chooser {
  public:
    Chooser(std::span<const Operand> operands, const CsgTree& tree, const FacetComplex& interface)
        : operands_(operands),
          tree_(tree),
          interface_(interface),
          table_(interface),
          classifier_(surfaces(operands)) {
        std::vector<std::uint32_t> numbers(interface.facets.size());
        std::vector<AlignedBox3d> boxes(interface.facets.size());
        AlignedBox3d all;
        for (std::uint32_t f = 0; f < numbers.size(); ++f) {
            numbers[f] = f;
            boxes[f] = box_of(facet_points(interface, f));
        }
        for (const Operand& operand : operands)
            for (const Vector3d& p : operand.surface.points) all.extend(p);
        boxes_ = BoxTree(numbers.begin(), numbers.end(), boxes.begin(), boxes.end());
        // Somewhat more than the arrangement moves points when it welds.
        margin_ = 4e-9 * all.diagonal().norm();
    }

    std::vector<std::uint8_t> choose(std::uint32_t operand) const {
        const TetMesh& mesh = operands_[operand].mesh;
        std::vector<std::uint8_t> touched = touched_cells(mesh);
        std::vector<std::uint8_t> kept = owned_cells(operand, touched);
        std::vector<std::uint8_t> at_touched(mesh.n_vertices());
        for (const CellHandle c : mesh.cells())
            if (touched[c.idx()])
                for (const VertexHandle v : mesh.cell_vertices(c)) at_touched[v.idx()] = 1;
        for (const CellHandle c : mesh.cells())
            for (const VertexHandle v : mesh.cell_vertices(c))
                if (at_touched[v.idx()]) kept[c.idx()] = 0;
        return kept;
    }

  private:
    static std::vector<ClosedSurface> surfaces(std::span<const Operand> operands) {
        std::vector<ClosedSurface> result;
        for (const Operand& operand : operands) result.push_back(operand.surface);
        return result;
    }

    std::vector<std::uint8_t> touched_cells(const TetMesh& mesh) const {
        std::vector<std::uint8_t> touched(mesh.n_cells());
        std::vector<std::uint8_t> is_own(interface_.facets.size());
        for (const HalffaceHandle face : mesh.boundary_halffaces()) {
            if (const auto facet = table_.facet(face_points(mesh, face)))
                is_own[*facet] = 1;
            else
                touched[TetMesh::incident_cell(face).idx()] = 1;
        }
        for (const CellHandle c : mesh.cells()) {
            if (touched[c.idx()]) continue;
            const std::array<Vector3d, 4> cell = mesh.cell_points(c);
            AlignedBox3d reach = box_of(cell);
            reach = {reach.min().array() - margin_, reach.max().array() + margin_};
            ContactQuery query{interface_, is_own, cell, reach, margin_};
            Eigen::BVIntersect(boxes_, query);
            touched[c.idx()] = query.found;
        }
        return touched;
    }

    /// Untouched cells that hang together lie in one region: one query tells which.
    std::vector<std::uint8_t> owned_cells(std::uint32_t operand,
                                          const std::vector<std::uint8_t>& touched) const {
        const TetMesh& mesh = operands_[operand].mesh;
        std::vector<std::uint8_t> owned(mesh.n_cells()), seen = touched;
        for (const CellHandle start : mesh.cells()) {
            if (seen[start.idx()]) continue;
            std::vector<CellHandle> component{start};
            seen[start.idx()] = 1;
            for (std::size_t i = 0; i < component.size(); ++i) {
                for (int k = 0; k < 4; ++k) {
                    const HalffaceHandle beyond =
                        mesh.opposite_halfface_handle(TetMesh::halfface(component[i], k));
                    if (!beyond.is_valid()) continue;
                    const CellHandle next = TetMesh::incident_cell(beyond);
                    if (!std::exchange(seen[next.idx()], 1)) component.push_back(next);
                }
            }
            const bool is_owned = owner_at(mesh.cell_points(start)) == operand;
            for (const CellHandle c : component) owned[c.idx()] = is_owned;
        }
        return owned;
    }

    std::optional<std::uint32_t> owner_at(const std::array<Vector3d, 4>& cell) const {
        const Containment place = classifier_.locate((cell[0] + cell[1] + cell[2] + cell[3]) / 4);
        return owner(tree_, [&](std::uint32_t i) { return std::ranges::binary_search(place.inside, i); });
    }

    std::span<const Operand> operands_;
    const CsgTree& tree_;
    const FacetComplex& interface_;
    InterfaceTable table_;
    SolidClassifier classifier_;
    BoxTree boxes_;
    double margin_;
};

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
        for (const CellHandle c : mesh.cells()) {
            if (!kept[i][c.idx()]) continue;
            for (int k = 0; k < 4; ++k) {
                const HalffaceHandle face = TetMesh::halfface(c, k);
                const HalffaceHandle beyond = mesh.opposite_halfface_handle(face);
                if (!beyond.is_valid() || !kept[i][TetMesh::incident_cell(beyond).idx()])
                    builder.add_kept_side(static_cast<Region>(i), face_points(mesh, face));
            }
        }
    }
    return builder.take();
}

}  // namespace maille::modeler
