#include <algorithm>

#include "quality/improver.hh"
#include "quality/mean_collapses.hh"
#include "quality/mean_flips.hh"
#include "quality/mean_moves.hh"
#include "quality/smooth.hh"

namespace maille::quality {

double Improver::mean_beta() const {
    double sum = 0;
    std::size_t n = 0;
    for (std::uint32_t i = 0; i < mesh_.n_cells(); ++i) {
        if (mesh_.is_deleted(CellHandle(i))) continue;
        sum += shapes_[i].beta;
        ++n;
    }
    return n > 0 ? sum / static_cast<double>(n) : 1;
}

void Improver::raise_mean() {
    constexpr double little = 0.003;
    const std::vector<std::uint8_t> is_free = free_vertices(mesh_);
    double mean = mean_beta();
    for (int sweep = 0; sweep < options_.mean_sweeps; ++sweep) {
        const double before = mean;
        if (mean < options_.good_mean && options_.may_change_cells) {
            result_.edge_removals += flip_for_mean(mesh_, shapes_, mean, limit_);
            mean = mean_beta();
            if (mean < options_.good_mean)
                result_.collapses += collapse_for_mean(mesh_, shapes_, mean, limit_, is_free);
        }
        result_.moves += move_for_mean(mesh_, shapes_, limit_, is_free);
        mean = mean_beta();
        if (mean >= options_.good_mean) break;
        result_.moves += slide_for_mean(is_free);
        mean = mean_beta();
        if (mean >= options_.good_mean || mean < before + little) break;
    }
}

/// Moves vertices on surfaces, curves and flat sides.
std::size_t Improver::slide_for_mean(const std::vector<std::uint8_t>& is_free) {
    std::size_t n_moves = 0;
    for (std::uint32_t i = 0; i < mesh_.n_vertices(); ++i) {
        const VertexHandle v(i);
        if (is_free[i] != 0 || mesh_.is_deleted(v)) continue;
        const CellList cells = mesh_.vc_range(v);
        const Freedom& bound = freedom(v, cells);
        if (bound.is_fixed) continue;
        const Point start = mesh_.point(v);
        const Bases bases = bases_at(v, cells);
        const auto found = higher_place(bases, start, quality(cells), Constraint(bound, start, projector_),
                                        allowed_places(v, cells, bases, bound));
        if (!found) continue;
        mesh_.set_point(v, found->point);
        for (std::size_t k = 0; k < cells.size(); ++k) shapes_[cells[k].idx()] = found->shapes[k];
        ++n_moves;
    }
    return n_moves;
}

}  // namespace maille::quality
