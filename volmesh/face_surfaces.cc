#include "volmesh/face_surfaces.hh"

#include <algorithm>
#include <limits>
#include <map>

namespace maille::volmesh {
namespace {

/// Times the model's size: what differs by less is equally far.
constexpr double same_distance = 1e-9;

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
        add(surfaces, {namesakes.size() == 1 ? namesakes.front() : surface_among(namesakes, hf)});
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

std::uint32_t FaceSurfaces::surface_among(const Namesakes& surfaces, HalffaceHandle hf) {
    const auto vertices = mesh_.halfface_vertices(hf);
    std::array<Point, 3> corners;
    Surfaces candidates;
    for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = mesh_.point(vertices[k]);
        if (vertices[k].idx() < met_.size()) add(candidates, met_[vertices[k].idx()]);
    }
    for (const std::uint32_t candidate : candidates)
        if (std::ranges::binary_search(surfaces, candidate) && lies_on(candidate, corners)) return candidate;
    const std::uint32_t found = nearest(surfaces, corners);
    for (const VertexHandle v : vertices) {
        if (v.idx() >= met_.size()) met_.resize(v.idx() + 1);
        add(met_[v.idx()], Surfaces(1, found));
    }
    return found;
}

/// Whether no other surface could be nearer.
bool FaceSurfaces::lies_on(std::uint32_t surface, const std::array<Point, 3>& corners) const {
    const double equal = same_distance * projector_->model_size;
    double sum = distance(*projector_, surface, (corners[0] + corners[1] + corners[2]) / 3);
    for (std::size_t k = 0; k < 3 && sum <= equal; ++k) sum += distance(*projector_, surface, corners[k]);
    return sum <= equal;
}

/// Of several equally near, as coincident faces are, the first.
std::uint32_t FaceSurfaces::nearest(const Namesakes& surfaces, const std::array<Point, 3>& corners) const {
    const Point centroid = (corners[0] + corners[1] + corners[2]) / 3;
    double reach = 0;
    for (const Point& p : corners) reach = std::max(reach, (p - centroid).norm());

    std::vector<double> distances;
    for (const std::uint32_t s : surfaces) distances.push_back(distance(*projector_, s, centroid));
    // Distances change by no more than the way gone: surfaces much farther from the centroid are farther from
    // all.
    const double limit = *std::ranges::min_element(distances) + 2 * reach;
    const double equal = same_distance * projector_->model_size;
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
