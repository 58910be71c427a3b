#include <cmath>
#include <numbers>

#include "modeler/build.hh"
#include "modeler/build_copies.hh"
#include "modeler/solid.hh"
#include "tests/modeler/language_checks.hh"
#include "volmesh/measure.hh"

using namespace maille;
using namespace maille::modeler;
using namespace maille::modeler::test;
using std::numbers::pi;

namespace {

std::string message_of(const std::function<void()>& make) {
    try {
        make();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a plate with a hole, in one line") {
    const Solid part =
        (box({4, 2, .5}).named("plate") - cylinder(1, .4).named("hole").at({1, 1, -.2})).size(.2);
    check_inside(part.model(), [](const Point& p) {
        return in_box(p, {0, 0, 0}, {4, 2, .5}) && std::hypot(p.x() - 1, p.y() - 1) > .4;
    });
    const auto mesh = build(part, {.chord_tolerance = 0.003});
    CHECK(volmesh::volume(mesh) == doctest::Approx(4 - pi * 0.16 * 0.5).epsilon(2e-3));
    CHECK(mesh.find_set("plate", volmesh::EntityKind::cell).is_valid());
    CHECK(mesh.find_set("hole/side", volmesh::EntityKind::face).is_valid());
    for (const Primitive& primitive : part.model().primitives) CHECK(primitive.size == .2);
}

TEST_CASE("solids are values: what is made of one leaves it as it is") {
    const Solid ball = sphere(1);
    const Solid far = ball.at({5, 0, 0}).named("far");
    const Solid two = ball + far;
    CHECK(ball.model().primitives[0].name == "sphere1");
    CHECK(contains(ball.model(), {0, 0, 0}));
    CHECK_FALSE(contains(far.model(), {0, 0, 0}));
    const Model model = two;
    REQUIRE(model.primitives.size() == 2);
    CHECK(model.primitives[0].name == "sphere1");
    CHECK(model.primitives[1].name == "far");
    // The innermost wins.
    const Model nested =
        (box({1, 1, 1}).named("a").of("steel").size(.1) + sphere(1)).named("b").of("brass").size(3);
    CHECK(nested.primitives[0].name == "a");
    CHECK(nested.primitives[0].material == "steel");
    CHECK(nested.primitives[0].size == .1);
    CHECK(nested.primitives[1].name == "b");
    CHECK(nested.primitives[1].material == "brass");
    CHECK(nested.primitives[1].size == 3);
}

TEST_CASE("operators are the tree's operations, and long chains are flat") {
    const auto cube = [](double x) { return box({1, 1, 1}).at({x, 0, 0}); };
    CHECK((cube(0) | cube(1)).model().tree.operation == Operation::fragment);
    check_inside((cube(0) + cube(1)).model(), [](const Point& p) { return in_box(p, {0, 0, 0}, {2, 1, 1}); });
    check_inside((cube(0) & cube(.5)).model(), [](const Point& p) {
        return in_box(p, {.5, 0, 0}, {1, 1, 1});
    });
    check_inside((cube(0) - cube(.5) - cube(-.75)).model(),
                 [](const Point& p) {
                     return in_box(p, {.25, 0, 0}, {.5, 1, 1});
                 },
                 1);
    check_inside((box({2, 2, 2}, true) & halfspace({0, 0, 0.5}, {0, 0, 1})).model(), [](const Point& p) {
        return in_box(p, {-1, -1, -1}, {1, 1, .5});
    });
    Solid row = cube(0);
    for (int i = 1; i < 2000; ++i) row = row + cube(2 * i);
    const Model model = row;
    CHECK(model.primitives.size() == 2000);
    CHECK(model.tree.children.size() == 2000);
}

TEST_CASE("the language's solids and transforms, in C++") {
    const auto same = [](const Solid& solid, const std::string& text) {
        CAPTURE(text);
        const Model model = model_of(text, Facets::round);
        check_inside(solid.model(), [&](const Point& p) { return contains(model, p); });
    };
    same(box({1, 2, 3}, true), "cube([1, 2, 3], true);");
    same(ellipsoid({1, 2, 1.5}), "ellipsoid([1, 2, 1.5]);");
    same(cylinder(2, 1, true), "cylinder(2, r = 1, center = true);");
    same(cone(2, 1, 0), "cylinder(2, 1, 0);");
    same(torus(1.5, .7), "torus(1.5, 0.7);");
    same(wedge({2, 1, 2}, 1), "wedge([2, 1, 2], 1);");
    same(prism(5, 2, 1), "prism(5, 2, 1);");
    same(pyramid(5, 2, 2), "pyramid(5, 2, 2);");
    same(tetrahedron({Point(0, 0, 0), Point(2, 0, 0), Point(0, 2, 0), Point(0, 0, 2)}),
         "tetrahedron([[0,0,0], [2,0,0], [0,2,0], [0,0,2]]);");
    same(polyhedron({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}},
                    {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}),
         "tetrahedron([[0,0,0], [2,0,0], [0,2,0], [0,0,2]]);");
    same(extruded({{{0, 0}, {2, 0}, {0, 2}}}, 1.5),
         "linear_extrude(height = 1.5) polygon([[0, 0], [2, 0], [0, 2]]);");
    same(turned({{{1, 0}, {2, 0}, {1, 2}}}), "rotate_extrude() polygon([[1, 0], [2, 0], [1, 2]]);");
    same(turned({{{1, 0}, {2, 0}, {1, 2}}}, 120),
         "rotate_extrude(angle = 120) polygon([[1, 0], [2, 0], [1, 2]]);");
    same(box({1, 2, 1}).rotated(30), "rotate(30) cube([1, 2, 1]);");
    same(box({1, 2, 1}).rotated(30, {1, 1, 0}), "rotate(30, [1, 1, 0]) cube([1, 2, 1]);");
    same(box({1, 2, 1}).mirrored({1, 1, 0}), "mirror([1, 1, 0]) cube([1, 2, 1]);");
    same(sphere(1).scaled({1, 2, .5}).at({.1, 0, 0}), "translate([0.1, 0, 0]) scale([1, 2, 0.5]) sphere(1);");
    same(sphere(1).scaled(2), "sphere(2);");
}

TEST_CASE("what makes no solid is refused where it is written") {
    CHECK(message_of([] { box({1, 0, 1}); }).find("size in y") != std::string::npos);
    CHECK(message_of([] { cylinder(1, -1); }).find("radius") != std::string::npos);
    CHECK(message_of([] { box({1, 1, 1}).named("a/b"); }).find("cannot be a name") != std::string::npos);
    CHECK(message_of([] { box({1, 1, 1}).size(0); }).find("size") != std::string::npos);
    CHECK(message_of([] { box({1, 1, 1}).scaled({1, 0, 1}); }).find("flattens") != std::string::npos);
    CHECK(message_of([] { halfspace({0, 0, 0}, {0, 0, 0}); }).find("normal") != std::string::npos);
    CHECK(message_of([] {
              halfspace({0, 0, 0}, {0, 0, 1}).named("up").model();
          }).find("'up'") != std::string::npos);
}

TEST_CASE("primitives that differ in place only are meshed once") {
    const Solid hole = cylinder(2, .3, true).named("hole");
    Solid plate = box({4, 3, 1}).named("plate");
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 2; ++j) plate = plate - hole.at({1.0 + i, 1.0 + j, .5});
    BuildReport report;
    const auto mesh = build(plate, {.size = .4, .chord_tolerance = 0.005}, &report);
    CHECK(report.moved_primitives == 5);
    CHECK(volmesh::volume(mesh) == doctest::Approx(12 - 6 * pi * 0.09).epsilon(2e-3));

    // Kept cells, too: balls apart from each other have the same mesh but for their place.
    const Solid pebble = (sphere(.5).scaled({1, .8, .6}).rotated(20, {1, 1, 1})).named("pebble");
    BuildReport balls;
    const auto three = build(pebble + pebble.at({2, 0, 0}) + pebble.at({0, 2.7, .3}), {.size = .2}, &balls);
    CHECK(balls.moved_primitives == 2);
    CHECK(three.n_cells() % 3 == 0);
    CHECK(volmesh::volume(three) ==
          doctest::Approx(3 * volmesh::volume(build(pebble, {.size = .2}))).epsilon(1e-12));
    // Their vertices lie on their own surfaces.
    const Model model = pebble + pebble.at({2, 0, 0}) + pebble.at({0, 2.7, .3});
    double farthest = 0;
    for (const auto v : three.vertices()) {
        if (!three.is_boundary(v)) continue;
        double nearest = 1;
        for (const Primitive& primitive : model.primitives)
            nearest =
                std::min(nearest, (primitive.shape->project(0, three.point(v)) - three.point(v)).norm());
        farthest = std::max(farthest, nearest);
    }
    CHECK(farthest < 1e-14);
}

TEST_CASE("what is another solid moved, and what is not") {
    const auto way = [](const Solid& a, const Solid& b) {
        return translation_between(*a.model().primitives[0].shape, *b.model().primitives[0].shape);
    };
    const Point by(.1, -.7, 3);
    const PlaneRegion region{{{1, 0}, {2, 0}, {1, 2}}};
    for (const Solid& solid :
         {box({1, 2, 3}).rotated(30), sphere(1), cylinder(1, .5).rotated(20, {1, 0, 1}), torus(2, .5),
          ellipsoid({1, 2, 3}), pyramid(6, 1, 1), turned(region), turned(region, 100)}) {
        const auto found = way(solid, solid.at(by));
        REQUIRE(found);
        CHECK((*found - by).norm() < 1e-14);
        CHECK_FALSE(way(solid, solid.scaled(1.01)));
        const bool is_ball = way(solid, sphere(1)).has_value();
        CHECK(way(solid, solid.scaled({1, 1, -1}).rotated(1, {1, 2, 0})).has_value() == is_ball);
    }
    // Round solids that are turned about themselves stay what they are.
    const Solid bar = cylinder(1, .5), flat = ellipsoid({1, 1, 2});
    for (const auto& [solid, turn] : {std::pair(sphere(1), Point(1, 2, 3)),
                                      {bar, {0, 0, 1}},
                                      {torus(2, .5), {0, 0, 1}},
                                      {flat, {0, 0, 1}}}) {
        REQUIRE(way(solid, solid.rotated(20, turn).at(by)));
        CHECK((*way(solid, solid.rotated(20, turn).at(by)) - by).norm() < 1e-14);
    }
    CHECK(way(torus(2, .5), torus(2, .5).scaled({1, -1, -1})));
    CHECK_FALSE(way(bar, bar.scaled({1, 1, -1})));
    CHECK_FALSE(way(cone(1, 1, .5), cone(1, 1, .5).rotated(180, {1, 0, 0})));
    CHECK_FALSE(way(flat, flat.rotated(20, {1, 0, 0})));
    CHECK_FALSE(way(sphere(1), box({1, 1, 1})));
    CHECK_FALSE(way(torus(2, .5), torus(2, .4)));
    CHECK_FALSE(way(turned(region), turned(region, 100)));
    CHECK_FALSE(way(cone(1, 1, .5), cone(1, 1, .6)));
    // Boxes side by side share their faces to the bit.
    const Solid brick = box({.1, .1, .1});
    const auto wall = build((brick | brick.at({.1, 0, 0}) | brick.at({.2, 0, 0})), {.size = .05});
    CHECK(volmesh::volume(wall) == doctest::Approx(3e-3).epsilon(1e-13));
}
