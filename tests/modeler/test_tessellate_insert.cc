#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "modeler/shapes.hh"
#include "modeler/tessellate.hh"
#include "modeler/tessellate_insert.hh"
#include "tests/modeler/surface_checks.hh"

namespace {

using namespace maille;
using namespace maille::modeler;
using volmesh::TriMesh;

Primitive primitive(std::shared_ptr<const Shape> shape) {
    return {std::move(shape), "solid", "", 0};
}

bool has_vertex(const TriMesh& mesh, const Point& p) {
    return std::ranges::any_of(mesh.vertices(), [&](const auto v) { return mesh.point(v) == p; });
}

void check_surface(const TriMesh& mesh, const Shape& shape, int euler) {
    const auto figures = test::measure(mesh, shape);
    CHECK(figures.closed);
    CHECK(figures.oriented);
    CHECK(figures.off_surface < 1e-12);
    CHECK(figures.euler == euler);
}

}  // namespace

TEST_CASE("points of round faces become vertices, and the tessellation stays one") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(-1, 1);
    for (const auto& shape : {make_sphere(1), make_cylinder(2, 1, 1, true), make_cylinder(2, 1, 0.4, true),
                              make_torus(1, 0.4), make_ellipsoid({1, 0.7, 0.5})}) {
        TriMesh mesh = tessellate(primitive(shape), 0.4);
        const std::size_t before = mesh.n_vertices();
        const int euler = test::measure(mesh, *shape).euler;
        std::vector<FacePoint> points;
        while (points.size() < 20) {
            const Point p = shape->project(0, Point(number(random), number(random), number(random)));
            if (std::abs(shape->implicit(p)) < 1e-9) points.push_back({0, p});
        }
        insert_points(mesh, *shape, points);
        for (const FacePoint& point : points) CHECK(has_vertex(mesh, point.point));
        CHECK(mesh.n_vertices() == before + points.size());
        check_surface(mesh, *shape, euler);
        insert_points(mesh, *shape, points);
        CHECK(mesh.n_vertices() == before + points.size());
    }
}

TEST_CASE("a point of a rim divides both faces, and one beyond the face is left out") {
    const auto shape = make_cylinder(2, 1, 1, false);
    TriMesh mesh = tessellate(primitive(shape), 0.5);
    const std::size_t before = mesh.n_vertices();
    const Point on_rim(std::cos(0.1), std::sin(0.1), 2), beyond(1, 0, 2.5);
    insert_points(mesh, *shape, std::vector<FacePoint>{{0, on_rim}, {0, beyond}});
    CHECK(mesh.n_vertices() == before + 1);
    CHECK(has_vertex(mesh, on_rim));
    check_surface(mesh, *shape, 2);
}
