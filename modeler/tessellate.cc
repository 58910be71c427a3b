#include "modeler/tessellate.hh"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "modeler/tessellate_improve.hh"
#include "modeler/tessellate_refine.hh"
#include "modeler/tessellate_seed.hh"
#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

using volmesh::TriMesh;
using SurfaceProperty = OpenMesh::FPropHandleT<std::uint32_t>;
constexpr const char* surface_property = "surface";

/// Calls the function with the shape as what it is.
template <class Function>
void visit(const Shape& shape, const Function& function) {
    if (const auto* ellipsoid = dynamic_cast<const Ellipsoid*>(&shape))
        function(*ellipsoid);
    else if (const auto* torus = dynamic_cast<const Torus*>(&shape))
        function(*torus);
    else if (const auto* cone = dynamic_cast<const Cone*>(&shape))
        function(*cone);
    else if (const auto* turned = dynamic_cast<const Turned*>(&shape))
        function(*turned);
    else if (const auto* polyhedron = dynamic_cast<const Polyhedron*>(&shape))
        function(*polyhedron);
    else
        throw std::logic_error("a shape of a kind that cannot be tessellated");
}

/// Area in triangles of the wanted size, roughly: the bounding box's is no less than half the solid's.
void check_count(const Shape& shape, const Sizing& sizing) {
    constexpr double most = 5e7;
    const Eigen::Vector3d d = shape.bounding_box().sizes();
    double length = sizing.size();
    for (std::uint32_t face = 0; face < shape.faces().size(); ++face)
        length = std::min(length, sizing.for_curvature(shape.max_curvature(face)));
    const double area = 2 * (d.x() * d.y() + d.y() * d.z() + d.z() * d.x());
    const double triangles = area / (length * length * std::sqrt(3) / 4);
    if (!(triangles < most))
        throw InputError(
            fmt::format("edges of {:.3g} make some {:.2g} triangles of the surface; the most is {:.2g}: "
                        "give a larger size",
                        length, triangles, most));
}

Sizing sizing_of(const Cone& cone, const TessellateOptions& options) {
    return {cone, options, thinnest_radius(cone)};
}

SurfaceSeed seed_shared(const Cone& shape, const TessellateOptions& options, const Sizing&) {
    const auto& shared = std::get<SharedCone>(options.shared->cut);
    return seed_shared_surface(shape, sizing_of(shared.reference, options), shared);
}

SurfaceSeed seed_shared_round(const Shape& shape, const TessellateOptions& options, const Sizing& sizing) {
    const auto& shared = std::get<SharedRound>(options.shared->cut);
    return seed_shared_surface(shape, sizing, sizing_of(shared.reference, options), shared);
}

SurfaceSeed seed_shared(const Ellipsoid& shape, const TessellateOptions& options, const Sizing& sizing) {
    const auto* sphere = std::get_if<SharedSphere>(&options.shared->cut);
    return sphere != nullptr ? seed_shared_surface(shape, *sphere)
                             : seed_shared_round(shape, options, sizing);
}

SurfaceSeed seed_shared(const Torus& shape, const TessellateOptions& options, const Sizing& sizing) {
    return seed_shared_round(shape, options, sizing);
}

SurfaceSeed seed_shared(const Shape&, const TessellateOptions&, const Sizing&) {
    throw std::logic_error("a shape of a kind that shares no surfaces");
}

/// How to cut the surface where nothing is asked for in particular.
TessellateOptions coarse(TessellateOptions options) {
    if (options.within.isEmpty()) return options;
    options.size = std::max(options.size, options.size_beyond);
    options.chord_tolerance = 0;
    return options;
}

TriMesh to_mesh(const SurfaceSeed& seed) {
    TriMesh mesh;
    mesh.reserve(seed.points.size(), 3 * seed.triangles.size() / 2, seed.triangles.size());
    for (const Point& p : seed.points) mesh.add_vertex(p);
    SurfaceProperty property;
    mesh.add_property(property, surface_property);
    for (std::size_t i = 0; i < seed.triangles.size(); ++i) {
        const auto [a, b, c] = seed.triangles[i];
        const auto handle = [](std::uint32_t vertex) {
            return TriMesh::VertexHandle(static_cast<int>(vertex));
        };
        const auto face = mesh.add_face(handle(a), handle(b), handle(c));
        if (!face.is_valid()) throw std::logic_error("the tessellation of a primitive is not a manifold");
        mesh.property(property, face) = seed.surfaces[i];
    }
    return mesh;
}

}  // namespace

TriMesh tessellate(const Primitive& primitive, const TessellateOptions& wanted) {
    if (!(wanted.size > 0) || !std::isfinite(wanted.size))
        throw InputError(
            fmt::format("the size of the edges is {}; it has to be greater than 0", wanted.size));
    if (!(wanted.chord_tolerance >= 0))
        throw InputError(
            fmt::format("the chord tolerance is {}; it must not be negative", wanted.chord_tolerance));
    const TessellateOptions options = coarse(wanted);
    TriMesh mesh;
    visit(*primitive.shape, [&](const auto& shape) {
        const Sizing sizing(shape, options, thinnest_radius(shape));
        check_count(shape, sizing);
        const SurfaceSeed seed =
            options.shared ? seed_shared(shape, options, sizing) : seed_surface(shape, sizing);
        mesh = to_mesh(seed);
        const bool is_planar = std::ranges::all_of(shape.faces(), &PrimitiveFace::planar);
        if (options.is_draft && is_planar) return;
        improve(mesh, shape, sizing, seed.corners, options.shared != nullptr);
        if (!options.within.isEmpty())
            refine_within(mesh, shape, Sizing(shape, wanted, thinnest_radius(shape)), options.within);
    });
    return mesh;
}

TriMesh tessellate(const Primitive& primitive, double size) {
    return tessellate(primitive, TessellateOptions{.size = size});
}

std::uint32_t surface_of(const TriMesh& mesh, TriMesh::FaceHandle face) {
    SurfaceProperty property;
    if (!mesh.get_property_handle(property, surface_property))
        throw std::logic_error("the mesh does not know the surfaces of its triangles");
    return mesh.property(property, face);
}

void set_surface(TriMesh& mesh, TriMesh::FaceHandle face, std::uint32_t surface) {
    SurfaceProperty property;
    if (!mesh.get_property_handle(property, surface_property)) mesh.add_property(property, surface_property);
    mesh.property(property, face) = surface;
}

}  // namespace maille::modeler
