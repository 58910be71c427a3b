// The one place that computes convex hulls in space.
#include "modeler/hull.hh"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include "modeler/coplanar_facets.hh"
#include "volmesh/error.hh"

namespace maille::modeler {

std::shared_ptr<const Shape> make_hull(const std::vector<Point>& points, const Eigen::Affine3d& frame) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
    std::vector<Kernel::Point_3> input;
    for (const Point& p : points) input.emplace_back(p.x(), p.y(), p.z());
    Mesh hull;
    if (input.size() >= 4) CGAL::convex_hull_3(input.begin(), input.end(), hull);
    if (hull.number_of_faces() < 4) throw InputError("the hull is flat: it encloses no volume");

    std::vector<Point> corners(hull.num_vertices());
    for (const auto v : hull.vertices())
        corners[v.idx()] = {hull.point(v).x(), hull.point(v).y(), hull.point(v).z()};
    std::vector<Triple> triangles;
    for (const auto f : hull.faces()) {
        auto corner = triangles.emplace_back().begin();
        for (const auto v : hull.vertices_around_face(hull.halfedge(f))) *corner++ = v.idx();
    }
    auto faces = merge_coplanar(corners, triangles);
    return make_polyhedron(std::move(corners), std::move(faces), frame);
}

}  // namespace maille::modeler
