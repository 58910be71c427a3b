#include <algorithm>
#include <array>
#include <vector>

#include <doctest/doctest.h>

#include "modeler/build_points.hh"
#include "modeler/model.hh"

namespace {

using namespace maille;
using namespace maille::modeler;
using volmesh::TetMesh;
using volmesh::VertexHandle;

/// A sphere and a cube whose side x- cuts it along a circle of radius 0.8.
Model sphere_and_cube() {
    return parse_model("sphere(1); translate([0.6, -2, -2]) cube(4);", "cut");
}

/// A tetrahedron for each of the points, which has one face on the sphere there and one on the cube's side.
Merged corners_at(const std::vector<Point>& places) {
    std::vector<Point> points;
    std::vector<std::array<std::uint32_t, 4>> cells;
    for (const Point& p : places) {
        const auto first = static_cast<std::uint32_t>(points.size());
        for (const Point& way : {Point(0, 0, 0), Point(-0.1, 0, 0), Point(0, -0.1, 0), Point(0, 0, -0.1)})
            points.push_back(p + way);
        cells.push_back({first, first + 1, first + 3, first + 2});
    }
    Merged merged;
    merged.mesh = TetMesh::from_cells(points, cells);
    for (const auto halfface : merged.mesh.boundary_halffaces()) {
        const volmesh::HalffaceHandle hf = halfface;
        double largest_x = -1e9, least_x = 1e9;
        for (const auto v : merged.mesh.halfface_vertices(hf)) {
            largest_x = std::max(largest_x, merged.mesh.point(v).x());
            least_x = std::min(least_x, merged.mesh.point(v).x());
        }
        merged.faces.push_back({hf, largest_x == least_x ? 1U : 0U});
    }
    return merged;
}

Operand operand(std::vector<Point> vertices) {
    return {"solid", 0.3, {std::move(vertices), {}, {}}, {}};
}

/// What the sphere gets.
std::vector<Point> points_of_sphere(const std::vector<Point>& corners, std::vector<Point> vertices_of_sphere,
                                    std::vector<Point> vertices_of_cube) {
    const Merged merged = corners_at(corners);
    std::vector<quality::ShortOfTarget> left;
    for (std::uint32_t i = 0; i < corners.size(); ++i)
        left.push_back({VertexHandle(4 * i), corners[i], {}, {}});
    const std::vector<Operand> operands{operand(std::move(vertices_of_sphere)),
                                        operand(std::move(vertices_of_cube))};
    const auto found = points_to_meet(sphere_and_cube(), operands, merged, left);
    CHECK(found.n_vertices == corners.size());
    const auto& all = found.points;
    CHECK(all[1].empty());  // it has no round face
    std::vector<Point> points;
    for (const FacePoint& each : all[0]) points.push_back(each.point);
    return points;
}

bool has(const std::vector<Point>& points, const Point& p) {
    return std::ranges::any_of(points, [&](const Point& q) { return q == p; });
}

double nearest(const std::vector<Point>& points, const Point& p) {
    double least = 1e9;
    for (const Point& q : points) least = std::min(least, (q - p).norm());
    return least;
}

}  // namespace

TEST_CASE("the points that surfaces get are where these meet, and where each is nearest") {
    const Point corner(0.6, 0.79, 0);
    const auto points = points_of_sphere({corner}, {}, {});
    CHECK(nearest(points, Point(0.6, 0.8, 0)) < 1e-12);
    CHECK(nearest(points, corner.normalized()) < 1e-12);
}

TEST_CASE("the points that surfaces get are those vertices of others that are next to them") {
    const Point corner(0.6, 0.79, 0);
    SUBCASE("one on the sphere, a little beside") {
        const Point vertex = Point(0.60001, 0.79999, 0.00001).normalized();
        const auto points = points_of_sphere({corner}, {}, {vertex});
        CHECK(has(points, vertex));
        CHECK(nearest(points, Point(0.6, 0.8, 0)) > 1e-6);
    }
    SUBCASE("the one that is there but for rounding, though another is not far") {
        const Point vertex(0.6, 0.8, 1e-13), other = Point(0.60001, 0.79999, 0.00001).normalized();
        CHECK(has(points_of_sphere({corner}, {other}, {vertex}), vertex));
    }
    SUBCASE("none where that is off the sphere") {
        const auto points = points_of_sphere({corner}, {}, {Point(0.60001, 0.80001, 0)});
        CHECK(nearest(points, Point(0.6, 0.8, 0)) > 1e-3);
    }
    SUBCASE("none of those further away") {
        const Point vertex = Point(0.61, 0.79, 0.01).normalized();
        const auto points = points_of_sphere({corner}, {vertex}, {});
        CHECK(nearest(points, Point(0.6, 0.8, 0)) < 1e-12);
        CHECK_FALSE(has(points, vertex));
    }
}

TEST_CASE("two points that surfaces would get next to each other are one") {
    const auto points = points_of_sphere({{0.6, 0.79, 0}, {0.6, 0.79, 1e-5}}, {}, {});
    CHECK(nearest(points, Point(0.6, 0.8, 0)) < 1e-12);
    for (const Point& p : points)
        for (const Point& q : points) CHECK((p == q || (p - q).norm() > 1e-3));
}
