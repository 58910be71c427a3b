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
    const Freedom& bound = freedom(v);
    if (bound.is_fixed) return false;
    const CellList cells = mesh_.vc_range(v);
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
    const auto sum_of_beta = [](const Point& p, const Bases& bases) {
        double sum = 0;
        for (const Base& base : bases) sum += beta(tet_geometry(p, base[0], base[1], base[2]));
        return sum;
    };
    for (std::uint32_t i = 0; i < mesh_.n_vertices(); ++i) {
        const VertexHandle v(i);
        if (mesh_.is_deleted(v) || !freedom(v).is_free()) continue;
        const CellList cells = mesh_.vc_range(v);
        const Bases bases = bases_at(v, cells);
        const Point start = mesh_.point(v);
        // The mean of the cells' centroids, weighted by volume.
        Point target = Point::Zero();
        double total = 0;
        for (const Base& base : bases) {
            const double volume = (base[0] - start).dot((base[1] - start).cross(base[2] - start));
            target += volume * (start + base[0] + base[1] + base[2]) / 4;
            total += volume;
        }
        target /= total;
        const double floor = std::min(quality(cells), options_.good_enough);
        const double before = sum_of_beta(start, bases);
        const IsAllowed is_allowed = allowed_places(v, cells, freedom(v));
        for (double part : {1.0, 0.4}) {
            const Point p = start + part * (target - start);
            if (!(least_objective(p, bases, floor) > floor) || !(sum_of_beta(p, bases) > before) ||
                !is_allowed(p))
                continue;
            mesh_.set_point(v, p);
            ++result_.moves;
            settle(cells, mesh_.n_cells());
            break;
        }
    }
}

}  // namespace maille::quality
