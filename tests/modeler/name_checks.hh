#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "modeler/model.hh"
#include "quality/projection_result.hh"
#include "volmesh/tet_mesh.hh"

/// What the face sets of a built mesh are checked by.
namespace maille::modeler::test {

/// The surfaces that boundary faces in the set of that name may lie on.
inline std::map<std::string, std::set<std::uint32_t>> surfaces_by_name(const Model& model) {
    std::map<std::string, std::set<std::uint32_t>> by_name;
    const std::vector<ModelSurface> numbered = surfaces(model);
    for (std::uint32_t s = 0; s < numbered.size(); ++s) by_name[numbered[s].name].insert(s);
    for (const Primitive& primitive : model.primitives)
        for (const auto& [surface, name] : primitive.boundary_names) by_name[name].insert(surface);
    return by_name;
}

struct NameFigures {
    std::size_t nameless = 0;   ///< boundary faces in no surface's set
    std::size_t ambiguous = 0;  ///< in several
    double farthest = 0;  ///< greatest distance of a boundary face's corner from the surface of that name
    double farthest_short = 0;  ///< the same of those that are known to be short of it
};

/// Looks at each boundary face: whether it is in the set of one surface, and how far from it its corners lie,
/// which must be on the same one where several bear the name.
inline NameFigures check_names(const volmesh::TetMesh& mesh, const Model& model,
                               std::span<const quality::ShortOfTarget> short_of_target = {}) {
    const auto is_short = [&](volmesh::VertexHandle v) {
        return std::ranges::binary_search(short_of_target, v, {}, &quality::ShortOfTarget::vertex);
    };
    const std::vector<ModelSurface> numbered = surfaces(model);
    std::map<volmesh::FaceHandle, int> times_named;
    NameFigures figures;
    for (const auto& [name, candidates] : surfaces_by_name(model)) {
        const auto set = mesh.find_set(name, volmesh::EntityKind::face);
        if (!set.is_valid()) continue;
        for (const auto halfface : mesh.face_members(set)) {
            const auto face = mesh.face_handle(halfface);
            if (!mesh.is_boundary(face)) continue;
            ++times_named[face];
            std::array nearest{std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::infinity()};
            for (const std::uint32_t s : candidates) {
                const Shape& shape = *model.primitives[numbered[s].primitive].shape;
                std::array<double, 2>
                    distance{};  // of those that are where they should be, and of the others
                for (const auto v : mesh.face_vertices(face)) {
                    double& so_far = distance[is_short(v)];
                    so_far = std::max(
                        so_far, (shape.project(numbered[s].face, mesh.point(v)) - mesh.point(v)).norm());
                }
                nearest = std::min(nearest, distance);
            }
            figures.farthest = std::max(figures.farthest, nearest[0]);
            figures.farthest_short = std::max(figures.farthest_short, nearest[1]);
        }
    }
    for (const auto face : mesh.boundary_faces()) {
        const auto found = times_named.find(face);
        figures.nameless += found == times_named.end();
        figures.ambiguous += found != times_named.end() && found->second > 1;
    }
    return figures;
}

}  // namespace maille::modeler::test
