#include "quality/improver.hh"
#include "quality/smooth.hh"

namespace maille::quality {

IsAllowed Improver::allowed_places(VertexHandle v, const CellList& cells, const Bases& bases,
                                   const Freedom& freedom) {
    const Point start = mesh_.point(v);
    const auto keeps_size = [this, &bases, start](const Point& p) { return limit_.keeps(bases, start, p); };
    if (freedom.surfaces.empty()) return keeps_size;
    // Most vertices find no place worth asking for: the surfaces are looked up for those that do.
    std::optional<SurfacePieces> pieces;
    double most_error = 0;
    return [=, this, &cells](const Point& p) mutable {
        if (!pieces) {
            pieces.emplace(mesh_, v, cells, surfaces_of_);
            most_error = pieces->error(start, *projector_) + 1e-12 * projector_->model_size;
        }
        return pieces->error(p, *projector_) <= most_error && keeps_size(p);
    };
}

bool Improver::smooth(VertexHandle v) {
    if (changed_[v.idx()] <= smoothed_[v.idx()]) return false;
    const CellList cells = mesh_.vc_range(v);
    const Freedom& bound = freedom(v, cells);
    if (bound.is_fixed) return false;
    const Bases bases = bases_at(v, cells);
    const Point start = mesh_.point(v);
    const auto place = better_place(bases, start, Constraint(bound, start, projector_),
                                    allowed_places(v, cells, bases, bound));
    if (!place) {
        smoothed_[v.idx()] = now_;
        return false;
    }
    mesh_.set_point(v, *place);
    ++result_.moves;
    settle(cells, mesh_.n_cells());
    return true;
}

}  // namespace maille::quality
