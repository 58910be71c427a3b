#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "modeler/meridian.hh"
#include "modeler/shape_cone.hh"
#include "modeler/shapes.hh"

namespace {

using namespace maille;
using namespace maille::modeler;
using Eigen::Affine3d;
constexpr double pi = std::numbers::pi;

Affine3d some_frame() {
    Affine3d frame = Affine3d::Identity();
    frame.linear() << 1, 0.2, 0.1, -0.3, 1.5, 0.4, 0.2, 0.1, 0.7;
    frame.translation() << 3, -1, 2;
    return frame;
}

Affine3d at(double x, double y, double z) {
    return Affine3d(Eigen::Translation3d(x, y, z));
}

/// How far the point of the meridian, turned by an angle about the axis, is from the surface.
double farthest(const Meridian& meridian, const Affine3d& frame, const Shape& shape) {
    double distance = 0;
    for (int i = 0; i < 100; ++i) {
        const Eigen::Vector2d p = meridian.at(0.1 * i);
        const Point q = frame * Point(p.x() * std::cos(0.3 * i), p.x() * std::sin(0.3 * i), p.y());
        distance = std::max(distance, (shape.project(0, q) - q).norm());
    }
    return distance;
}

}  // namespace

TEST_CASE("meridians turn into ellipsoids and tori, also into images of them in the frame of the image") {
    for (const Affine3d& frame : {Affine3d::Identity(), some_frame()}) {
        const Affine3d turned = frame * at(0, 0, 0.4) * Eigen::AngleAxisd(0.7, Point::UnitZ());
        for (const auto& shape : {make_ellipsoid({0.8, 0.8, 0.3}, turned), make_torus(1, 0.3, turned),
                                  make_ellipsoid({0.5, 0.5, 2}, turned)}) {
            const auto meridian = meridian_in(frame, *shape);
            REQUIRE(meridian);
            CHECK(meridian->centre.y() == doctest::Approx(0.4));
            CHECK(farthest(*meridian, frame, *shape) < 1e-12);
        }
        CHECK_FALSE(meridian_in(frame, *make_ellipsoid({0.8, 0.8, 0.3}, frame * at(1e-6, 0, 0))));
        CHECK_FALSE(meridian_in(frame, *make_ellipsoid({0.8, 0.800001, 0.3}, frame)));
        CHECK_FALSE(meridian_in(frame, *make_torus(1, 0.3, frame * Eigen::AngleAxisd(1e-6, Point::UnitX()))));
        CHECK_FALSE(meridian_in(frame, *make_cube({1, 1, 1}, true, frame)));
    }
}

TEST_CASE("two surfaces of revolution on one axis have a common frame, wherever that axis is") {
    const Affine3d frame = some_frame();
    const auto sphere = make_sphere(1, frame), spheroid = make_ellipsoid({1, 1, 0.5}, frame),
               beside = make_sphere(0.5, frame * at(1, 2, 2)), torus = make_torus(2, 0.5, frame),
               slanted = make_ellipsoid({1, 1, 0.5}, frame * Eigen::AngleAxisd(1, Point::UnitX()));
    for (const auto& [a, b] : {std::pair(sphere, spheroid),
                               {spheroid, sphere},
                               {sphere, beside},
                               {beside, sphere},
                               {torus, spheroid},
                               {sphere, torus},
                               {slanted, sphere}}) {
        const auto common = common_frame(*a, *b);
        REQUIRE(common);
        for (const auto& shape : {a, b})
            CHECK(farthest(meridian_in(*common, *shape).value(), *common, *shape) < 1e-12);
    }
    CHECK_FALSE(common_frame(*spheroid, *slanted));
    CHECK_FALSE(common_frame(*spheroid, *beside));
    CHECK_FALSE(common_frame(*torus, *beside));
    CHECK_FALSE(common_frame(*sphere, *make_sphere(2, frame)));  // any axis will do
}

TEST_CASE("circles along which cones touch a meridian's surface, and rims on it, are found") {
    const Meridian sphere{{0, 2}, {1, 1}}, torus{{3, 0}, {0.5, 0.25}};
    const Cone cylinder(1, 1, Affine3d::Identity());
    const auto on_equator = touching_circles(sphere, cylinder, 0, 5, {});
    REQUIRE(on_equator.size() == 1);
    CHECK(on_equator[0].angle == doctest::Approx(0).epsilon(1e-12));
    CHECK(on_equator[0].other == doctest::Approx(2));
    CHECK(touching_circles(sphere, cylinder, 0, 1.9, {}).empty());
    CHECK(touching_circles(Meridian{{0, 2}, {1 + 1e-6, 1}}, cylinder, 0, 5, {}).empty());

    // A line in the direction (-1, 1) touches where the normal is (1, 1).
    const Cone cone(1, 0, Affine3d::Identity());
    const double root = std::sqrt(0.5);
    const Meridian touched{{0, 1 - 0.5 * std::numbers::sqrt2}, {0.5, 0.5}};
    const auto touching = touching_circles(touched, cone, 0, 1, {});
    REQUIRE(touching.size() == 1);
    CHECK(touching[0].angle == doctest::Approx(pi / 4));
    CHECK(touching[0].other == doctest::Approx(1 - 0.5 * root));
    // A rim there is the same circle.
    const std::vector<double> rims{1 - 0.5 * root};
    CHECK(touching_circles(touched, cone, 0, 1 - 0.5 * root, rims).size() == 1);
    CHECK(touching_circles(touched, cone, 0, 1, rims).size() == 1);

    const std::vector<double> ends{2 - 0.8, 2.0, 2 + 0.8};
    const Meridian larger{{0, 2}, {1.25, 1 / 0.75}};
    const auto of_rims = touching_circles(larger, cylinder, 0, 4, ends);
    REQUIRE(of_rims.size() == 2);
    for (const TouchingCircle& circle : of_rims)
        CHECK((larger.at(circle.angle) - Eigen::Vector2d(1, circle.other)).norm() < 1e-12);

    const Cone inner(1, 1, Affine3d(Eigen::Scaling(2.5, 2.5, 1.0)));
    const auto hole = touching_circles(Meridian{{3 / 2.5, 0}, {0.5 / 2.5, 0.25}}, inner, -1, 1, {});
    REQUIRE(hole.size() == 1);
    CHECK(std::abs(hole[0].angle) == doctest::Approx(pi));
    CHECK(touching_angle(torus, 0.25) == doctest::Approx(pi / 2));
    CHECK(touching_angle(torus, -0.25) == doctest::Approx(-pi / 2));
    CHECK_FALSE(touching_angle(torus, 0.2));
    CHECK_FALSE(touching_angle(sphere, 3));  // at a point of the axis
}

TEST_CASE("circles along which two meridians' surfaces touch are found, wherever they are") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(0, 1);
    for (int trial = 0; trial < 200; ++trial) {
        CAPTURE(trial);
        const Meridian one{{trial % 2 == 0 ? 0.0 : 2.0, number(random)},
                           {0.3 + number(random), 0.3 + number(random)}};
        // A torus whose ellipse touches it from outside at that angle, where both have one normal.
        const double angle = pi * (number(random) - 0.5);
        const Eigen::Vector2d p = one.at(angle), axes(0.1 + number(random), 0.1 + number(random));
        const Eigen::Vector2d normal =
            Eigen::Vector2d(std::cos(angle), std::sin(angle)).cwiseQuotient(one.semi);
        const Eigen::Vector2d way = normal.cwiseProduct(axes).normalized().cwiseProduct(axes);
        const Meridian other{p + way, axes};
        if (other.centre.x() < axes.x() + 0.01 || p.x() < 0.01) continue;
        const auto found = touching_circles(one, other);
        REQUIRE(found.size() == 1);
        CHECK((one.at(found[0].angle) - p).norm() < 1e-8);
        CHECK((other.at(found[0].other) - p).norm() < 1e-8);
        const Meridian beyond{p + 1.00001 * way, axes};
        CHECK(touching_circles(one, beyond).empty());
    }
    // On the axis spheres touch at a point, not along a circle.
    CHECK(touching_circles(Meridian{{0, 0}, {1, 1}}, Meridian{{0, 3}, {2, 2}}).empty());
    CHECK(touching_circles(Meridian{{0, 0}, {1, 1}}, Meridian{{0, 0}, {1, 0.5}}).size() == 1);
}
