#include "modeler/merge_planes.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Dense>

namespace maille::modeler {
namespace {

using Eigen::Vector3d;
using volmesh::HalffaceHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

constexpr std::uint32_t no_patch = 0xffffffff;

/// Faces beside each face, across its edges.
std::vector<std::vector<std::uint32_t>> neighbours(const TetMesh& mesh,
                                                   std::span<const HalffaceHandle> faces) {
    std::vector<std::pair<std::pair<VertexHandle, VertexHandle>, std::uint32_t>> edges;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const auto v = mesh.halfface_vertices(faces[f]);
        for (int k = 0; k < 3; ++k) edges.push_back({std::minmax(v[k], v[(k + 1) % 3]), f});
    }
    std::ranges::sort(edges);
    std::vector<std::vector<std::uint32_t>> result(faces.size());
    for (auto first = edges.begin(); first != edges.end();) {
        const auto last =
            std::find_if(first, edges.end(), [&](const auto& e) { return e.first != first->first; });
        for (auto a = first; a != last; ++a)
            for (auto b = first; b != last; ++b)
                if (a != b) result[a->second].push_back(b->second);
        first = last;
    }
    return result;
}

class Patcher {
  public:
    Patcher(const TetMesh& mesh, std::span<const HalffaceHandle> faces)
        : mesh_(mesh), faces_(faces), neighbours_(neighbours(mesh, faces)), order_(faces.size()) {
        Eigen::AlignedBox3d box;
        for (const Vector3d& p : mesh.points()) box.extend(p);
        tolerance_ = 1e-9 * box.diagonal().norm();
        std::vector<double> areas;
        for (const HalffaceHandle face : faces) areas.push_back(area_vector(face).norm());
        std::iota(order_.begin(), order_.end(), 0U);
        // The largest triangle tells the plane best.
        std::ranges::stable_sort(order_,
                                 [&](std::uint32_t a, std::uint32_t b) { return areas[a] > areas[b]; });
    }

    PlanarPatches patches() {
        result_.patch_of_face.assign(faces_.size(), no_patch);
        for (const std::uint32_t f : order_)
            if (result_.patch_of_face[f] == no_patch) grow(f);
        return std::move(result_);
    }

  private:
    Vector3d area_vector(HalffaceHandle face) const {
        const auto v = mesh_.halfface_vertices(face);
        const Vector3d& o = mesh_.point(v[0]);
        return (mesh_.point(v[1]) - o).cross(mesh_.point(v[2]) - o);
    }

    bool lies_on(std::uint32_t face, const Plane& plane) const {
        return std::ranges::all_of(mesh_.halfface_vertices(faces_[face]), [&](VertexHandle v) {
            return std::abs(plane.normal.dot(mesh_.point(v) - plane.point)) <= tolerance_;
        });
    }

    void grow(std::uint32_t seed) {
        const auto number = static_cast<std::uint32_t>(result_.planes.size());
        const HalffaceHandle example = faces_[seed];
        const Plane plane{mesh_.point(mesh_.halfface_vertices(example)[0]),
                          area_vector(example).normalized()};
        result_.planes.push_back(plane);
        result_.examples.push_back(example);
        result_.patch_of_face[seed] = number;
        std::vector<std::uint32_t> open{seed};
        while (!open.empty()) {
            const std::uint32_t face = open.back();
            open.pop_back();
            for (const std::uint32_t next : neighbours_[face]) {
                if (result_.patch_of_face[next] != no_patch || !lies_on(next, plane)) continue;
                if (mesh_.combination(faces_[next]) != mesh_.combination(example)) continue;
                result_.patch_of_face[next] = number;
                open.push_back(next);
            }
        }
    }

    const TetMesh& mesh_;
    std::span<const HalffaceHandle> faces_;
    std::vector<std::vector<std::uint32_t>> neighbours_;
    std::vector<std::uint32_t> order_;
    double tolerance_;
    PlanarPatches result_;
};

}  // namespace

PlanarPatches planar_patches(const TetMesh& mesh, std::span<const HalffaceHandle> faces) {
    return Patcher(mesh, faces).patches();
}

std::optional<Vector3d> nearest_on_planes(std::span<const Plane> planes, const Vector3d& p) {
    Eigen::MatrixX3d normals(planes.size(), 3);
    Eigen::VectorXd heights(planes.size());
    double scale = 0;
    for (Eigen::Index i = 0; i < normals.rows(); ++i) {
        const Plane& plane = planes[static_cast<std::size_t>(i)];
        normals.row(i) = plane.normal;
        heights[i] = plane.normal.dot(plane.point - p);
        scale = std::max(scale, (plane.point - p).norm());
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixX3d> solver;
    solver.setThreshold(1e-6);
    solver.compute(normals);
    const Vector3d step = solver.solve(heights);
    if ((normals * step - heights).norm() > 1e-8 * scale) return std::nullopt;
    return p + step;
}

}  // namespace maille::modeler
