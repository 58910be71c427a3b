#include "quality/improver.hh"
#include "quality/smooth.hh"

namespace maille::quality {

IsAllowed Improver::allowed_places(VertexHandle v, const CellList& cells, const Bases& bases,
                                   const Freedom& freedom) {
    const Point start = mesh_.point(v);
    const auto keeps_size = [this, &bases, start](const Point& p) { return limit_.keeps(bases, start, p); };
    if (freedom.surfaces.empty()) return keeps_size;
    const auto pieces = std::make_shared<SurfacePieces>(mesh_, v, cells, surfaces_of_);
    const double most_error = pieces->error(start, *projector_) + 1e-12 * projector_->model_size;
    return [this, pieces, most_error, keeps_size](const Point& p) {
        return pieces->error(p, *projector_) <= most_error && keeps_size(p);
    };
}

bool Improver::smooth(VertexHandle v) {
    const CellList cells = mesh_.vc_range(v);
    const Freedom& bound = freedom(v, cells);
    if (bound.is_fixed) return false;
    const Bases bases = bases_at(v, cells);
    const Point start = mesh_.point(v);
    const auto place = better_place(bases, start, Constraint(bound, start, projector_),
                                    allowed_places(v, cells, bases, bound));
    if (!place) return false;
    mesh_.set_point(v, *place);
    ++result_.moves;
    settle(cells, mesh_.n_cells());
    return true;
}

}  // namespace maille::quality
