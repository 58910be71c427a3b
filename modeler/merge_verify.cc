#include "modeler/merge_verify.hh"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <fmt/core.h>

#include "modeler/merge_zone.hh"
#include "modeler/tetrahedralize_check.hh"
#include "volmesh/error.hh"
#include "volmesh/measure.hh"

namespace maille::modeler {
namespace {

using volmesh::CellHandle;
using volmesh::HalffaceHandle;
using volmesh::TetMesh;

class Verifier {
  public:
    Verifier(const Merged& merged, std::span<const HalffaceHandle> seams)
        : merged_(merged), first_new_(merged.kept_cells.size()) {
        for (const HalffaceHandle face : seams) add(face);
        for (std::uint32_t hf = 4 * first_new_; hf < merged.mesh.n_halffaces(); ++hf) add(HalffaceHandle(hf));
        std::ranges::sort(faces_);
        faces_.erase(std::unique(faces_.begin(), faces_.end()), faces_.end());
    }

    void require_names() const {
        auto named = merged_.faces.begin();
        for (const HalffaceHandle face : faces_) {
            if (region_within(face) == region_beyond(face)) continue;
            if (named == merged_.faces.end() || face < named->face) {
                const Eigen::Vector3d& p = merged_.mesh.point(merged_.mesh.halfface_vertices(face)[0]);
                throw InputError(fmt::format(
                    "a face on the boundary or between regions lies on no surface, near ({:.6g}, {:.6g}, "
                    "{:.6g})",
                    p.x(), p.y(), p.z()));
            }
            if (named->face != face) break;
            ++named;
        }
        if (named != merged_.faces.end()) throw InputError("a surface runs through the inside of a region");
    }

    void require_volumes() const {
        const std::vector<double> left = tetgen::region_volumes(bounds_of_new());
        std::vector<double> filled(left.size());
        double all = 0;
        for (std::uint32_t c = first_new_; c < merged_.mesh.n_cells(); ++c) {
            const double volume = volmesh::volume(merged_.mesh, CellHandle(c));
            filled[merged_.region(CellHandle(c))] += volume;
            all += volume;
        }
        for (std::size_t r = 0; r < left.size(); ++r)
            if (std::abs(filled[r] - left[r]) > 1e-9 * all)
                throw InputError(fmt::format(
                    "the new cells of a region have volume {:.12g}, what bounds them encloses {:.12g}",
                    filled[r], left[r]));
    }

  private:
    /// Of the two half-faces of a face, the lower one stands for it.
    void add(HalffaceHandle face) {
        const HalffaceHandle other = merged_.mesh.opposite_halfface_handle(face);
        faces_.push_back(other.is_valid() ? std::min(face, other) : face);
    }

    Region region_within(HalffaceHandle face) const {
        return static_cast<Region>(merged_.region(TetMesh::incident_cell(face)));
    }
    Region region_beyond(HalffaceHandle face) const {
        const HalffaceHandle other = merged_.mesh.opposite_halfface_handle(face);
        return other.is_valid() ? region_within(other) : outside;
    }

    FacetComplex bounds_of_new() const {
        FacetComplex bounds;
        std::vector<std::uint32_t> numbers(merged_.mesh.n_vertices(), TetMesh::none);
        const auto kept_or = [&](HalffaceHandle face, Region region) {
            return face.is_valid() && TetMesh::incident_cell(face).idx() < first_new_ ? kept_part : region;
        };
        for (const HalffaceHandle face : faces_) {
            const HalffaceHandle other = merged_.mesh.opposite_halfface_handle(face);
            Facet facet{{}, 0, kept_or(other, region_beyond(face)), kept_or(face, region_within(face))};
            if (facet.front == facet.back) continue;
            for (int k = 0; const auto v : merged_.mesh.halfface_vertices(face)) {
                std::uint32_t& number = numbers[v.idx()];
                if (number == TetMesh::none) {
                    number = static_cast<std::uint32_t>(bounds.points.size());
                    bounds.points.push_back(merged_.mesh.point(v));
                }
                facet.vertices[k++] = number;
            }
            bounds.facets.push_back(facet);
        }
        return bounds;
    }

    const Merged& merged_;
    std::uint32_t first_new_;
    std::vector<HalffaceHandle> faces_;  ///< of new cells and at seams, ascending
};

}  // namespace

void verify(const Merged& merged, std::span<const HalffaceHandle> seams) {
    const Verifier verifier(merged, seams);
    verifier.require_names();
    verifier.require_volumes();
}

}  // namespace maille::modeler
