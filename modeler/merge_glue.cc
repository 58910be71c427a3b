#include "modeler/merge_glue.hh"

#include <algorithm>
#include <bit>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "modeler/merge_verify.hh"
#include "modeler/point_index.hh"
#include "modeler/triple.hh"
#include "volmesh/cell_exchange.hh"
#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

using volmesh::CellHandle;
using volmesh::HalffaceHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

constexpr std::uint32_t unnumbered = 0xffffffff;

struct NamedTriple {
    Triple vertices;
    std::uint32_t surface;
};

/// Numbers the kept cells one after another, in little memory.
class KeptNumbers {
  public:
    KeptNumbers(const std::vector<std::uint8_t>& kept, std::uint32_t first)
        : blocks_((kept.size() + 63) / 64) {
        std::uint32_t next = first;
        for (std::size_t c = 0; c < kept.size(); ++c) {
            Block& block = blocks_[c / 64];
            if (c % 64 == 0) block.first = next;
            block.marks |= std::uint64_t{kept[c]} << c % 64;
            next += kept[c];
        }
    }
    /// Nothing where the cell is not kept.
    std::optional<std::uint32_t> find(std::uint32_t c) const {
        const Block& block = blocks_[c / 64];
        const std::uint64_t from_here = block.marks << (63 - c % 64);
        if (from_here >> 63U == 0) return std::nullopt;
        return block.first + static_cast<std::uint32_t>(std::popcount(from_here)) - 1;
    }

  private:
    struct Block {
        std::uint64_t marks = 0;  ///< bit by cell: whether it is kept
        std::uint32_t first = 0;  ///< number of its first kept cell
    };
    std::vector<Block> blocks_;
};

/// The base, of which the most cells are kept, is edited. Until that is done, its vertices have the numbers
/// that they had and further ones are numbered on from these.
class Gluer {
  public:
    Gluer(std::span<Operand> operands, std::span<const KeptPart> kept, bool may_take_mesh)
        : base_(static_cast<std::uint32_t>(std::ranges::max_element(kept, {}, &KeptPart::n_cells) -
                                           kept.begin())),
          base_part_(kept[base_]) {
        if (TetMesh& mesh = operands[base_].mesh; base_part_.n_cells > 0)
            merged_.mesh = may_take_mesh ? std::exchange(mesh, {}) : mesh;
        n_base_vertices_ = merged_.mesh.n_vertices();
        n_base_cells_ = merged_.mesh.n_cells();
        for (const HalffaceHandle side : base_part_.sides)
            for (const VertexHandle v : merged_.mesh.halfface_vertices(side))
                places_.insert(merged_.mesh.point(v), v.idx());
        for (std::uint32_t i = 0; i < operands.size(); ++i)
            if (i != base_ && kept[i].n_cells > 0) add_kept(i, operands[i].mesh, kept[i]);
    }

    void add_new(const ComplexMesh& mesh, const FacetComplex& bounds, std::uint32_t shell_surface) {
        std::vector<std::uint32_t> numbers(mesh.points.size(), unnumbered);
        const auto number = [&](std::uint32_t v) {
            if (numbers[v] == unnumbered) {
                // Only the surface's vertices can be those of kept cells.
                if (v < bounds.points.size())
                    numbers[v] = number_at(mesh.points[v]);
                else
                    numbers[v] = add_point(mesh.points[v]);
            }
            return numbers[v];
        };
        const auto first = static_cast<std::uint32_t>(4 * cells_.size());
        for (TetMesh::Cell cell : linked_cells(mesh)) {
            for (std::uint32_t& v : cell.vertices) v = number(v);
            for (std::uint32_t& hf : cell.neighbors)
                if (hf != TetMesh::none) hf += first;
            cells_.push_back(cell);
        }
        for (const Region region : mesh.regions)
            merged_.regions_of_new.push_back(static_cast<std::uint32_t>(region));
        for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
            const auto& [i, j, k] = mesh.facets[f];
            const std::uint32_t surface = bounds.facets[mesh.parents[f]].surface;
            if (surface != shell_surface) faces_.push_back({{number(i), number(j), number(k)}, surface});
        }
    }

    /// The interface's facets with nothing new on either side.
    void add_kept_interface(const FacetComplex& zone) {
        for (const Facet& facet : zone.facets) {
            if (facet.front >= 0 || facet.back >= 0) continue;
            Triple vertices{};
            for (int k = 0; k < 3; ++k) vertices[k] = number_at(zone.points[facet.vertices[k]]);
            faces_.push_back({vertices, facet.surface});
        }
    }

    Merged finish() {
        volmesh::ExchangedNumbers numbers =
            merged_.mesh.exchange_cells({n_base_cells_ > 0 ? base_part_.gone : std::vector<CellHandle>{},
                                         std::move(points_), std::move(cells_)});
        for (const NamedTriple& face : faces_)
            merged_.faces.push_back({face_of(face, numbers), face.surface});
        std::ranges::sort(merged_.faces, {}, &InterfaceFace::face);
        const std::vector<HalffaceHandle> all_seams = seams(numbers);
        merged_.kept_cells.base = merged_.kept_vertices.base = base_;
        merged_.kept_cells.n_base = numbers.n_cells;
        merged_.kept_cells.moved = std::move(numbers.cells);
        merged_.kept_vertices.n_base = numbers.n_vertices;
        merged_.kept_vertices.moved = std::move(numbers.vertices);
        verify(merged_, all_seams);
        return std::move(merged_);
    }

  private:
    /// The kept cells of another operand than the base, and how they lie beside each other.
    void add_kept(std::uint32_t operand, const TetMesh& mesh, const KeptPart& part) {
        std::vector<bool> may_meet_others(mesh.n_vertices());
        for (const HalffaceHandle side : part.sides)
            for (const VertexHandle v : mesh.halfface_vertices(side)) may_meet_others[v.idx()] = true;
        const KeptNumbers cell_numbers(part.is_kept, static_cast<std::uint32_t>(cells_.size()));
        const auto number_beyond = [&](HalffaceHandle face) {
            const auto cell = cell_numbers.find(TetMesh::incident_cell(face).idx());
            return cell ? TetMesh::halfface(CellHandle(*cell), TetMesh::local_face(face)).idx()
                        : TetMesh::none;
        };
        auto next = static_cast<std::uint32_t>(cells_.size());
        cells_.grow(cells_.size() + part.n_cells);
        std::vector<std::uint32_t> numbers(mesh.n_vertices(), unnumbered);
        for (const CellHandle c : mesh.cells()) {
            if (!part.is_kept[c.idx()]) continue;
            TetMesh::Cell& cell = cells_[next++];
            for (int k = 0; k < 4; ++k) {
                const VertexHandle v = mesh.cell_vertex(c, k);
                if (numbers[v.idx()] == unnumbered) {
                    const Eigen::Vector3d& p = mesh.point(v);
                    numbers[v.idx()] = may_meet_others[v.idx()] ? number_at(p) : add_point(p);
                    if (merged_.kept_vertices.further.size() < points_.size())
                        merged_.kept_vertices.further.push_back({operand, v.idx()});
                }
                cell.vertices[k] = numbers[v.idx()];
                const HalffaceHandle beyond = mesh.opposite_halfface_handle(TetMesh::halfface(c, k));
                cell.neighbors[k] = beyond.is_valid() ? number_beyond(beyond) : TetMesh::none;
            }
            merged_.kept_cells.further.push_back({operand, c.idx()});
        }
        for (const HalffaceHandle side : part.sides) further_sides_.push_back(number_beyond(side));
    }

    HalffaceHandle face_of(const NamedTriple& named, const volmesh::ExchangedNumbers& numbers) const {
        const auto vertex = [&](int k) {
            const std::uint32_t v = named.vertices[k];
            return VertexHandle(v < n_base_vertices_ ? numbers.vertex(v)
                                                     : v - n_base_vertices_ + numbers.n_vertices);
        };
        const HalffaceHandle found = merged_.mesh.find_halfface(vertex(0), vertex(1), vertex(2));
        if (!found.is_valid()) {
            const Eigen::Vector3d& p = merged_.mesh.point(vertex(0));
            throw InputError(
                fmt::format("a triangle of the surface near ({:.6g}, {:.6g}, {:.6g}) is no face of the mesh",
                            p.x(), p.y(), p.z()));
        }
        const HalffaceHandle other = merged_.mesh.opposite_halfface_handle(found);
        return other.is_valid() ? std::min(found, other) : found;
    }

    std::vector<HalffaceHandle> seams(const volmesh::ExchangedNumbers& numbers) const {
        std::vector<HalffaceHandle> seams;
        for (const HalffaceHandle side : base_part_.sides)
            seams.push_back(TetMesh::halfface(CellHandle(numbers.cell(TetMesh::incident_cell(side).idx())),
                                              TetMesh::local_face(side)));
        for (const std::uint32_t side : further_sides_) seams.emplace_back(4 * numbers.n_cells + side);
        return seams;
    }

    std::uint32_t add_point(const Eigen::Vector3d& p) {
        points_.push_back(p);
        return n_base_vertices_ + static_cast<std::uint32_t>(points_.size() - 1);
    }
    std::uint32_t number_at(const Eigen::Vector3d& p) {
        const auto next = n_base_vertices_ + static_cast<std::uint32_t>(points_.size());
        const std::uint32_t number = places_.insert(p, next);
        return number == next ? add_point(p) : number;
    }

    std::uint32_t base_;  ///< operand
    const KeptPart& base_part_;
    std::uint32_t n_base_vertices_, n_base_cells_;
    Merged merged_;
    std::vector<Eigen::Vector3d> points_;  ///< further ones than the base's
    volmesh::Column<TetMesh::Cell> cells_;
    std::vector<std::uint32_t> further_sides_;  ///< half-faces of `cells_`
    std::vector<NamedTriple> faces_;
    PointIndex places_;
};

}  // namespace

FacetComplex bounds_of_new_cells(const FacetComplex& zone) {
    FacetComplex bounds;
    std::vector<std::uint32_t> numbers(zone.points.size(), unnumbered);
    for (const Facet& facet : zone.facets) {
        if (facet.front < 0 && facet.back < 0) continue;
        bounds.facets.push_back(facet);
        for (std::uint32_t& v : bounds.facets.back().vertices) {
            if (numbers[v] == unnumbered) {
                numbers[v] = static_cast<std::uint32_t>(bounds.points.size());
                bounds.points.push_back(zone.points[v]);
            }
            v = numbers[v];
        }
    }
    return bounds;
}

Merged glue(std::span<Operand> operands, std::span<const KeptPart> kept, const FacetComplex& zone,
            const FacetComplex& bounds, const ComplexMesh& new_cells, std::uint32_t shell_surface,
            bool may_take_mesh) {
    Gluer gluer(operands, kept, may_take_mesh);
    gluer.add_new(new_cells, bounds, shell_surface);
    gluer.add_kept_interface(zone);
    return gluer.finish();
}

}  // namespace maille::modeler
