#include <algorithm>

#include <Eigen/Geometry>

#include "quality/improver.hh"
#include "quality/smooth.hh"

namespace maille::quality {

IsAllowed Improver::allowed_places(VertexHandle v, const CellList& cells, const Freedom& freedom) {
    const bool has_size = limit_.exists();
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
            return limit_.excess(corners) <= most_excess;
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

}  // namespace maille::quality
