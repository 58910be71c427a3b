#include "modeler/merge_touch.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "modeler/merge_contact.hh"
#include "volmesh/union_find.hh"

namespace maille::modeler {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using volmesh::CellHandle;
using volmesh::HalffaceHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

template <std::size_t N>
AlignedBox3d box_of(const std::array<Vector3d, N>& points) {
    AlignedBox3d box;
    for (const Vector3d& p : points) box.extend(p);
    return box;
}

std::vector<AlignedBox3d> boxes_of_facets(const FacetComplex& interface) {
    std::vector<AlignedBox3d> boxes(interface.facets.size());
    for (std::uint32_t f = 0; f < boxes.size(); ++f) boxes[f] = box_of(facet_points(interface, f));
    return boxes;
}

AlignedBox3d box_of(const ClosedSurface& surface) {
    AlignedBox3d box;
    for (const Vector3d& p : surface.points) box.extend(p);
    return box;
}

/// The cell that has the place, by steps from cell to cell towards it; nothing where they end at the boundary
/// before.
std::optional<CellHandle> walk(const TetMesh& mesh, CellHandle start, const Vector3d& place) {
    const int most_steps = 100 + 20 * static_cast<int>(std::cbrt(mesh.n_cells()));
    HalffaceHandle entered;
    CellHandle c = start;
    for (int step = 0; step < most_steps; ++step) {
        bool is_inside = true;
        HalffaceHandle beyond;
        for (int k = 0; k < 4 && !beyond.is_valid(); ++k) {
            const HalffaceHandle face = TetMesh::halfface(c, k);
            if (face == entered) continue;
            const auto [p, q, r] = face_points(mesh, face);
            if ((q - p).cross(r - p).dot(place - p) <= 0) continue;
            is_inside = false;
            beyond = mesh.opposite_halfface_handle(face);
        }
        if (is_inside) return c;
        if (!beyond.is_valid()) return std::nullopt;
        entered = beyond;
        c = TetMesh::incident_cell(beyond);
    }
    return std::nullopt;
}

}  // namespace

/// Finds the touched cells of one mesh.
class TouchFinder::Search {
  public:
    Search(const TouchFinder& finder, std::uint32_t operand)
        : finder_(finder),
          operand_(operand),
          mesh_(finder.operands_[operand].mesh),
          is_own_(finder.interface_.facets.size()),
          states_(mesh_.n_cells(), State::unknown) {}

    TouchedCells touched() {
        test_boundary();
        if (!enter_pieces())
            for (const CellHandle c : mesh_.cells()) test(c);
        return spread();
    }

  private:
    enum class State : std::uint8_t { unknown, untouched, touched };

    void test_boundary() {
        std::vector<std::optional<std::uint32_t>> corners;
        for (const Vector3d& p : finder_.operands_[operand_].surface.points)
            corners.push_back(finder_.table_.vertex(p));
        for (const HalffaceHandle face : mesh_.boundary_halffaces()) {
            result_.boundary.push_back(face);
            const auto [a, b, c] = mesh_.halfface_vertices(face);
            const auto &i = corners[a.idx()], &j = corners[b.idx()], &k = corners[c.idx()];
            if (const auto facet = i && j && k ? finder_.table_.facet(Triple{*i, *j, *k}) : std::nullopt)
                is_own_[*facet] = 1;
            else
                touch(TetMesh::incident_cell(face));
        }
        for (const HalffaceHandle face : result_.boundary) test(TetMesh::incident_cell(face));
    }

    /// Tests a cell where each piece lies inside. False where none is found.
    bool enter_pieces() {
        const AlignedBox3d box = box_of(finder_.operands_[operand_].surface);
        return std::ranges::all_of(finder_.pieces_, [&](const Piece& piece) {
            if (!box.contains(piece.box) || !std::ranges::binary_search(piece.inside, operand_)) return true;
            const auto found = walk(mesh_, boundary_cell_near(piece.point), piece.point);
            return found && test(*found);
        });
    }

    CellHandle boundary_cell_near(const Vector3d& place) const {
        const auto near = std::ranges::min(result_.boundary, {}, [&](HalffaceHandle face) {
            return (mesh_.point(mesh_.cell_vertex(TetMesh::incident_cell(face), 0)) - place).squaredNorm();
        });
        return TetMesh::incident_cell(near);
    }

    TouchedCells spread() {
        result_.vertices.resize(mesh_.n_vertices());
        std::vector<bool> is_near(mesh_.n_cells());
        for (std::size_t i = 0; i < result_.cells.size(); ++i)
            for (const VertexHandle v : mesh_.cell_vertices(result_.cells[i])) {
                if (std::exchange(result_.vertices[v.idx()], 1)) continue;
                for (const CellHandle c : mesh_.vc_range(v)) {
                    test(c);
                    if (is_near[c.idx()]) continue;
                    is_near[c.idx()] = true;
                    result_.near.push_back(c);
                }
            }
        return std::move(result_);
    }

    /// Whether the cell is touched.
    bool test(CellHandle c) {
        if (states_[c.idx()] == State::unknown) {
            states_[c.idx()] = State::untouched;
            if (is_near_foreign_facet(mesh_.cell_points(c))) touch(c);
        }
        return states_[c.idx()] == State::touched;
    }

    bool is_near_foreign_facet(const std::array<Vector3d, 4>& cell) const {
        const double margin = finder_.margin_;
        const AlignedBox3d box = box_of(cell);
        const AlignedBox3d reach(box.min().array() - margin, box.max().array() + margin);
        return !finder_.boxes_.visit_box(reach, [&](std::uint32_t f) {
            return is_own_[f] || !may_touch(cell, facet_points(finder_.interface_, f), margin);
        });
    }

    void touch(CellHandle c) {
        if (std::exchange(states_[c.idx()], State::touched) != State::touched) result_.cells.push_back(c);
    }

    const TouchFinder& finder_;
    std::uint32_t operand_;
    const TetMesh& mesh_;
    std::vector<std::uint8_t> is_own_;  ///< by facet: whether it is a boundary face of the mesh
    std::vector<State> states_;         ///< by cell
    TouchedCells result_;
};

TouchFinder::TouchFinder(std::span<const Operand> operands, const SolidClassifier& classifier,
                         const FacetComplex& interface, const InterfaceTable& table)
    : operands_(operands), interface_(interface), table_(table), boxes_(boxes_of_facets(interface)) {
    AlignedBox3d all;
    for (const Operand& operand : operands) all.extend(box_of(operand.surface));
    // Somewhat more than the arrangement moves points when it welds.
    margin_ = 4e-9 * all.diagonal().norm();
    find_pieces(classifier);
}

void TouchFinder::find_pieces(const SolidClassifier& classifier) {
    volmesh::UnionFind joined(interface_.points.size());
    for (const Facet& facet : interface_.facets)
        for (int k = 1; k < 3; ++k) joined.unite(facet.vertices[0], facet.vertices[k]);
    std::vector<std::uint32_t> piece_at(interface_.points.size());
    for (std::uint32_t v = 0; v < interface_.points.size(); ++v) {
        const Vector3d& p = interface_.points[v];
        const std::uint32_t first = joined.find(v);
        if (first == v) {
            piece_at[v] = static_cast<std::uint32_t>(pieces_.size());
            pieces_.push_back({p, {}, classifier.locate(p).inside});
        }
        pieces_[piece_at[first]].box.extend(p);
    }
}

TouchedCells TouchFinder::find(std::uint32_t operand) const {
    if (operands_[operand].mesh.n_cells() == 0) return {};
    return Search(*this, operand).touched();
}

}  // namespace maille::modeler
