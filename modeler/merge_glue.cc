#include "modeler/merge_glue.hh"

#include <algorithm>
#include <cmath>
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

struct NamedTriple {
    Triple vertices;
    std::uint32_t surface;
};

class Gluer {
  public:
    void add_kept(std::uint32_t operand, const TetMesh& mesh, const std::vector<std::uint8_t>& kept) {
        std::vector<std::uint32_t> numbers(mesh.n_vertices(), unnumbered);
        for (const CellHandle c : mesh.cells()) {
            if (!kept[c.idx()]) continue;
            std::array<std::uint32_t, 4> cell{};
            for (int k = 0; k < 4; ++k) {
                const VertexHandle v = mesh.cell_vertex(c, k);
                if (numbers[v.idx()] == unnumbered) {
                    numbers[v.idx()] = number_at(mesh.point(v));
                    if (merged_.kept_vertices.size() < points_.size())
                        merged_.kept_vertices.push_back({operand, v.idx()});
                }
                cell[k] = numbers[v.idx()];
            }
            cells_.push_back(cell);
            merged_.regions.push_back(operand);
            merged_.kept_cells.push_back({operand, c.idx()});
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
            cells_.push_back({number(i), number(j), number(k), number(l)});
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
        merged_.mesh = TetMesh::from_cells(std::move(points_), std::move(cells_));
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
    std::vector<std::array<std::uint32_t, 4>> cells_;
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
    for (std::uint32_t i = 0; i < operands.size(); ++i) gluer.add_kept(i, operands[i].mesh, kept[i]);
    gluer.add_new(new_cells, bounds, shell_surface);
    gluer.add_kept_interface(zone);
    return gluer.finish();
}

void verify(const Merged& merged) {
    require_named_faces(merged);
    require_volumes(merged);
}

}  // namespace maille::modeler
