#include "tools/picture/scene.hh"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "volmesh/error.hh"

namespace maille::picture {
namespace {

using volmesh::CellHandle;
using volmesh::CombinationId;
using volmesh::HalffaceHandle;
using volmesh::Point;
using volmesh::TetMesh;
using volmesh::VertexHandle;

constexpr CombinationId not_skin = std::numeric_limits<CombinationId>::max();

/// A visible face, and the combination of its face sets where it is of the mesh's own boundary.
struct VisibleFace {
    HalffaceHandle halfface;
    CombinationId surface;
};

bool is_left_out(const TetMesh& mesh, CellHandle c, const std::vector<Plane>& cut) {
    const auto p = mesh.cell_points(c);
    const Point centroid = (p[0] + p[1] + p[2] + p[3]) / 4;
    return !cut.empty() && std::all_of(cut.begin(), cut.end(), [&](const Plane& plane) {
        return plane.signedDistance(centroid) > 0;
    });
}

std::vector<VisibleFace> visible_faces(const TetMesh& mesh, const std::vector<Plane>& cut) {
    std::vector<char> is_in(mesh.n_cells());
    for (std::uint32_t i = 0; i < mesh.n_cells(); ++i)
        is_in[i] = !mesh.is_deleted(CellHandle(i)) && !is_left_out(mesh, CellHandle(i), cut);
    std::vector<VisibleFace> faces;
    for (std::uint32_t i = 0; i < mesh.n_halffaces(); ++i) {
        const HalffaceHandle hf(i);
        if (!is_in[TetMesh::incident_cell(hf).idx()]) continue;
        const HalffaceHandle other = mesh.opposite_halfface_handle(hf);
        if (!other.is_valid()) {
            faces.push_back({hf, mesh.combination(hf)});
        } else if (!is_in[TetMesh::incident_cell(other).idx()]) {
            faces.push_back({hf, not_skin});
        }
    }
    return faces;
}

/// Numbers combinations by their sets' order in the mesh, so that a cut doesn't change a colour.
template <class CombinationsOf>
std::map<CombinationId, std::size_t> ranks(const TetMesh& mesh, std::uint32_t n,
                                           const CombinationsOf& combination) {
    std::map<CombinationId, std::size_t> found;
    for (std::uint32_t i = 0; i < n; ++i)
        if (const auto id = combination(i)) found.emplace(*id, 0);
    std::vector<CombinationId> order;
    for (const auto& [id, rank] : found) order.push_back(id);
    std::sort(order.begin(), order.end(), [&](CombinationId a, CombinationId b) {
        return std::ranges::lexicographical_compare(mesh.sets_of(a), mesh.sets_of(b));
    });
    for (std::size_t k = 0; k < order.size(); ++k) found[order[k]] = k;
    return found;
}

std::map<CombinationId, std::size_t> cell_ranks(const TetMesh& mesh) {
    return ranks(mesh, mesh.n_cells(), [&](std::uint32_t i) {
        const CellHandle c(i);
        return mesh.is_deleted(c) ? std::nullopt : std::optional(mesh.combination(c));
    });
}

std::map<CombinationId, std::size_t> boundary_ranks(const TetMesh& mesh) {
    return ranks(mesh, mesh.n_halffaces(), [&](std::uint32_t i) {
        const HalffaceHandle hf(i);
        const bool counts = !mesh.is_deleted(hf) && mesh.is_boundary(hf);
        return counts ? std::optional(mesh.combination(hf)) : std::nullopt;
    });
}

std::string label(const TetMesh& mesh, CombinationId id) {
    std::string text;
    for (volmesh::SetHandle set : mesh.sets_of(id))
        text += (text.empty() ? "" : ", ") + mesh.set_info(set).name;
    return text;
}

/// Marks the sides of skin triangles where the next triangle is of another surface.
void find_creases(Scene& scene, const std::vector<VisibleFace>& faces) {
    struct Side {
        std::uint32_t low, high, triangle, side;
        auto operator<=>(const Side&) const = default;
    };
    std::vector<Side> sides;
    for (std::uint32_t t = 0; t < faces.size(); ++t)
        for (std::uint32_t k = 0; k < 3 && faces[t].surface != not_skin; ++k) {
            const auto [low, high] =
                std::minmax(scene.triangles[t].corners[k], scene.triangles[t].corners[(k + 1) % 3]);
            sides.push_back({low, high, t, k});
        }
    std::sort(sides.begin(), sides.end());
    for (std::size_t i = 1; i < sides.size(); ++i) {
        const Side& a = sides[i - 1];
        const Side& b = sides[i];
        if (a.low != b.low || a.high != b.high || faces[a.triangle].surface == faces[b.triangle].surface)
            continue;
        scene.triangles[a.triangle].is_crease[a.side] = true;
        scene.triangles[b.triangle].is_crease[b.side] = true;
    }
}

void add_points(Scene& scene, const TetMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (std::uint32_t i = 0; i < mesh.n_vertices(); ++i)
        if (!mesh.is_deleted(VertexHandle(i))) box.extend(mesh.point(VertexHandle(i)));
    const double radius = box.diagonal().norm() / 2;
    if (!(radius > 0)) throw InputError("the mesh has no extent: there is nothing to draw");
    for (const Point& p : mesh.points())
        scene.points.emplace_back(((p - box.center()) / radius).template cast<float>());
}

void add_legend(Scene& scene, const TetMesh& mesh, const std::vector<VisibleFace>& faces,
                const std::map<CombinationId, std::size_t>& regions,
                const std::map<CombinationId, std::size_t>& skins) {
    std::map<std::size_t, Scene::LegendEntry> region_entries;
    std::map<std::size_t, Scene::LegendEntry> skin_entries;
    for (std::size_t t = 0; t < faces.size(); ++t) {
        const CombinationId region = mesh.combination(TetMesh::incident_cell(faces[t].halfface));
        const std::size_t rank = regions.at(region);
        if (region != 0)
            region_entries.try_emplace(rank, Scene::LegendEntry{region_color(rank), label(mesh, region)});
        if (faces[t].surface != not_skin && faces[t].surface != 0)
            skin_entries.try_emplace(
                skins.at(faces[t].surface),
                Scene::LegendEntry{scene.triangles[t].color, label(mesh, faces[t].surface)});
    }
    for (auto& [rank, entry] : region_entries) scene.legend.push_back(std::move(entry));
    for (auto& [rank, entry] : skin_entries) scene.legend.push_back(std::move(entry));
}

}  // namespace

Scene make_scene(const TetMesh& mesh, const std::vector<Plane>& cut) {
    const std::vector<VisibleFace> faces = visible_faces(mesh, cut);
    if (faces.empty()) throw InputError("no cell of the mesh is left to draw");
    const auto regions = cell_ranks(mesh);
    const auto skins = boundary_ranks(mesh);
    Scene scene;
    add_points(scene, mesh);
    for (const VisibleFace& face : faces) {
        const auto v = mesh.halfface_vertices(face.halfface);
        const Color region =
            region_color(regions.at(mesh.combination(TetMesh::incident_cell(face.halfface))));
        scene.triangles.push_back(
            {{v[0].idx(), v[1].idx(), v[2].idx()},
             face.surface == not_skin ? region : skin_color(region, skins.at(face.surface))});
    }
    find_creases(scene, faces);
    add_legend(scene, mesh, faces, regions, skins);
    return scene;
}

}  // namespace maille::picture
