#include <algorithm>
#include <cmath>
#include <numbers>
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

/// Edges of the rim at that height of a cylinder of radius 1.
int edges_of_rim(const TriMesh& mesh, double height) {
    int count = 0;
    for (const auto v : mesh.vertices())
        count += mesh.point(v).z() == height && std::abs(mesh.point(v).head<2>().norm() - 1) < 1e-9;
    return count;
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
    }
}

TEST_CASE(
    "a point that is given again halves the edges there, and the triangles come nearer to the surface") {
    for (const auto& shape : {make_sphere(1), make_cylinder(2, 1, 1, true), make_torus(1, 0.4)}) {
        const Point p = shape->project(0, Point(0.7, 0.4, 0.2));
        const int euler = test::measure(tessellate(primitive(shape), 0.4), *shape).euler;
        std::vector<FacePoint> points;
        double before = 0;
        for (int times = 1; times <= 4; ++times) {
            points.push_back({0, p});
            TriMesh mesh = tessellate(primitive(shape), 0.4);
            insert_points(mesh, *shape, points);
            check_surface(mesh, *shape, euler);
            CHECK(has_vertex(mesh, p));
            double depth = 0;  // of the triangles at the point below the surface
            for (const auto f : mesh.faces())
                if (std::ranges::any_of(mesh.fv_range(f), [&](const auto v) { return mesh.point(v) == p; }))
                    depth = std::max(depth, std::abs(shape->implicit(mesh.calc_face_centroid(f))));
            if (times > 1) CHECK(depth < 0.5 * before);
            before = depth;
        }
    }
}

TEST_CASE("a point between a rim's straight edge and the rim divides that edge first") {
    const auto shape = make_cylinder(2, 1, 1, false);
    const TriMesh before = tessellate(primitive(shape), 0.8);
    // Of the rim of the cap, where it is farthest from the edges.
    const double angle = std::numbers::pi / static_cast<double>(edges_of_rim(before, 2));
    for (const Point& p : {Point(0.97 * std::cos(angle), 0.97 * std::sin(angle), 2),
                           Point(std::cos(angle), std::sin(angle), 1.95)}) {
        TriMesh mesh = before;
        insert_points(mesh, *shape, std::vector<FacePoint>{{p.z() == 2 ? 2U : 0U, p}});
        CHECK(has_vertex(mesh, p));
        check_surface(mesh, *shape, 2);
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
