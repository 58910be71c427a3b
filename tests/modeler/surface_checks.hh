#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "modeler/shapes.hh"
#include "modeler/tessellate.hh"

namespace maille::modeler::test {

/// What a tessellation is measured by.
struct SurfaceFigures {
    bool closed = true;
    bool oriented = true;  ///< every triangle faces outwards
    double area = 0;
    double volume = 0;
    double min_angle = 180;  ///< degrees
    double shortest = 1e300, longest = 0, mean_edge = 0;
    double off_surface = 0;  ///< greatest distance of a vertex from a face it belongs to
    int euler = 0;
    std::set<std::uint32_t> surfaces;
};

inline SurfaceFigures measure(const volmesh::TriMesh& mesh, const Shape& shape) {
    SurfaceFigures figures;
    for (auto f : mesh.faces()) {
        std::array<Point, 3> p;
        std::ranges::transform(mesh.fv_range(f), p.begin(), [&](auto v) { return mesh.point(v); });
        const std::uint32_t surface = surface_of(mesh, f);
        figures.surfaces.insert(surface);
        const Point normal = (p[1] - p[0]).cross(p[2] - p[0]);
        figures.area += normal.norm() / 2;
        figures.volume += p[0].dot(p[1].cross(p[2])) / 6;
        figures.oriented &= normal.dot(shape.face_normal(surface, (p[0] + p[1] + p[2]) / 3)) > 0;
        for (int i = 0; i < 3; ++i) {
            const Point a = p[(i + 1) % 3] - p[i], b = p[(i + 2) % 3] - p[i];
            figures.min_angle =
                std::min(figures.min_angle, std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi);
            figures.off_surface = std::max(figures.off_surface, (p[i] - shape.project(surface, p[i])).norm());
        }
    }
    for (auto e : mesh.edges()) {
        const double length = mesh.calc_edge_length(e);
        figures.shortest = std::min(figures.shortest, length);
        figures.longest = std::max(figures.longest, length);
        figures.mean_edge += length / static_cast<double>(mesh.n_edges());
        figures.closed &= !mesh.is_boundary(e);
    }
    for (auto v : mesh.vertices()) figures.closed &= mesh.is_manifold(v) && !mesh.is_isolated(v);
    figures.euler = static_cast<int>(mesh.n_vertices() + mesh.n_faces()) - static_cast<int>(mesh.n_edges());
    return figures;
}

/// An affine map whose stretches are within a factor of `anisotropy`; a mirror as likely as not.
inline Eigen::Affine3d random_frame(std::mt19937& random, double anisotropy) {
    std::uniform_real_distribution<double> coordinate(-1, 1);
    const auto rotation = [&] {
        const Eigen::Vector4d q(coordinate(random), coordinate(random), coordinate(random),
                                coordinate(random));
        return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
    };
    Eigen::Vector3d stretch;
    for (double& s : stretch) s = std::pow(anisotropy, coordinate(random) / 2);
    if (coordinate(random) < 0) stretch.x() = -stretch.x();
    Eigen::Affine3d frame = Eigen::Affine3d::Identity();
    const Eigen::Matrix3d first = rotation();
    frame.linear() = first * stretch.asDiagonal() * rotation();
    for (double& t : frame.translation()) t = coordinate(random);
    return frame;
}

}  // namespace maille::modeler::test
