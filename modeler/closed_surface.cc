#include "modeler/closed_surface.hh"

#include "modeler/tessellate.hh"

namespace maille::modeler {

ClosedSurface closed_surface(const volmesh::TriMesh& tessellation, std::uint32_t first_surface) {
    ClosedSurface result;
    for (const auto v : tessellation.vertices()) result.points.push_back(tessellation.point(v));
    for (const auto f : tessellation.faces()) {
        std::array<std::uint32_t, 3> triangle{};
        auto corner = triangle.begin();
        for (const auto v : tessellation.fv_range(f)) *corner++ = static_cast<std::uint32_t>(v.idx());
        result.triangles.push_back(triangle);
        result.surfaces.push_back(first_surface + surface_of(tessellation, f));
    }
    return result;
}

ClosedSurface closed_surface(const Polyhedron& shape) {
    ClosedSurface result{
        .points = {shape.points().begin(), shape.points().end()}, .triangles = {}, .surfaces = {}};
    for (std::uint32_t face = 0; face < shape.faces().size(); ++face)
        for (const auto& triangle :
             triangulate_polygon(shape.points(), shape.polygon(face).loops, shape.plane(face))) {
            result.triangles.push_back(triangle);
            result.surfaces.push_back(face);
        }
    return result;
}

}  // namespace maille::modeler
