#include <limits>
#include <numbers>
#include <string>

#include <doctest/doctest.h>

#include "modeler/tessellate.hh"
#include "surface_checks.hh"
#include "volmesh/error.hh"

using namespace maille::modeler;
using std::numbers::pi;

namespace {

using ShapePointer = std::shared_ptr<const Shape>;

maille::volmesh::TriMesh tessellate_shape(const ShapePointer& shape, double size,
                                          double chord_tolerance = 0) {
    return tessellate({shape, "part", "", 0}, {.size = size, .chord_tolerance = chord_tolerance});
}

test::SurfaceFigures figures(const ShapePointer& shape, double size, double chord_tolerance = 0) {
    return test::measure(tessellate_shape(shape, size, chord_tolerance), *shape);
}

/// What every tessellation has to be, whatever the shape and size.
void check_sound(const test::SurfaceFigures& f, const Shape& shape, int euler) {
    const double size =
        shape.bounding_box().diagonal().norm() + shape.bounding_box().max().cwiseAbs().maxCoeff();
    CHECK(f.closed);
    CHECK(f.oriented);
    CHECK(f.euler == euler);
    CHECK(f.off_surface <= 1e-14 * size);
    CHECK(f.surfaces.size() == shape.faces().size());
}

struct Solid {
    const char* name;
    ShapePointer shape;
    double volume, area;
    double min_angle;  ///< degrees, of a tessellation of size 0.15
    int euler = 2;
};

std::vector<Solid> solids(const Eigen::Affine3d& frame = Eigen::Affine3d::Identity()) {
    const double slant = std::sqrt(1 + 0.25);
    return {
        {"box", make_cube({1, 0.8, 0.6}, true, frame), 0.48, 2 * (0.8 + 0.48 + 0.6), 30},
        {"sphere", make_sphere(1, frame), 4 * pi / 3, 4 * pi, 45},
        {"cylinder", make_cylinder(1, 0.5, 0.5, true, frame), pi / 4, 1.5 * pi, 30},
        {"cone", make_cylinder(1, 0.5, 0, false, frame), pi / 12, pi / 4 + pi * 0.5 * slant, 20},
        {"frustum", make_cylinder(1, 1, 0.5, false, frame), pi * 1.75 / 3, 1.25 * pi + pi * 1.5 * slant, 30},
        {"torus", make_torus(1, 0.4, frame), 2 * pi * pi * 0.16, 4 * pi * pi * 0.4, 30, 0},
        {"prism", make_prism(6, 1, 0.5, frame), 1.5 * std::sqrt(3) * 0.5, 3 * std::sqrt(3) + 3, 30}};
}

}  // namespace

TEST_CASE("Tessellations are closed, oriented, on the surface and of good shape") {
    for (const Solid& solid : solids()) {
        CAPTURE(solid.name);
        const auto f = figures(solid.shape, 0.15);
        check_sound(f, *solid.shape, solid.euler);
        CHECK(f.min_angle >= solid.min_angle);
        CHECK(f.longest < 2 * 0.15);
        CHECK(f.mean_edge > 0.7 * 0.15);
        CHECK(f.mean_edge < 1.2 * 0.15);
    }
}

TEST_CASE("Volumes and areas converge to the true ones, at second order") {
    for (const Solid& solid : solids()) {
        CAPTURE(solid.name);
        const auto coarse = figures(solid.shape, 0.2), fine = figures(solid.shape, 0.05);
        const bool is_round = solid.shape->max_curvature(0) > 0;
        // 16 in the limit; near an apex the coarse one's eight edges to a circle are more than its size asks
        // for.
        const double factor = solid.name == std::string("cone") ? 9 : 14;
        for (auto [c, f, exact] : {std::tuple(coarse.volume, fine.volume, solid.volume),
                                   std::tuple(coarse.area, fine.area, solid.area)}) {
            if (is_round) {
                CHECK(std::abs(f - exact) < std::abs(c - exact) / factor);
                CHECK(std::abs(f - exact) < 5e-3 * exact);
            } else {
                CHECK(std::abs(f - exact) < 1e-13 * exact);
            }
        }
    }
}

TEST_CASE("With half the size a sphere has four times the triangles") {
    const auto sphere = make_sphere(1);
    for (double size = 0.1; size < 0.3; size *= 1.09) {
        CAPTURE(size);
        CHECK(tessellate_shape(sphere, size / 2).n_faces() == 4 * tessellate_shape(sphere, size).n_faces());
    }
}

TEST_CASE("Affine images: mirrors, stretches and shears") {
    constexpr unsigned seed = 17;
    MESSAGE("seed " << seed);
    std::mt19937 random(seed);
    for (int round = 0; round < 6; ++round) {
        const Eigen::Affine3d frame = test::random_frame(random, 3);
        const double stretch = std::abs(frame.linear().determinant());
        for (const Solid& solid : solids(frame)) {
            CAPTURE(solid.name);
            CAPTURE(round);
            const auto f = figures(solid.shape, 0.15);
            check_sound(f, *solid.shape, solid.euler);
            CHECK(f.volume == doctest::Approx(stretch * solid.volume).epsilon(0.05));
            CHECK(f.min_angle > 15);
        }
    }
}

TEST_CASE("However large the size, a circle has eight edges and the surface stays closed") {
    for (const Solid& solid : solids()) {
        CAPTURE(solid.name);
        const auto f = figures(solid.shape, 1000);
        check_sound(f, *solid.shape, solid.euler);
        CHECK(f.volume > 0.8 * solid.volume);
    }
}

TEST_CASE("Features much smaller than the size") {
    const std::vector<std::pair<ShapePointer, int>> thin{{make_cube({1, 1, 0.01}, false), 2},
                                                         {make_cube({1, 0.01, 0.01}, false), 2},
                                                         {make_cylinder(0.01, 1, 1, false), 2},
                                                         {make_cylinder(1, 0.01, 0.01, false), 2},
                                                         {make_cylinder(1, 0.5, 0.001, false), 2},
                                                         {make_ellipsoid({1, 1, 0.1}), 2},
                                                         {make_torus(1, 0.02), 0},
                                                         {make_wedge({1, 1, 1}, 0.001), 2},
                                                         {make_prism(40, 1, 0.02), 2}};
    for (const auto& [shape, euler] : thin) {
        CAPTURE(&shape - &thin.front().first);
        check_sound(figures(shape, 0.2), *shape, euler);
    }
}

TEST_CASE("The chord tolerance bounds the distance from the true surface") {
    const auto sphere = make_sphere(1);
    for (double tolerance : {0.02, 0.005}) {
        const auto mesh = tessellate_shape(sphere, 10, tolerance);
        double farthest = 0;
        for (auto f : mesh.faces()) farthest = std::max(farthest, 1 - mesh.calc_face_centroid(f).norm());
        CHECK(farthest < tolerance);
        CHECK(farthest > 0.3 * tolerance);
    }
}

TEST_CASE("Planar faces are exactly planar, and their rims lie on both faces") {
    const auto shape = make_cylinder(1, 0.5, 0.5, false);
    const auto mesh = tessellate_shape(shape, 0.1);
    std::size_t rim = 0;
    for (auto f : mesh.faces())
        for (auto v : mesh.fv_range(f)) {
            if (surface_of(mesh, f) == 1) CHECK(mesh.point(v).z() == 0);
            if (surface_of(mesh, f) == 2) CHECK(mesh.point(v).z() == 1);
        }
    for (auto e : mesh.edges()) {
        const auto one = surface_of(mesh, e.h0().face()), other = surface_of(mesh, e.h1().face());
        if (one == other) continue;
        ++rim;
        CHECK(std::abs(mesh.point(e.v0()).head<2>().norm() - 0.5) < 1e-15);
    }
    CHECK(rim == 64);
}

TEST_CASE("Concave polyhedra, with holes") {
    // A square frame: 3 x 3 x 1 with a 1 x 1 hole through it.
    std::vector<Point> points;
    for (double z : {0.0, 1.0})
        for (auto [x, y] : {std::pair(0, 0), {3, 0}, {3, 3}, {0, 3}, {1, 1}, {2, 1}, {2, 2}, {1, 2}})
            points.emplace_back(x, y, z);
    std::vector<PolyhedronFace> faces{{{{3, 2, 1, 0}, {4, 5, 6, 7}}, "bottom"},
                                      {{{8, 9, 10, 11}, {15, 14, 13, 12}}, "top"}};
    for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t next = (i + 1) % 4;
        faces.push_back({{{i, next, 8 + next, 8 + i}}, "outside"});
        faces.push_back({{{4 + next, 4 + i, 12 + i, 12 + next}}, "inside"});
    }
    const auto shape = make_polyhedron(points, faces);
    const auto f = figures(shape, 0.3);
    check_sound(f, *shape, 0);
    CHECK(f.volume == doctest::Approx(8).epsilon(1e-13));
    CHECK(f.area == doctest::Approx(16 + 12 + 4).epsilon(1e-13));
    CHECK(f.min_angle > 28);
}

TEST_CASE("The same input gives the same bits") {
    const auto shape = make_cylinder(1, 0.5, 0.2, false);
    const auto one = tessellate_shape(shape, 0.1), two = tessellate_shape(shape, 0.1);
    REQUIRE(one.n_vertices() == two.n_vertices());
    for (auto v : one.vertices()) CHECK(one.point(v) == two.point(v));
}

TEST_CASE("Sizes that make no sense are refused") {
    const auto shape = make_cube({1, 1, 1}, false);
    for (double size :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e-6})
        CHECK_THROWS_AS(figures(shape, size), maille::InputError);
    CHECK_THROWS_AS(figures(shape, 1, -1), maille::InputError);
}

TEST_CASE("triangles are small where it is asked for, and on the surface all over") {
    constexpr double size = 0.02;
    for (const Solid& solid : solids()) {
        CAPTURE(solid.name);
        const Shape& shape = *solid.shape;
        const Point place = shape.project(0, shape.bounding_box().corner(Eigen::AlignedBox3d::TopRightCeil));
        const Eigen::AlignedBox3d box(place - Point::Constant(0.1), place + Point::Constant(0.1));
        const auto mesh =
            tessellate({solid.shape, "part", "", 0},
                       {.size = size, .within = box, .size_beyond = 0.3, .chord_tolerance = 1e-3});
        const auto f = test::measure(mesh, shape);
        check_sound(f, shape, solid.euler);
        CHECK(f.min_angle > 10);
        CHECK(f.longest > 0.2);
        int n_near = 0;
        for (const auto face : mesh.faces()) {
            Eigen::AlignedBox3d around;
            for (const auto v : mesh.fv_range(face)) around.extend(mesh.point(v));
            if (!around.intersects(box)) continue;
            ++n_near;
            for (const auto e : mesh.fe_range(face)) CHECK(mesh.calc_edge_length(e) <= size);
        }
        CHECK(n_near > 50);
        // Half of what such triangles everywhere would be.
        CHECK(static_cast<double>(mesh.n_faces()) < 2 * solid.area / (std::sqrt(3) * size * size));
    }
}
