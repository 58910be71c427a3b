#include "volmesh/face_surfaces.hh"

#include <algorithm>
#include <limits>
#include <map>

namespace maille::volmesh {
namespace {

/// What a projector doesn't find is infinitely far.
double distance(const Projector& projector, std::uint32_t surface, const Point& p) {
    const auto nearest = projector.project({&surface, 1}, p);
    return nearest ? (*nearest - p).norm() : std::numeric_limits<double>::infinity();
}

}  // namespace

void add(Surfaces& to, const Surfaces& more) {
    for (const std::uint32_t surface : more) {
        const auto place = std::ranges::lower_bound(to, surface);
        if (place == to.end() || *place != surface) to.insert(place, surface);
    }
}

FaceSurfaces::FaceSurfaces(const TetMesh& mesh, const Projector* projector)
    : mesh_(mesh), projector_(projector), of_set_(mesh.n_sets()) {
    if (!projector) return;
    for (std::uint32_t s = 0; s < projector->surfaces.size(); ++s) {
        const SetHandle set = mesh.find_set(projector->surfaces[s], EntityKind::face);
        if (set.is_valid()) of_set_[set.idx()].push_back(s);
    }
}

Surfaces FaceSurfaces::operator()(HalffaceHandle hf) {
    Surfaces surfaces;
    for (const SetHandle set : sets_with_surfaces(mesh_.combination(hf))) {
        const Namesakes& namesakes = of_set_[set.idx()];
        add(surfaces, {namesakes.size() == 1 ? namesakes.front() : nearest(namesakes, hf)});
    }
    return surfaces;
}

const std::vector<SetHandle>& FaceSurfaces::sets_with_surfaces(CombinationId id) {
    if (id >= of_combination_.size()) of_combination_.resize(id + 1);
    auto& sets = of_combination_[id];
    if (!sets) {
        sets.emplace();
        for (const SetHandle set : mesh_.sets_of(id))
            if (!of_set_[set.idx()].empty()) sets->push_back(set);
    }
    return *sets;
}

/// Of several equally near, as coincident faces are, the first.
std::uint32_t FaceSurfaces::nearest(const Namesakes& surfaces, HalffaceHandle hf) const {
    const auto v = mesh_.halfface_vertices(hf);
    const std::array<Point, 3> corners{mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2])};
    const Point centroid = (corners[0] + corners[1] + corners[2]) / 3;
    double reach = 0;
    for (const Point& p : corners) reach = std::max(reach, (p - centroid).norm());

    std::vector<double> distances;
    for (const std::uint32_t s : surfaces) distances.push_back(distance(*projector_, s, centroid));
    // Distances change by no more than the way gone: surfaces much farther from the centroid are farther from
    // all.
    const double limit = *std::ranges::min_element(distances) + 2 * reach;
    const double equal = 1e-9 * projector_->model_size;
    std::uint32_t best = surfaces.front();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        if (distances[i] > limit) continue;
        for (const Point& p : corners) distances[i] += distance(*projector_, surfaces[i], p);
        if (distances[i] < least - equal) {
            best = surfaces[i];
            least = distances[i];
        }
    }
    return best;
}

}  // namespace maille::volmesh
