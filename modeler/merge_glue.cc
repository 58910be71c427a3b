#include "modeler/merge_glue.hh"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/core.h>

#include "modeler/point_index.hh"
#include "modeler/tetrahedralize_check.hh"
#include "modeler/triple.hh"
#include "volmesh/error.hh"
#include "volmesh/measure.hh"

namespace maille::modeler {
namespace {

using volmesh::CellHandle;
using volmesh::HalffaceHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

constexpr std::uint32_t unnumbered = 0xffffffff;
constexpr std::array unlinked{TetMesh::none, TetMesh::none, TetMesh::none, TetMesh::none};

struct NamedTriple {
    Triple vertices;
    std::uint32_t surface;
};

/// Numbers the kept cells one after another, in little memory.
class KeptNumbers {
  public:
    KeptNumbers(const std::vector<std::uint8_t>& kept, std::uint32_t first)
        : blocks_((kept.size() + 63) / 64), end_(first) {
        for (std::size_t c = 0; c < kept.size(); ++c) {
            Block& block = blocks_[c / 64];
            if (c % 64 == 0) block.first = end_;
            block.marks |= std::uint64_t{kept[c]} << c % 64;
            end_ += kept[c];
        }
    }
    /// Nothing where the cell is not kept.
    std::optional<std::uint32_t> find(std::uint32_t c) const {
        const Block& block = blocks_[c / 64];
        const std::uint64_t from_here = block.marks << (63 - c % 64);
        if (from_here >> 63U == 0) return std::nullopt;
        return block.first + static_cast<std::uint32_t>(std::popcount(from_here)) - 1;
    }
    std::uint32_t end() const { return end_; }

  private:
    struct Block {
        std::uint64_t marks = 0;  ///< bit by cell: whether it is kept
        std::uint32_t first = 0;  ///< number of its first kept cell
    };
    std::vector<Block> blocks_;
    std::uint32_t end_;
};

class Gluer {
  public:
    /// The kept cells of an operand, and how they lie beside each other.
    void add_kept(std::uint32_t number, const Operand& operand, const std::vector<std::uint8_t>& kept) {
        const TetMesh& mesh = operand.mesh;
        const std::vector<std::uint8_t> may_meet_others = meeting_vertices(operand, kept);
        const KeptNumbers cell_numbers(kept, static_cast<std::uint32_t>(cells_.size()));
        merged_.regions.resize(cell_numbers.end(), number);
        merged_.kept_cells.reserve(cell_numbers.end());
        auto next = static_cast<std::uint32_t>(cells_.size());
        cells_.grow(cell_numbers.end());
        std::vector<std::uint32_t> numbers(mesh.n_vertices(), unnumbered);
        for (const CellHandle c : mesh.cells()) {
            if (!kept[c.idx()]) continue;
            TetMesh::Cell& cell = cells_[next++];
            for (int k = 0; k < 4; ++k) {
                const VertexHandle v = mesh.cell_vertex(c, k);
                if (numbers[v.idx()] == unnumbered) {
                    const Eigen::Vector3d& p = mesh.point(v);
                    numbers[v.idx()] = may_meet_others[v.idx()] ? number_at(p) : add_point(p);
                    if (merged_.kept_vertices.size() < points_.size())
                        merged_.kept_vertices.push_back({number, v.idx()});
                }
                cell.vertices[k] = numbers[v.idx()];
                cell.neighbors[k] = TetMesh::none;
                const HalffaceHandle beyond = mesh.opposite_halfface_handle(TetMesh::halfface(c, k));
                if (!beyond.is_valid()) continue;
                if (const auto neighbor = cell_numbers.find(TetMesh::incident_cell(beyond).idx()))
                    cell.neighbors[k] =
                        TetMesh::halfface(CellHandle(*neighbor), TetMesh::local_face(beyond)).idx();
            }
            merged_.kept_cells.push_back({number, c.idx()});
        }
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
        for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
            const auto& [i, j, k, l] = mesh.cells[c];
            cells_.push_back({{number(i), number(j), number(k), number(l)}, unlinked});
            merged_.regions.push_back(static_cast<std::uint32_t>(mesh.regions[c]));
        }
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
        merged_.mesh = TetMesh::from_linked_cells(std::move(points_), std::move(cells_));
        for (const NamedTriple& face : faces_) {
            const auto& [a, b, c] = face.vertices;
            HalffaceHandle found =
                merged_.mesh.find_halfface(VertexHandle(a), VertexHandle(b), VertexHandle(c));
            if (!found.is_valid()) {
                const Eigen::Vector3d& p = merged_.mesh.point(VertexHandle(a));
                throw InputError(fmt::format(
                    "a triangle of the surface near ({:.6g}, {:.6g}, {:.6g}) is no face of the mesh", p.x(),
                    p.y(), p.z()));
            }
            const HalffaceHandle other = merged_.mesh.opposite_halfface_handle(found);
            if (other.is_valid()) found = std::min(found, other);
            merged_.faces.push_back({found, face.surface});
        }
        std::ranges::sort(merged_.faces, {}, &InterfaceFace::face);
        return std::move(merged_);
    }

  private:
    /// By vertex: whether it is on the surface or a cell that is not kept has it, so that other parts may.
    static std::vector<std::uint8_t> meeting_vertices(const Operand& operand,
                                                      const std::vector<std::uint8_t>& kept) {
        std::vector<std::uint8_t> meets(operand.mesh.n_vertices());
        std::fill_n(meets.begin(), std::min(meets.size(), operand.surface.points.size()), 1);
        for (std::uint32_t c = 0; c < kept.size(); ++c)
            if (!kept[c])
                for (const VertexHandle v : operand.mesh.cell_vertices(CellHandle(c))) meets[v.idx()] = 1;
        return meets;
    }
    std::uint32_t add_point(const Eigen::Vector3d& p) {
        points_.push_back(p);
        return static_cast<std::uint32_t>(points_.size() - 1);
    }
    std::uint32_t number_at(const Eigen::Vector3d& p) {
        const auto next = static_cast<std::uint32_t>(points_.size());
        const std::uint32_t number = places_.insert(p, next);
        return number == next ? add_point(p) : number;
    }

    Merged merged_;
    std::vector<Eigen::Vector3d> points_;
    volmesh::Column<TetMesh::Cell> cells_;
    std::vector<NamedTriple> faces_;
    PointIndex places_;
};

Region region_beyond(const Merged& merged, HalffaceHandle face) {
    const HalffaceHandle other = merged.mesh.opposite_halfface_handle(face);
    return other.is_valid() ? static_cast<Region>(merged.regions[TetMesh::incident_cell(other).idx()])
                            : outside;
}

Region region_within(const Merged& merged, HalffaceHandle face) {
    return static_cast<Region>(merged.regions[TetMesh::incident_cell(face).idx()]);
}

void require_named_faces(const Merged& merged) {
    std::size_t n = 0;
    for (const HalffaceHandle face : merged.mesh.halffaces()) {
        const HalffaceHandle other = merged.mesh.opposite_halfface_handle(face);
        if (other.is_valid() && (other < face || region_within(merged, face) == region_beyond(merged, face)))
            continue;
        if (n == merged.faces.size() || merged.faces[n].face != face) {
            const Eigen::Vector3d& p = merged.mesh.point(merged.mesh.halfface_vertices(face)[0]);
            throw InputError(fmt::format(
                "a face on the boundary or between regions lies on no surface, near ({:.6g}, {:.6g}, {:.6g})",
                p.x(), p.y(), p.z()));
        }
        ++n;
    }
    if (n != merged.faces.size()) throw InputError("a surface runs through the inside of a region");
}

void require_volumes(const Merged& merged) {
    FacetComplex surface;
    surface.points.assign(merged.mesh.points().begin(), merged.mesh.points().end());
    for (const InterfaceFace& face : merged.faces) {
        Facet facet{{}, face.surface, region_beyond(merged, face.face), region_within(merged, face.face)};
        const auto vertices = merged.mesh.halfface_vertices(face.face);
        for (int k = 0; k < 3; ++k) facet.vertices[k] = vertices[k].idx();
        surface.facets.push_back(facet);
    }
    const std::vector<double> enclosed = tetgen::region_volumes(surface);
    std::vector<double> filled(enclosed.size());
    double all = 0;
    for (const CellHandle c : merged.mesh.cells()) {
        const double volume = volmesh::volume(merged.mesh, c);
        filled[merged.regions[c.idx()]] += volume;
        all += volume;
    }
    for (std::size_t r = 0; r < enclosed.size(); ++r)
        if (std::abs(filled[r] - enclosed[r]) > 1e-9 * all)
            throw InputError(
                fmt::format("the cells of a region have volume {:.12g}, its faces enclose {:.12g}", filled[r],
                            enclosed[r]));
}

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

Merged glue(std::span<const Operand> operands, const KeptCells& kept, const FacetComplex& zone,
            const FacetComplex& bounds, const ComplexMesh& new_cells, std::uint32_t shell_surface) {
    Gluer gluer;
    for (std::uint32_t i = 0; i < operands.size(); ++i) gluer.add_kept(i, operands[i], kept[i]);
    gluer.add_new(new_cells, bounds, shell_surface);
    gluer.add_kept_interface(zone);
    return gluer.finish();
}

void verify(const Merged& merged) {
    require_named_faces(merged);
    require_volumes(merged);
}

}  // namespace maille::modeler
