#include "quality/support.hh"

#include <algorithm>
#include <atomic>

#include <Eigen/Geometry>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "volmesh/strata.hh"

namespace maille::quality {
namespace {

using volmesh::CellHandle;
using volmesh::CombinationId;
using volmesh::HalffaceHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

/// Faces that turn by less than this, in radians, are in one plane.
constexpr double flat_angle = 1e-9;

/// The faces met at a vertex so far, to tell where two parts of one surface meet: faces on the same surfaces
/// but in different sets.
struct FaceKind {
    CombinationId sets;
    Surfaces surfaces;
    friend bool operator==(const FaceKind&, const FaceKind&) = default;
};
using FaceKinds = boost::container::small_vector<FaceKind, 3>;

void add_plane(Freedom& freedom, const Point& normal) {
    for (const Point& known : freedom.normals)
        if (known.cross(normal).norm() < flat_angle) return;
    freedom.normals.push_back(normal);
    freedom.is_fixed |= freedom.normals.size() > 2;
}

Point unit_normal(const TetMesh& mesh, HalffaceHandle hf) {
    const auto v = mesh.halfface_vertices(hf);
    const Point& p = mesh.point(v[0]);
    return (mesh.point(v[1]) - p).cross(mesh.point(v[2]) - p).stableNormalized();
}

/// On planes alone, a curve must be where they meet: two of them, and no set ends within one.
bool is_stuck_in_planes(const TetMesh& mesh, VertexHandle v, const volmesh::CellList& cells,
                        const Freedom& freedom) {
    const int stratum = volmesh::stratum(mesh, v, cells);
    return stratum == 0 || (stratum == 1 && freedom.normals.size() != 2);
}

}  // namespace

Freedom Freedoms::operator()(VertexHandle v, const volmesh::CellList& cells) {
    Freedom freedom;
    const Freedom fixed{true, {}, {}};
    if (cells.empty() || mesh_.combination(v) != 0) return fixed;
    FaceKinds met;
    bool has_unknown = false;
    for (CellHandle c : cells) {
        const int at = mesh_.local_vertex(c, v);
        for (int i = 0; i < 4; ++i) {
            if (i == at) continue;
            if (mesh_.combination(c, volmesh::tet::edge_between[at][i]) != 0) return fixed;
            const HalffaceHandle hf = TetMesh::halfface(c, i);
            if (!volmesh::is_interface(mesh_, hf)) continue;
            const FaceKind kind{mesh_.combination(hf), surfaces_of_(hf)};
            if (kind.surfaces.empty()) {
                has_unknown = true;
                add_plane(freedom, unit_normal(mesh_, hf));
                if (freedom.is_fixed) return fixed;
                continue;
            }
            if (std::ranges::find(met, kind) != met.end()) continue;
            const auto has_same = [&](const auto& other) { return other.surfaces == kind.surfaces; };
            if (std::ranges::any_of(met, has_same)) return fixed;
            met.push_back(kind);
            volmesh::add(freedom.surfaces, kind.surfaces);
        }
    }
    if (has_unknown && (!met.empty() || is_stuck_in_planes(mesh_, v, cells, freedom))) return fixed;
    return freedom;
}

Eigen::Matrix3d Constraint::onto_planes() const {
    const auto& normals = freedom_.normals;
    if (normals.size() == 2) {
        const Point along = normals[0].cross(normals[1]).normalized();
        return along * along.transpose();
    }
    return Eigen::Matrix3d::Identity() - normals[0] * normals[0].transpose();
}

std::optional<Point> Constraint::nearest(const Point& p) const {
    if (!freedom_.surfaces.empty())
        return projector_->project({freedom_.surfaces.data(), freedom_.surfaces.size()}, p);
    if (!freedom_.normals.empty()) return at_ + onto_planes() * (p - at_);
    return p;
}

std::optional<Eigen::Matrix3d> Constraint::tangent(double reach) const {
    if (freedom_.is_free()) return Eigen::Matrix3d::Identity();
    if (!freedom_.normals.empty()) return onto_planes();
    const double step = 1e-3 * reach;
    const auto here = nearest(at_);
    if (!here || (*here - at_).norm() > 1e-2 * step) return std::nullopt;
    Eigen::Matrix3d result;
    for (int k = 0; k < 3; ++k) {
        const auto there = nearest(at_ + step * Point::Unit(k));
        if (!there) return std::nullopt;
        result.col(k) = (*there - *here) / step;
    }
    return result;
}

std::vector<std::uint8_t> free_vertices(const TetMesh& mesh) {
    std::vector<std::uint8_t> is_free(mesh.n_vertices(), 1);
    const auto bind = [&](VertexHandle v) {
        std::atomic_ref(is_free[v.idx()]).store(0, std::memory_order_relaxed);
    };
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, mesh.n_cells(), 4096), [&](const auto& range) {
        for (std::uint32_t i = range.begin(); i < range.end(); ++i) {
            const CellHandle c(i);
            if (mesh.is_deleted(c)) continue;
            for (int f = 0; f < 4; ++f) {
                const auto hf = TetMesh::halfface(c, f);
                if (volmesh::is_interface(mesh, hf)) std::ranges::for_each(mesh.halfface_vertices(hf), bind);
            }
            for (int e = 0; e < 6; ++e) {
                if (mesh.combination(c, e) == 0) continue;
                for (const int end : volmesh::tet::edge_vertices[e]) bind(mesh.cell_vertex(c, end));
            }
        }
    });
    for (std::uint32_t i = 0; i < mesh.n_vertices(); ++i)
        if (mesh.combination(VertexHandle(i)) != 0) is_free[i] = 0;
    return is_free;
}

}  // namespace maille::quality
