#include "modeler/shape_distance.hh"

#include <cmath>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

namespace maille::modeler {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using AabbTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Mesh>>>;

Mesh make_mesh(std::span<const Point> points, std::span<const std::array<std::uint32_t, 3>> triangles) {
    Mesh mesh;
    for (const Point& p : points) mesh.add_vertex({p.x(), p.y(), p.z()});
    for (const auto& [a, b, c] : triangles)
        mesh.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c));
    return mesh;
}

}  // namespace

struct SignedDistance::Tree {
    Tree(std::span<const Point> points, std::span<const std::array<std::uint32_t, 3>> triangles)
        : mesh(make_mesh(points, triangles)), tree(faces(mesh).first, faces(mesh).second, mesh), side(tree) {
        tree.build();
        tree.accelerate_distance_queries();
    }

    Mesh mesh;
    AabbTree tree;
    CGAL::Side_of_triangle_mesh<Mesh, Kernel> side;
};

SignedDistance::SignedDistance(std::span<const Point> points,
                               std::span<const std::array<std::uint32_t, 3>> triangles)
    : tree_(std::make_unique<Tree>(points, triangles)) {}

SignedDistance::~SignedDistance() = default;

double SignedDistance::operator()(const Point& p) const {
    const Kernel::Point_3 query(p.x(), p.y(), p.z());
    const double distance = std::sqrt(tree_->tree.squared_distance(query));
    switch (tree_->side(query)) {
        case CGAL::ON_BOUNDED_SIDE:
            return -distance;
        case CGAL::ON_UNBOUNDED_SIDE:
            return distance;
        default:
            return 0;
    }
}

}  // namespace maille::modeler
