#include <cmath>
#include <numbers>

#include "tests/modeler/language_checks.hh"

using namespace maille;
using namespace maille::modeler;
using namespace maille::modeler::test;

namespace {

const Primitive& only(const Model& model) {
    REQUIRE(model.primitives.size() == 1);
    return model.primitives.front();
}

double volume(const std::string& text) {
    CAPTURE(text);
    const Model model = model_of(text);
    return figures_of(only(model)).volume;
}

/// Area of a regular polygon.
double polygon_area(int n, double r) {
    return n / 2.0 * r * r * std::sin(2 * std::numbers::pi / n);
}

}  // namespace

TEST_CASE("the hull of solids has the volume that geometry tells") {
    // A box with a roof that is flat on top.
    CHECK(volume("hull() { cube([4, 2, 1]); translate([0, 0.5, 1]) cube([4, 1, 1]); }") ==
          doctest::Approx(4 * (2 + 1.5)).epsilon(1e-14));
    CHECK(volume("hull() { cube(1); translate([2, 0, 0]) cube(1); }") == doctest::Approx(3).epsilon(1e-14));
    CHECK(volume("hull() { translate([0, 0, 0]) cube(2); translate([0, 0, 3]) cube(1); }") ==
          doctest::Approx(8 + 2 * (4 + 2 + 1) / 3.0).epsilon(1e-13));
    // Two discs: a stadium of height 1.
    CHECK(
        volume("hull() { cylinder(h = 1, r = 1, $fn = 40); translate([3, 0, 0]) cylinder(h = 1, r = 1, $fn = "
               "40); }") == doctest::Approx(polygon_area(40, 1) + 3 * 2).epsilon(1e-12));
    // What is cut away inside does not matter, what is cut off does.
    CHECK(volume("hull() difference() { cube(3); translate([1, 1, 1]) cube(1); }") ==
          doctest::Approx(27).epsilon(1e-13));
    CHECK(volume("hull() difference() { cube(2, center = true); translate([0, -2, -2]) cube(4); }") ==
          doctest::Approx(4).epsilon(1e-13));
    CHECK(volume("hull() intersection() { cube(2, center = true); rotate(45) cube(2, center = true); }") ==
          doctest::Approx(2 * polygon_area(8, 1 / std::cos(std::numbers::pi / 8))).epsilon(1e-12));
    CHECK(volume("scale([1, 2, 3]) rotate(30) hull() { cube(1); translate([1, 1, 1]) cube(1); }") ==
          doctest::Approx(6 * (1 + 3)).epsilon(1e-12));
}

TEST_CASE("the hull is round solids' facets', as OpenSCAD's is") {
    const double facets = volume("hull() sphere(r = 2, $fn = 30);");
    const Model ball = model_of("sphere(r = 2, $fn = 30);", Facets::keep);
    CHECK(facets == doctest::Approx(figures_of(only(ball)).volume).epsilon(1e-12));
    const double ring = volume("hull() torus(2, 1);");  // a disc with a rounded rim
    const double pi = std::numbers::pi;
    const double exact = 2 * pi * 4 + pi * pi * 2 + 4 * pi / 3;
    CHECK(ring < exact);
    CHECK(ring > 0.98 * exact);
}

TEST_CASE("the hull's facets are one patch where it is smooth, and as few as can be") {
    const Model box = model_of("name(\"b\") hull() { cube(1); translate([2, 0, 0]) cube(1); }");
    CHECK(surfaces(box).size() == 6);
    CHECK(distinct(surface_names(box)).size() == 6);
    const Model stadium = model_of(
        "hull() { cylinder(h = 1, r = 1, $fn = 60); translate([3, 0, 0]) cylinder(h = 1, r = 1, $fn = 60); "
        "}");
    CHECK(surfaces(stadium).size() == 62 + 2);
    CHECK(distinct(surface_names(stadium)) ==
          std::set<std::string>{"hull1/patch0", "hull1/patch1", "hull1/patch2"});
}

TEST_CASE("a hull of nothing is nothing, of something flat no solid") {
    CHECK(model_of("hull() {} cube(1);").primitives.size() == 1);
    CHECK(message_of("hull() {}") == "part.csg: the model is empty: it has no solid");
    CHECK(message_of(" hull() circle(1);").starts_with("part.csg:1:9: 'circle' is flat"));
    CHECK(message_of("hull(3) cube(1);") == "part.csg:1:6: hull: at most 0 arguments without a name");
}

TEST_CASE("resize scales to a size, as OpenSCAD does") {
    const auto box = [](const Point& high) {
        return [=](const Point& p) { return in_box(p, {0, 0, 0}, high); };
    };
    check_solid("resize(newsize = [2, 0, 1], auto = [0, 0, 0]) cube(1);", box({2, 1, 1}));
    check_solid("resize([2, 0, 0], auto = true) cube([1, 0.5, 0.25]);", box({2, 1, .5}));
    check_solid("resize([2, 0, 0], auto = [false, true, false]) cube([1, 0.5, 0.25]);", box({2, 1, .25}));
    check_solid("resize([0, 0, 0], auto = [1, 1, 1]) cube(1);", box({1, 1, 1}));
    check_solid("resize(newsize = [2.4, 0, 0.5], auto = [0, 1, 0]) cube([1.2, 1, 1]);", box({2.4, 2, .5}));
    // About the origin, not about the solid.
    check_solid(
        "resize([2, 0, 0]) translate([1, 0, 0]) cube(1);",
        [](const Point& p) {
            return in_box(p, {2, 0, 0}, {4, 1, 1});
        },
        4);
    // Within transforms, within each other, and of what a difference leaves.
    check_solid("rotate(90) resize([2, 0, 0]) translate([0, -1, 0]) cube(1);", [](const Point& p) {
        return in_box(p, {0, 0, 0}, {1, 2, 1});
    });
    check_solid("resize([2, 2, 2]) union() { resize([1, 0, 0]) cube(3); cube([1, 1, 3]); }", box({2, 2, 2}));
    check_solid("resize([2, 0, 0]) difference() { cube(3); translate([1, -1, -1]) cube(5); }",
                box({2, 3, 3}));
    check_solid("resize([2, 2, 2]) sphere(5);", [](const Point& p) { return p.norm() <= 1; });
    check_solid("resize([2, 3, 4]) rotate([0, 0, 45]) torus(3, 1);", [](const Point& p) {
        const Point q = p.cwiseQuotient(Point(1 / 4., 1.5 / 4, 2));
        return std::hypot(std::hypot(q.x(), q.y()) - 3, q.z()) <= 1;
    });
}

TEST_CASE("resize takes the true box of what round solids leave") {
    // The drill leaves the ball's own ends along x and y; along z its rim is left.
    const Model drilled =
        model_of("resize([2, 2, 2]) difference() { sphere(5); cylinder(h = 20, r = 3, center = true); }");
    const Eigen::AlignedBox3d ball = drilled.primitives.front().shape->bounding_box();
    CHECK(ball.max().x() == doctest::Approx(1).epsilon(1e-12));
    CHECK(ball.max().z() == doctest::Approx(5.0 / 4).epsilon(3e-4));
}

TEST_CASE("resize of flat shapes") {
    const Model model = model_of(
        "linear_extrude(height = 1) resize(newsize = [4, 0], auto = true) union() { square([2, 1]); "
        "square(0.5); "
        "}");
    CHECK(figures_of(only(model)).volume == doctest::Approx(8).epsilon(1e-13));
    CHECK(volume("linear_extrude(height = 1) resize([0, 3, 7]) square(1);") ==
          doctest::Approx(3).epsilon(1e-13));
}

TEST_CASE("deeply nested resizes and hulls cost no more than their depth") {
    std::string text = "cube(1);";
    for (int i = 0; i < 60; ++i) text = "resize([2, 0, 0]) { " + text + " }";
    check_solid(text, [](const Point& p) { return in_box(p, {0, 0, 0}, {2, 1, 1}); });
    CHECK(volume("hull() { hull() { hull() { hull() { cube(1); } } } }") ==
          doctest::Approx(1).epsilon(1e-14));
}

TEST_CASE("what no size can be made of is refused") {
    CHECK(message_of("resize(newsize = [-1, 0, 0]) cube(1);") ==
          "part.csg:1:18: resize: a size must not be negative");
    CHECK(message_of("resize() cube(1);") == "part.csg:1:1: resize: 'newsize' is missing");
    CHECK(message_of("resize([1, 1, 1], auto = [1, 1, 1, 1]) cube(1);") ==
          "part.csg:1:26: resize: 'auto' must be at most three truths");
    CHECK(message_of("resize([1, 1, 1], auto = \"x\") cube(1);") ==
          "part.csg:1:26: resize: 'auto' must be true or false, not a string");
}
