#include <algorithm>

#include <Eigen/Geometry>

#include "quality/improver.hh"
#include "quality/smooth.hh"

namespace maille::quality {

IsAllowed Improver::allowed_places(VertexHandle v, const CellList& cells, const Freedom& freedom) {
    const bool has_size = options_.size != nullptr;
    if (freedom.surfaces.empty() && !has_size) return [](const Point&) { return true; };
    const double most_excess = excess(cells);
    auto pieces = std::make_shared<SurfacePieces>(mesh_, v, cells, surfaces_of_);
    const double most_error = !freedom.surfaces.empty() ? pieces->error(mesh_.point(v), *projector_) +
                                                              1e-12 * projector_->model_size
                                                        : 0;
    const bool is_bound = !freedom.surfaces.empty();
    return [this, v, &cells, most_excess, most_error, pieces, is_bound, has_size](const Point& p) {
        if (is_bound && pieces->error(p, *projector_) > most_error) return false;
        return !has_size || std::ranges::all_of(cells, [&](CellHandle c) {
            auto corners = mesh_.cell_points(c);
            corners[mesh_.local_vertex(c, v)] = p;
            return excess(corners) <= most_excess;
        });
    };
}

bool Improver::smooth(VertexHandle v) {
    const CellList cells = mesh_.vc_range(v);
    const Freedom& bound = freedom(v, cells);
    if (bound.is_fixed) return false;
    const Bases bases = bases_at(v, cells);
    const Point start = mesh_.point(v);
    const auto place =
        better_place(bases, start, Constraint(bound, start, projector_), allowed_places(v, cells, bound));
    if (!place) return false;
    mesh_.set_point(v, *place);
    ++result_.moves;
    settle(cells, mesh_.n_cells());
    return true;
}

void Improver::raise_mean() {
    boost::container::small_vector<Shape, 48> found;
    for (std::uint32_t i = 0; i < mesh_.n_vertices(); ++i) {
        const VertexHandle v(i);
        if (mesh_.is_deleted(v)) continue;
        const CellList cells = mesh_.vc_range(v);
        if (!freedom(v, cells).is_free()) continue;
        double floor = options_.good_enough;
        double before = 0;
        // The mean of the cells' centroids, weighted by volume.
        const Bases bases = bases_at(v, cells);
        const Point start = mesh_.point(v);
        Point target = Point::Zero();
        double total = 0;
        for (std::size_t k = 0; k < cells.size(); ++k) {
            const auto& [p, q, r] = bases[k];
            const double volume = (p - start).dot((q - start).cross(r - start));
            target += volume * (start + p + q + r) / 4;
            total += volume;
            const Shape& shape = shapes_[cells[k].idx()];
            floor = std::min(floor, shape.objective);
            before += shape.beta;
        }
        target /= total;
        const IsAllowed is_allowed = allowed_places(v, cells, freedom(v, cells));
        for (double part : {1.0, 0.4}) {
            const Point place = start + part * (target - start);
            found.clear();
            double after = 0;
            for (const auto& [p, q, r] : bases) {
                found.push_back(shape(place, p, q, r));
                after += found.back().beta;
                if (!(found.back().objective > floor)) break;
            }
            if (found.size() < bases.size() || !(found.back().objective > floor) || !(after > before) ||
                !is_allowed(place))
                continue;
            mesh_.set_point(v, place);
            ++result_.moves;
            ++now_;
            for (std::size_t k = 0; k < cells.size(); ++k) note_shape(cells[k], found[k]);
            break;
        }
    }
}

}  // namespace maille::quality
