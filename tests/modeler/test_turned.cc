#include <cmath>
#include <limits>
#include <numbers>

#include "modeler/build.hh"
#include "modeler/shape_turned.hh"
#include "tests/modeler/language_checks.hh"
#include "volmesh/measure.hh"

using namespace maille;
using namespace maille::modeler;
using namespace maille::modeler::test;
using std::numbers::pi;

namespace {

Model round_model(const std::string& text) {
    return model_of(text, Facets::round);
}

/// The volume of a primitive whose triangles are at most that far from its true surface.
SurfaceFigures fine_figures(const Primitive& primitive, double size, double tolerance) {
    const SurfaceFigures figures =
        measure(tessellate(primitive, {.size = size, .chord_tolerance = tolerance}), *primitive.shape);
    CHECK(figures.closed);
    CHECK(figures.oriented);
    CHECK(figures.off_surface < 1e-13);
    CHECK(figures.min_angle > 5);
    return figures;
}

/// Volume by the angle times the first moment of the profile (Pappus), against the triangles' at two
/// tolerances: no further from it than the tolerance allows.
void check_volume(const std::string& text, double expected) {
    CAPTURE(text);
    const Model model = round_model(text);
    REQUIRE(model.primitives.size() == 1);
    for (const double tolerance : {6e-2, 1e-2}) {
        const SurfaceFigures figures = fine_figures(model.primitives[0], 1.5, tolerance);
        CHECK(std::abs(figures.volume - expected) < tolerance * figures.area);
    }
}

Profile ring(double major, double minor, double height, bool clockwise = false) {
    const Point2 start(major + minor, height);
    return {{{.from = start,
              .to = start,
              .name = "surface",
              .centre = Point2(major, height),
              .clockwise = clockwise}}};
}

}  // namespace

TEST_CASE("a turned shape has the volume of Pappus' rule") {
    // Square, triangle beside the axis, cone on it, a shape with a hole, at the left of the axis.
    check_volume("rotate_extrude() translate([2, 0]) square([1, 3]);", 2 * pi * 2.5 * 3);
    check_volume("rotate_extrude() translate([2, 0]) polygon([[0, 0], [3, 0], [0, 3]]);", 2 * pi * 3 * 4.5);
    check_volume("rotate_extrude() polygon([[0, 0], [3, 0], [0, 4]]);", pi * 9 * 4 / 3);
    check_volume("rotate_extrude() polygon([[0, 0], [3, 0], [3, 1], [0, 4]]);", pi * 9 * (1 + 3.0 / 3));
    check_volume("rotate_extrude() polygon([[0, 0], [2, 2], [0, 4]]);", pi * 4 * 4 / 3);
    check_volume("rotate_extrude() translate([-5, 1]) square(2);", 2 * pi * 4 * 4);
    check_volume(
        "rotate_extrude() difference() { translate([2, 0]) square(3); translate([3, 1]) square(1); }",
        2 * pi * 3.5 * 8);
    check_volume("rotate_extrude() difference() { square(3); translate([1, 1]) square(1); }",
                 pi * 27 - 2 * pi * 1.5);
}

TEST_CASE("part of a turn, either way, on the axis and off it") {
    for (const double angle : {30.0, 180.0, 200.0, -60.0, -270.0}) {
        const std::string turn = "rotate_extrude(angle = " + std::to_string(angle) + ") ";
        const double part = std::abs(angle) * pi / 180;
        check_volume(turn + "translate([2, 0]) square([1, 3]);", part * 2.5 * 3);
        check_volume(turn + "square([1, 3]);", part * 0.5 * 3);
        check_volume(turn + "polygon([[0, 0], [2, 1], [0, 2]]);", part * 2 * (2.0 / 3));
        check_volume(turn + "difference() { translate([1, 0]) square(3); translate([2, 1]) square(1); }",
                     part * 2.5 * 8);
        check_volume(turn + "translate([-5, 1]) square(2);", part * 4 * 4);
        check_volume(turn + "translate([3, 1]) circle(r = 1);", part * 3 * pi);
    }
}

TEST_CASE("a turned shape is where it belongs") {
    const auto turned = [](const Point& p) { return std::atan2(p.y(), p.x()) * 180 / pi; };
    const auto in_square = [](const Point& p) {
        const double r = p.head<2>().norm();
        return r >= 1 && r <= 2.5 && p.z() >= 0 && p.z() <= 2;
    };
    const std::string shape = "translate([1, 0]) square([1.5, 2]);";
    check_solid("rotate_extrude() " + shape, in_square);
    check_solid("rotate_extrude(angle = 70) " + shape,
                [&](const Point& p) { return in_square(p) && turned(p) >= 0 && turned(p) <= 70; });
    check_solid("rotate_extrude(angle = -70) " + shape,
                [&](const Point& p) { return in_square(p) && turned(p) <= 0 && turned(p) >= -70; });
    check_solid("rotate_extrude(angle = 250) " + shape,
                [&](const Point& p) { return in_square(p) && (turned(p) >= 0 || turned(p) <= -110); });
    // At the left of the axis the turn starts there.
    check_solid("rotate_extrude(angle = 70) translate([-2.5, 0]) square([1.5, 2]);",
                [&](const Point& p) { return in_square(p) && turned(p) <= -110; });
    check_solid("scale([1, 1, 2]) rotate([90, 0, 0]) rotate_extrude() polygon([[0, 0], [1, 0], [0, 1]]);",
                [&](const Point& p) {
                    return p.y() <= 0 && p.y() >= -1 && std::hypot(p.x(), p.z() / 2) <= 1 + p.y();
                });
    check_solid("rotate_extrude() translate([2, 0.5]) circle(r = 0.75);",
                [&](const Point& p) { return std::hypot(p.head<2>().norm() - 2, p.z() - 0.5) <= 0.75; });
    check_solid("rotate_extrude(angle = 70) translate([2, 0.5]) circle(r = 0.75);", [&](const Point& p) {
        return std::hypot(p.head<2>().norm() - 2, p.z() - 0.5) <= 0.75 && turned(p) >= 0 && turned(p) <= 70;
    });
    check_solid(
        "rotate_extrude() intersection() { translate([2, 0]) circle(r = 0.75); translate([1, 0]) square(2); "
        "}",
        [&](const Point& p) { return std::hypot(p.head<2>().norm() - 2, p.z()) <= 0.75 && p.z() >= 0; });
}

TEST_CASE("a turned shape's faces are named, round ones few") {
    CHECK(distinct(surface_names(round_model("name(\"r\") rotate_extrude() translate([1, 0]) square(1);"))) ==
          std::set<std::string>{"r/side0", "r/side1", "r/side2", "r/side3"});
    CHECK(surface_names(round_model("rotate_extrude() square(1);")).size() == 3);  // none on the axis
    CHECK(distinct(surface_names(round_model("rotate_extrude(angle = -20) square(1);")))
              .contains("rotate_extrude1/start"));
    const Model part = round_model("rotate_extrude(angle = -20) square(1);");
    for (const ModelSurface& surface : surfaces(part))
        if (surface.name == "rotate_extrude1/start")
            CHECK(part.primitives[0].shape->face_normal(surface.face, {0.5, 0, 0.5}) == Point(0, 1, 0));
    CHECK(surface_names(round_model("rotate_extrude() translate([3, 0]) circle(r = 1, $fn = 50);")).size() ==
          1);
    CHECK(surface_names(model_of("rotate_extrude($fn = 6) translate([1, 0]) square(1);")).size() == 24);
    CHECK(surface_names(model_of("rotate_extrude($fn = 6) translate([1, 0]) square(1);", Facets::round))
              .size() == 4);
}

TEST_CASE("the nearest points of turned arcs, against samples of the surface") {
    constexpr unsigned seed = 9;
    MESSAGE("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(-3, 3);
    for (int round = 0; round < 6; ++round) {
        Eigen::Affine3d frame = Eigen::Affine3d::Identity();
        frame.linear() = 1.7 * random_frame(random, 1).linear();
        frame.translation() = Point(0.3, -0.2, 0.5);
        const double major = round % 2 == 0 ? 1.5 : 0, minor = 0.8;
        // Half of the circle; on the axis, a ball.
        Profile profile{
            {{.from = {major, -minor}, .to = {major, minor}, .name = "arc", .centre = Point2(major, 0)},
             {.from = {major, minor}, .to = {major, -minor}, .name = "wall"}}};
        const auto shape = make_turned(profile, 360, frame);
        REQUIRE(shape->faces().size() == (major > 0 ? 2 : 1));
        for (int i = 0; i < 30; ++i) {
            const Point p = frame * (Point(coordinate(random), coordinate(random), coordinate(random)) * 0.6);
            const Point foot = shape->project(0, p);
            CHECK(std::abs(shape->face_implicit(0, foot)) < 1e-13);
            double least = std::numeric_limits<double>::infinity();
            double u = 0, v = 0, width = pi;
            for (int level = 0; level < 12; ++level, width /= 8) {
                const double mu = u, mv = v;
                for (int a = -24; a <= 24; ++a)
                    for (int b = -24; b <= 24; ++b) {
                        const double at_u = mu + width * a / 24, at_v = mv + width * b / 24;
                        const double rho = major + minor * std::cos(at_v);
                        const Point q =
                            frame * Point(rho * std::cos(at_u), rho * std::sin(at_u), minor * std::sin(at_v));
                        if ((q - p).norm() < least) least = (q - p).norm(), u = at_u, v = at_v;
                    }
            }
            CHECK((foot - p).norm() == doctest::Approx(least).epsilon(1e-12));
            const Point normal = shape->face_normal(0, p);
            CHECK(normal.norm() == doctest::Approx(1).epsilon(1e-14));
            CHECK((p - foot).cross(normal).norm() < 1e-12);
            // The normal turns as the curvature says.
            const Eigen::Matrix3d bend = shape->face_curvature(0, foot);
            const Point along = normal.unitOrthogonal();
            const double step = 1e-5;
            const Point turned =
                (shape->face_normal(0, foot + step * along) - shape->face_normal(0, foot - step * along)) /
                (2 * step);
            CHECK((turned - bend * along).norm() < 1e-7 * (1 + bend.norm()));
        }
    }
}

TEST_CASE("balls, lenses and rings of arcs have their volume") {
    const auto volume = [](const Profile& profile, double angle) {
        const Primitive primitive{make_turned(profile, angle, Eigen::Affine3d::Identity()), "t", "", 0};
        return fine_figures(primitive, 1, 1e-2);
    };
    const auto check = [&](const Profile& profile, double angle, double expected) {
        const SurfaceFigures figures = volume(profile, angle);
        CHECK(std::abs(figures.volume - expected) < 1e-2 * figures.area);
    };
    const Profile ball{{{.from = {0, -2}, .to = {0, 2}, .name = "ball", .centre = Point2(0, 0)},
                        {.from = {0, 2}, .to = {0, -2}, .name = "axis"}}};
    check(ball, 360, 4 * pi / 3 * 8);
    check(ball, 90, pi / 3 * 8);
    check(ring(3, 1, 0.5), 360, 2 * pi * 3 * pi);
    check(ring(3, 1, 0.5), 120, 2 * pi * pi);
    // A spindle-shaped hole: a cylinder with an arc taken out of its side (clockwise: the hollow's).
    const Profile hollow{
        {{.from = {0, -1}, .to = {2, -1}, .name = "bottom"},
         {.from = {2, -1}, .to = {2, 1}, .name = "hollow", .centre = Point2(2, 0), .clockwise = true},
         {.from = {2, 1}, .to = {0, 1}, .name = "top"},
         {.from = {0, 1}, .to = {0, -1}, .name = "axis"}}};
    // Half a disc, its centre of mass 4 / (3 pi) from its straight side.
    check(hollow, 360, pi * 4 * 2 - 2 * pi * (2 - 4 / (3 * pi)) * pi / 2);
    // A ring with a round hole through it.
    Profile tube = ring(3, 1, 0);
    tube.push_back(ring(3, 0.5, 0, true).front());
    check(tube, 360, 2 * pi * 3 * pi * 0.75);
    check(tube, 200, 200 * pi / 180 * 3 * pi * 0.75);
}

TEST_CASE("the box of a turned shape is as small as can be") {
    std::mt19937 random(4);
    for (const double angle : {360.0, 100.0, 250.0, -40.0}) {
        const Profile profile{{{.from = {1, 0}, .to = {2, 0}, .name = "a"},
                               {.from = {2, 0}, .to = {1, 1}, .name = "b", .centre = Point2(1, 0)},
                               {.from = {1, 1}, .to = {1, 0}, .name = "c"}}};
        Eigen::Affine3d frame = random_frame(random, 1);
        const auto shape = make_turned(profile, angle, frame);
        const auto mesh = tessellate({shape, "t", "", 0}, {.size = 0.2, .chord_tolerance = 1e-3});
        Eigen::AlignedBox3d box;
        for (const auto v : mesh.vertices()) box.extend(mesh.point(v));
        CHECK((shape->bounding_box().min() - box.min()).cwiseAbs().maxCoeff() < 2e-3);
        CHECK((shape->bounding_box().max() - box.max()).cwiseAbs().maxCoeff() < 2e-3);
        const Eigen::AlignedBox3d rounded(box.min().array() + 1e-12, box.max().array() - 1e-12);
        CHECK(shape->bounding_box().contains(rounded));
    }
}

TEST_CASE("a turned shape goes through the whole road") {
    const Model model = round_model(
        "difference() { name(\"pulley\") rotate_extrude() polygon([[1, 0], [3, 0], [2.5, 0.75], [3, 1.5], "
        "[1, 1.5]]); "
        "name(\"hole\") translate([1.8, 0, -1]) cylinder(h = 4, r = 0.3); }");
    const auto mesh = build(model, {.size = 0.4, .chord_tolerance = 0.01});
    // Square ring less the triangular groove (its centre of mass at 3 - 0.5/3) less the hole.
    const double expected = pi * (9 - 1) * 1.5 - 2 * pi * (3 - 0.5 / 3) * (0.5 * 1.5 / 2) - pi * 0.09 * 1.5;
    CHECK(volmesh::volume(mesh) == doctest::Approx(expected).epsilon(0.01));
    for (const ModelSurface& surface : surfaces(model)) {
        const auto set = mesh.find_set(surface.name, volmesh::EntityKind::face);
        if (surface.primitive == 0) REQUIRE(set.is_valid());
        if (!set.is_valid()) continue;
        const Shape& shape = *model.primitives[surface.primitive].shape;
        double farthest = 0;
        for (const auto f : mesh.faces())
            if (mesh.contains(set, f))
                for (const auto v : f.vertices())
                    farthest = std::max(farthest,
                                        (shape.project(surface.face, mesh.point(v)) - mesh.point(v)).norm());
        CHECK(farthest < 1e-12);
    }
}

TEST_CASE("profiles of which no solid can be made are refused") {
    const auto message = [](const Profile& profile, double angle,
                            const Eigen::Affine3d& frame) -> std::string {
        try {
            make_turned(profile, angle, frame);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    const Eigen::Affine3d identity = Eigen::Affine3d::Identity();
    CHECK(message(ring(1, 2, 0), 360, identity).find("reaches across the axis") != std::string::npos);
    CHECK(message(ring(3, 1, 0), 0, identity).find("angle") != std::string::npos);
    CHECK(message(ring(3, 1, 0), 400, identity).find("angle") != std::string::npos);
    CHECK(message(ring(3, 1, 0), 90, Eigen::Affine3d(Eigen::Scaling(1.0, 2.0, 1.0))).find("scaled") !=
          std::string::npos);
    CHECK(message({}, 90, identity).find("no area") != std::string::npos);
    CHECK(message_of("rotate_extrude() translate([-1, 0]) square(2);").find("reaches across the axis") !=
          std::string::npos);
}
