#include "refine/refine.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "quality/boundary_projection.hh"
#include "quality/relocate.hh"
#include "refine/bisector.hh"
#include "refine/curve_order.hh"
#include "refine/rivara.hh"
#include "refine/stopwatch.hh"
#include "refine/threads.hh"
#include "volmesh/error.hh"

namespace maille::refine {
namespace {

using Cells = std::vector<CellHandle>;

/// One refinement of one mesh, pass by pass. The cells that may need refinement are all at first, then those
/// that have changed since they were last looked at.
class Refinement {
  public:
    Refinement(TetMesh& mesh, const SizeField& size, const RefineOptions& options,
               const volmesh::Projector* projector)
        : mesh_(mesh), size_(size), options_(options), bisector_(mesh, options.ties), curve_(mesh) {
        if (projector != nullptr && options.project) {
            projection_.emplace(mesh, *projector, options.min_shape);
            project(0);
        }
    }

    RefineResult run() {
        refine_and_project();
        if (options_.gradation > 0 && result_.ended) {
            // Now the mesh is fine enough to see all that the size does.
            size_ = limit_growth(size_, mesh_, options_.gradation);
            look_at_all_again();
            refine_and_project();
        }
        result_.cells = mesh_.n_cells();
        result_.vertices = mesh_.n_vertices();
        result_.lineage = bisector_.take_lineage();
        if (projection_) result_.projection = {projection_->n_moved(), projection_->short_of_target()};
        return std::move(result_);
    }

  private:
    void refine_and_project() {
        do {
            refine_to_size();
        } while (bring_home() && result_.ended);
    }

    void look_at_all_again() {
        Cells all;
        for (const auto c : mesh_.cells()) all.push_back(c);
        bisector_.refresh(all);
    }

    void refine_to_size() {
        for (Cells marked = mark(); !marked.empty(); marked = mark()) {
            if (result_.iterations >= options_.max_iterations || mesh_.n_cells() > options_.max_cells) {
                result_.ended = false;
                return;
            }
            const bool has_split = pass(marked);
            ++result_.iterations;
            if (options_.progress) options_.progress({result_.iterations, marked.size(), mesh_.n_cells()});
            if (!has_split) {
                result_.ended = false;
                return;
            }
        }
    }

    Cells mark() {
        const Stopwatch watch(result_.seconds.mark);
        const Cells changed = bisector_.take_changed();
        // By Rivara the mesh is the same in any order.
        if (options_.method == Method::rivara && options_.order == Order::none)
            return cells_to_refine(bisector_, changed, size_, options_.ratio, curve_);
        Cells marked = cells_to_refine(bisector_, changed, size_, options_.ratio);
        sort_cells(marked, bisector_, options_.order);
        return marked;
    }

    /// Returns whether any cell was split: those that can't be are looked at again after the next pass.
    bool pass(const Cells& marked) {
        const std::uint32_t first_new = mesh_.n_vertices();
        {
            const Stopwatch watch(result_.seconds.split);
            bisector_.begin_pass(marked);
            bisector_.refresh(bisect(marked));
        }
        project(first_new);
        if (options_.smooth) smooth(first_new);
        return mesh_.n_vertices() > first_new;
    }

    /// Returns the cells that couldn't be split.
    Cells bisect(const Cells& marked) {
        if (options_.method == Method::rivara) return bisect_conforming(bisector_, marked);
        Cells refused;
        for (const CellHandle c : marked)
            if (!bisector_.bisect(c)) refused.push_back(c);
        return refused;
    }

    /// Brings vertices to their surfaces: the waiting ones and those from `first_new` on, which are in
    /// changed cells.
    void project(std::uint32_t first_new) {
        if (!projection_) return;
        const Stopwatch watch(result_.seconds.project);
        projection_->take_up(first_new, bisector_.changed());
        bisector_.refresh(projection_->run());
    }

    void smooth(std::uint32_t first_new) {
        const Stopwatch watch(result_.seconds.smooth);
        Cells moved;
        for (std::uint32_t i = first_new; i < mesh_.n_vertices(); ++i) {
            const VertexHandle v(i);
            const CellList cells = mesh_.vc_range(v);
            if (quality::is_free(mesh_, v, cells) && quality::relax(mesh_, v, cells))
                moved.insert(moved.end(), cells.begin(), cells.end());
        }
        bisector_.refresh(moved);
    }

    /// Where vertices still fall short of their surfaces, tries harder, and as a last resort splits the edges
    /// in their way, so that there are nodes that can make room. Returns whether the size has to be seen to
    /// again.
    bool bring_home() {
        if (!projection_ || projection_->is_done()) return false;
        const Stopwatch watch(result_.seconds.project);
        bisector_.refresh(projection_->insist());
        if (is_worth_a_rescue(projection_->n_waiting())) {
            const std::uint32_t first_new = mesh_.n_vertices();
            for (const auto& [cell, edge] : projection_->blocking_edges())
                if (!bisector_.is_born(cell)) bisector_.split(cell, edge);
            projection_->take_up(first_new, bisector_.changed());
            bisector_.refresh(projection_->run());
        }
        return !bisector_.changed().empty();
    }

    /// While each rescue leaves fewer vertices short of their surfaces than ever before; one may fail.
    bool is_worth_a_rescue(std::size_t n_short) {
        if (n_short >= fewest_short_) ++n_failed_rescues_;
        fewest_short_ = std::min(fewest_short_, n_short);
        return n_short > 0 && n_failed_rescues_ < 2;
    }

    TetMesh& mesh_;
    SizeField size_;
    const RefineOptions& options_;
    Bisector bisector_;
    CurveOrder curve_;
    std::optional<quality::BoundaryProjection> projection_;
    std::size_t fewest_short_ = std::numeric_limits<std::size_t>::max();
    int n_failed_rescues_ = 0;
    RefineResult result_;
};

void require_valid(const TetMesh& mesh, const RefineOptions& options) {
    if (!(options.ratio > 0) || !std::isfinite(options.ratio))
        throw InputError(fmt::format("the refinement ratio must be positive, not {}", options.ratio));
    if (!(options.gradation >= 0) || !std::isfinite(options.gradation))
        throw InputError(fmt::format("the gradation must be positive, not {}", options.gradation));
    quality::require_min_shape(options.min_shape);
    if (options.max_iterations < 0) throw InputError("the number of iterations cannot be negative");
    if (mesh.has_deleted())
        throw InputError("the mesh has deleted entities: collect them (garbage_collection) first");
}

}  // namespace

RefineResult refine(TetMesh& mesh, const SizeField& size, const RefineOptions& options,
                    const volmesh::Projector* projector) {
    require_valid(mesh, options);
    RefineResult result;
    with_threads(options.threads, [&] { result = Refinement(mesh, size, options, projector).run(); });
    return result;
}

}  // namespace maille::refine
