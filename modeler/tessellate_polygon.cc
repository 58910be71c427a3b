#include "modeler/tessellate_polygon.hh"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
/// Number of loops to cross on the way from infinity; -1: not yet known.
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<int, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel,
                                               CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

void number_by_depth(Triangulation& triangulation) {
    for (auto face : triangulation.all_face_handles()) face->info() = -1;
    std::vector<Triangulation::Face_handle> todo{triangulation.infinite_face()};
    todo.front()->info() = 0;
    while (!todo.empty()) {
        const auto face = todo.back();
        todo.pop_back();
        for (int i = 0; i < 3; ++i) {
            const auto neighbour = face->neighbor(i);
            if (neighbour->info() >= 0) continue;
            // Only the parity matters, and it is the same on every way.
            neighbour->info() = (face->info() + (face->is_constrained(i) ? 1 : 0)) % 2;
            todo.push_back(neighbour);
        }
    }
}

}  // namespace

std::vector<Triangle> triangulate(std::span<const Eigen::Vector2d> points,
                                  std::span<const std::vector<std::uint32_t>> loops) {
    const auto refuse = [] { throw InputError("a polygon crosses or touches itself"); };
    Triangulation triangulation;
    std::vector<Triangulation::Vertex_handle> vertices(points.size());
    Triangulation::Face_handle near;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        vertices[i] = triangulation.insert({points[i].x(), points[i].y()}, near);
        if (triangulation.number_of_vertices() != i + 1) refuse();
        vertices[i]->info() = i;
        near = vertices[i]->face();
    }
    try {
        for (const auto& loop : loops)
            for (std::size_t i = 0; i < loop.size(); ++i)
                triangulation.insert_constraint(vertices[loop[i]], vertices[loop[(i + 1) % loop.size()]]);
    } catch (const Triangulation::Intersection_of_constraints_exception&) {
        refuse();
    }
    for (const auto& loop : loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
            if (!triangulation.is_edge(vertices[loop[i]], vertices[loop[(i + 1) % loop.size()]])) refuse();

    number_by_depth(triangulation);
    std::vector<Triangle> triangles;
    for (auto face : triangulation.finite_face_handles())
        if (face->info() == 1)
            triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    return triangles;
}

}  // namespace maille::modeler
