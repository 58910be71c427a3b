#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "refine/simplex_tree.hh"
#include "refine/size_field.hh"
#include "volmesh/error.hh"
#include "volmesh/face_surfaces.hh"

namespace maille::refine {
namespace {

using volmesh::Projector;
using volmesh::TetMesh;

/// The faces of a mesh that lie on one curved surface.
struct CurvedFaces {
    std::uint32_t surface;
    SimplexTree faces;
};

std::vector<CurvedFaces> curved_faces(const TetMesh& mesh, const Projector& projector) {
    const double flat = 1e-9 / projector.model_size;
    volmesh::FaceSurfaces surfaces_of(mesh, &projector);
    std::map<std::uint32_t, std::vector<Simplex>> by_surface;
    for (const auto hf : mesh.halffaces()) {
        if (hf.opposite().is_valid() && hf.opposite() < hf) continue;
        const auto [a, b, c] = mesh.halfface_vertices(hf);
        const Simplex face{{mesh.point(a), mesh.point(b), mesh.point(c)}, 3};
        const Point centroid = (face.corners[0] + face.corners[1] + face.corners[2]) / 3;
        for (const std::uint32_t surface : surfaces_of(hf))
            if (projector.curvature(surface, centroid) > flat) by_surface[surface].push_back(face);
    }
    std::vector<CurvedFaces> curved;
    for (auto& [surface, faces] : by_surface) curved.push_back({surface, SimplexTree(std::move(faces))});
    return curved;
}

}  // namespace

std::function<double(const Point&)> curvature_size(const TetMesh& mesh, const Projector& projector,
                                                   double segments) {
    if (!(segments >= 3) || !std::isfinite(segments))
        throw InputError(fmt::format("a circle takes at least 3 segments, not {}", segments));
    if (!projector.curvature) throw InputError("the model does not tell how its surfaces are curved");
    const double chord_of_unit_circle = 2 * std::sin(std::numbers::pi / segments);
    return [curved = curved_faces(mesh, projector), curvature = projector.curvature, chord_of_unit_circle,
            largest = projector.model_size](const Point& p) {
        const double smallest = 1e-4 * largest;
        double size = largest;
        for (const auto& [surface, faces] : curved) {
            const SimplexTree::Nearest nearest = faces.nearest(p, size);
            const double distance = std::sqrt(nearest.squared_distance);
            if (distance >= size) continue;
            const double chord =
                chord_of_unit_circle / curvature(surface, nearest.of(faces[nearest.simplex]));
            size = std::min(size, std::max(smallest, chord) + distance);
        }
        return size;
    };
}

}  // namespace maille::refine
