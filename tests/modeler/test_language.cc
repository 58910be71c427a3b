#include <filesystem>
#include <numbers>

#include "tests/modeler/language_checks.hh"

using namespace maille;
using namespace maille::modeler;
using namespace maille::modeler::test;

namespace {

std::vector<std::string> surface_names(const std::string& text, Facets facets = Facets::automatic) {
    return test::surface_names(model_of(text, facets));
}

std::vector<std::string> primitive_names(const std::string& text) {
    std::vector<std::string> names;
    for (const Primitive& primitive : model_of(text).primitives) names.push_back(primitive.name);
    return names;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("solids take OpenSCAD's arguments, by place and by name") {
    const auto unit_cube = [](const Point& p) { return in_box(p, {0, 0, 0}, {1, 1, 1}); };
    check_solid("cube();", unit_cube);
    check_solid("cube(1);", unit_cube);
    check_solid("cube([1, 2, 3], true);", [](const Point& p) {
        return in_box(p, {-.5, -1, -1.5}, {.5, 1, 1.5});
    });
    check_solid("cube(center = true, size = 2);", [](const Point& p) {
        return in_box(p, {-1, -1, -1}, {1, 1, 1});
    });

    check_solid("sphere();", [](const Point& p) { return p.norm() <= 1; });
    check_solid("sphere(2);", [](const Point& p) { return p.norm() <= 2; });
    check_solid("sphere(d = 3);", [](const Point& p) { return p.norm() <= 1.5; });

    const auto cone = [](double h, double r1, double r2, double z0) {
        return [=](const Point& p) {
            const double t = (p.z() - z0) / h;
            return t >= 0 && t <= 1 && std::hypot(p.x(), p.y()) <= r1 + t * (r2 - r1);
        };
    };
    check_solid("cylinder();", cone(1, 1, 1, 0));
    check_solid("cylinder(2, 1, 0.5);", cone(2, 1, 0.5, 0));
    check_solid("cylinder(2, 1, 0, true);", cone(2, 1, 0, -1));
    check_solid("cylinder(h = 2, r1 = 0, r2 = 1);", cone(2, 0, 1, 0));
    check_solid("cylinder(2, d = 3);", cone(2, 1.5, 1.5, 0));
    check_solid("cylinder(r = 2, h = 1, center = true);", cone(1, 2, 2, -0.5));
    check_solid("cylinder(h = 2, d1 = 2, r2 = 2);", cone(2, 1, 2, 0));
}

TEST_CASE("the language's own solids") {
    check_solid("torus(1.5, 0.7);",
                [](const Point& p) { return std::hypot(std::hypot(p.x(), p.y()) - 1.5, p.z()) <= 0.7; });
    check_solid("ellipsoid([1, 2, 2.5]);",
                [](const Point& p) { return p.cwiseQuotient(Point(1, 2, 2.5)).norm() <= 1; });
    check_solid("wedge([2, 1, 2], 1);", [](const Point& p) {
        return in_box(p, {0, 0, 0}, {2, 1, 2}) && p.x() <= 2 - p.z() / 2;
    });
    check_solid("wedge(size = [2, 1, 2]);", [](const Point& p) {
        return in_box(p, {0, 0, 0}, {2, 1, 2}) && p.x() <= 2 - p.z();
    });
    check_solid("prism(4, 2, 1);", [](const Point& p) {
        return p.z() >= 0 && p.z() <= 1 && std::abs(p.x()) + std::abs(p.y()) <= 2;
    });
    check_solid("pyramid(n = 4, r = 2, h = 2);",
                [](const Point& p) { return p.z() >= 0 && std::abs(p.x()) + std::abs(p.y()) <= 2 - p.z(); });
    const auto simplex = [](const Point& p) { return p.minCoeff() >= 0 && p.sum() <= 2; };
    check_solid("tetrahedron([[0,0,0], [2,0,0], [0,2,0], [0,0,2]]);", simplex);
    check_solid("tetrahedron([[2,0,0], [0,0,0], [0,2,0], [0,0,2]]);", simplex);
    // OpenSCAD's faces are clockwise seen from outside.
    const std::string points = "[[0,0,0], [2,0,0], [0,2,0], [0,0,2]]";
    check_solid(
        "polyhedron(points = " + points + ", faces = [[0,1,2], [0,2,3], [0,3,1], [1,3,2]], convexity = 1);",
        simplex);
    check_solid("polyhedron(" + points + ", triangles = [[0,1,2], [0,2,3], [0,3,1], [1,3,2]]);", simplex);
}

TEST_CASE("half-spaces cut, wherever their plane is") {
    check_solid("intersection() { sphere(2); halfspace([0.5, 0, 0], [1, 0, 0]); }",
                [](const Point& p) { return p.norm() <= 2 && p.x() <= 0.5; });
    check_solid("difference() { sphere(2); halfspace(normal = [1, 1, 0], point = [0, 0, 0]); }",
                [](const Point& p) { return p.norm() <= 2 && p.x() + p.y() > 0; });
    check_solid(
        "intersection() { sphere(2); rotate(90) scale([1, 2, 1]) halfspace([0.5, 0, 0], [1, 1, 0]); }",
        [](const Point& p) { return p.norm() <= 2 && (p.y() - 0.5) - p.x() / 2 <= 0; });
    check_solid("intersection() { sphere(2); halfspace([50, 0, 0], [1, 0, 0]); }",
                [](const Point& p) { return p.norm() <= 2; });
    check_solid("difference() { sphere(2); halfspace([50, 0, 0], [-1, 0, 0]); }",
                [](const Point& p) { return p.norm() <= 2; });
    check_solid(
        "difference() { cube(2); intersection() { halfspace([1,0,0], [-1,0,0]); halfspace([0,1,0], "
        "[0,-1,0]); } }",
        [](const Point& p) {
            return in_box(p, {0, 0, 0}, {2, 2, 2}) && !(p.x() >= 1 && p.y() >= 1);
        });
    CHECK(surface_names("intersection() { cube(1); halfspace([0,0,0.5], [0,0,1]); }")[6] ==
          "halfspace2/plane");
}

TEST_CASE("transforms compose from the outside in") {
    check_solid("translate([1, 0, 0]) rotate([0, 0, 90]) cube([2, 1, 1]);", [](const Point& p) {
        return in_box(p, {0, 0, 0}, {1, 2, 1});
    });
    check_solid("rotate([0, 0, 90]) translate([1, 0, 0]) cube([2, 1, 1]);", [](const Point& p) {
        return in_box(p, {-1, 1, 0}, {0, 3, 1});
    });
    check_solid("rotate([90, 0, 90]) cube([1, 2, 3]);",  // first about x, then about z
                [](const Point& p) {
                    return in_box(p, {0, 0, 0}, {3, 1, 2});
                });
    check_solid("rotate(a = 90, v = [0, 3, 0]) cube([1, 2, 3]);", [](const Point& p) {
        return in_box(p, {0, 0, -1}, {3, 2, 0});
    });
    check_solid("rotate(-90) cube([1, 2, 1]);", [](const Point& p) {
        return in_box(p, {0, -1, 0}, {2, 0, 1});
    });
    check_solid("mirror([1, 0, 0]) cube([1, 2, 1]);", [](const Point& p) {
        return in_box(p, {-1, 0, 0}, {0, 2, 1});
    });
    check_solid("mirror([1, -1, 0]) cube([1, 2, 1]);", [](const Point& p) {
        return in_box(p, {0, 0, 0}, {2, 1, 1});
    });
    check_solid("scale([1, 2]) cube(1);", [](const Point& p) { return in_box(p, {0, 0, 0}, {1, 2, 1}); });
    check_solid("scale(2) sphere(1);", [](const Point& p) { return p.norm() <= 2; });
    check_solid("scale([1, 2, 1]) sphere(1);",
                [](const Point& p) { return p.cwiseQuotient(Point(1, 2, 1)).norm() <= 1; });
    check_solid("multmatrix([[1, 1, 0, -1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) cube(1);",
                [](const Point& p) {
                    return in_box({p.x() - p.y() + 1, p.y(), p.z()}, {0, 0, 0}, {1, 1, 1});
                });
    check_solid("translate([0, 1]) { cube(1); translate([0, 0, 1]) cube(1); }", [](const Point& p) {
        return in_box(p, {0, 1, 0}, {1, 2, 2});
    });
}

TEST_CASE("a turn by any angles is R_z R_y R_x") {
    const double d = std::numbers::pi / 180;
    const Eigen::Matrix3d turn =
        (Eigen::AngleAxisd(50 * d, Point::UnitZ()) * Eigen::AngleAxisd(-40 * d, Point::UnitY()) *
         Eigen::AngleAxisd(200 * d, Point::UnitX()))
            .toRotationMatrix();
    check_solid("rotate([200, -40, 50]) cube([1, 2, 3]);", [&](const Point& p) {
        return in_box(turn.transpose() * p, {0, 0, 0}, {1, 2, 3});
    });
}

TEST_CASE("booleans are OpenSCAD's") {
    const auto a = [](const Point& p) { return in_box(p, {0, 0, 0}, {2, 2, 2}); };
    const auto b = [](const Point& p) { return in_box(p, {1, 1, 1}, {3, 3, 3}); };
    const auto c = [](const Point& p) { return p.norm() <= 1; };
    const std::string bodies = "{ cube(2); translate([1, 1, 1]) cube(2); sphere(1); }";
    check_solid("union() " + bodies, [&](const Point& p) { return a(p) || b(p) || c(p); });
    check_solid("group() " + bodies, [&](const Point& p) { return a(p) || b(p) || c(p); });
    check_solid("color([1, 0, 0, 1]) render(convexity = 2) " + bodies,
                [&](const Point& p) { return a(p) || b(p) || c(p); });
    check_solid("fragment() " + bodies, [&](const Point& p) { return a(p) || b(p) || c(p); });
    check_solid("difference() " + bodies, [&](const Point& p) { return a(p) && !b(p) && !c(p); });
    check_solid("intersection() { union() { cube(2); sphere(1); } translate([-1, -1, 0.5]) cube(2); }",
                [&](const Point& p) {
                    return (a(p) || c(p)) && in_box(p, {-1, -1, .5}, {1, 1, 2.5});
                });
    check_solid("cube(2); sphere(1);", [&](const Point& p) { return a(p) || c(p); });
    check_solid("difference() { cube(2); group(); sphere(1); }",
                [&](const Point& p) { return a(p) && !c(p); });
    check_solid("intersection() { union() { cube(2); group() {} } }", a);
}

TEST_CASE("what OpenSCAD makes nothing of is nothing, and changes nothing else") {
    const auto cube = [](const Point& p) { return in_box(p, {0, 0, 0}, {1, 1, 1}); };
    for (const std::string nothing :
         {"cube(0);",
          "cube([2, -1, 2]);",
          "cube([inf, 2, 2]);",
          "sphere(r = 0);",
          "sphere(-2);",
          "cylinder(h = 0, r = 2);",
          "cylinder(h = -1, r = 2);",
          "cylinder(h = 1, r1 = 0, r2 = 0);",
          "cylinder(h = 1, r1 = -1, r2 = 2);",
          "scale([2, 0, 2]) sphere(2);",
          "polyhedron([[0, 0, 0]], []);",
          "multmatrix([[inf, 0, 0, 0], [nan, 1, 0, 0], [nan, 0, 1, 0], [0, 0, 0, 1]]) cube(3);",
          "linear_extrude(height = 0) square(2);",
          "linear_extrude(height = 2) circle(0);",
          "linear_extrude(height = 2) intersection() { square(2); square([0, 2]); }",
          "linear_extrude(height = 2) { polygon([]); polygon([[0, 0], [1, 1]]); }",
          "linear_extrude(height = 2) scale([0, 1]) square(2);",
          "rotate_extrude(angle = 0) square(2);",
          "rotate_extrude() translate([2, 0]) circle(0);",
          "hull() { sphere(0); cube(0); }",
          "resize([2, 2, 2]) sphere(0);",
          "union() { cube(0); group() { sphere(0); } }"}) {
        check_solid("cube(1); " + nothing, cube);
        check_solid("difference() { cube(1); " + nothing + " }", cube);
        CHECK(message_of("intersection() { cube(1); " + nothing + " }").ends_with("it has no solid"));
        CHECK(message_of("difference() { " + nothing + " sphere(1); }").ends_with("it has no solid"));
        CHECK(message_of(nothing) != "no error");
    }
    check_solid("hull() { cube(1); sphere(0); }", cube);
    check_solid("linear_extrude(height = 1) { square(1); square(0); translate([0, 1]) circle(0); }", cube);
    check_solid("linear_extrude(height = 1) difference() { square(1); circle(0); }", cube);
    const auto pipe = [](const Point& p) {
        const double r = std::hypot(p.x(), p.y());
        return r >= 1 && r <= 2 && p.z() >= 0 && p.z() <= 1;
    };
    check_solid("rotate_extrude() { translate([1, 0]) square(1); circle(0); scale([0, 1]) square(3); }",
                pipe);
}

TEST_CASE("modifiers: ignored objects are gone, the root is alone") {
    const auto cube = [](const Point& p) { return in_box(p, {0, 0, 0}, {1, 1, 1}); };
    check_solid("cube(1); %sphere(2); *sphere(2);", cube);
    check_solid("difference() { %sphere(3); #cube(1); }", cube);
    check_solid("translate([1, 1, 1]) { sphere(2); !cube(1); }", cube);
    check_solid("cube(1); %import(file = \"x\");", cube);
    // The root stands where no transform around it moves it; one in what is only shown counts, one in what is
    // disabled does not; of several the first.
    check_solid("translate([5, 0, 0]) intersection() { sphere(1); rotate(90) !cube(1); }", cube);
    check_solid("sphere(2); %translate([9, 9, 9]) { !cube(1); }", cube);
    check_solid("cube(1); *translate([9, 9, 9]) { !sphere(2); }", cube);
    check_solid("sphere(2); !cube(1); !sphere(3);", cube);
    check_solid("linear_extrude(height = 1) { square(1); %circle(9); *circle(9); #square(0.5); }", cube);
    check_solid("#% sphere(2); *! sphere(2); # translate([0, 0, 0]) # cube(1);", cube);
    CHECK(primitive_names("%sphere(2); cube(1);") == Names{"cube1"});
}

TEST_CASE("trees are as simple as the model") {
    const auto tree = [](const std::string& text) { return model_of(text).tree; };
    CHECK(tree("group() { union() { translate([1,0,0]) { cube(1); } } }").operation == Operation::leaf);
    const CsgTree flat = tree("union() { union() { cube(1); cube(2); } group() { cube(3); } }");
    CHECK(flat.operation == Operation::join);
    CHECK(flat.children.size() == 3);
    const CsgTree fragment = tree("fragment() { union() { cube(1); cube(2); } cube(3); }");
    CHECK(fragment.operation == Operation::fragment);
    CHECK(fragment.children.size() == 2);
    // What plays no part in the result is no part of the model; the others keep their numbers.
    const Model model = model_of("union() { difference() { group(); sphere(1); } cube(1); }");
    CHECK(model.primitives.size() == 1);
    CHECK(model.primitives[0].name == "cube2");
    CHECK(model.tree.primitive == 0);
}

TEST_CASE("primitives are named, numbered and of a material and size, the innermost wins") {
    CHECK(primitive_names("cube(1); translate([3,0,0]) sphere(1); cylinder();") ==
          Names{"cube1", "sphere2", "cylinder3"});
    CHECK(primitive_names("name(\"a\") { cube(1); name(\"b\") sphere(1); cube(2); }") ==
          Names{"a", "b", "a"});
    const Model model = model_of(
        "material(\"steel\") size(2) { cube(1); size(0.1) name(\"n\") material(\"brass\") union() { "
        "sphere(1); } }");
    CHECK(model.primitives[0].material == "steel");
    CHECK(model.primitives[0].size == 2);
    CHECK(model.primitives[1].material == "brass");
    CHECK(model.primitives[1].size == 0.1);
    CHECK(model.primitives[1].name == "n");
    CHECK(model_of("cube(1);").primitives[0].material.empty());
    CHECK(model_of("cube(1);").primitives[0].size == 0);
}

TEST_CASE("surfaces are named after primitive and face") {
    CHECK(surface_names("cube(1);") ==
          Names{"cube1/x-", "cube1/x+", "cube1/y-", "cube1/y+", "cube1/z-", "cube1/z+"});
    CHECK(distinct(surface_names("name(\"pin\") cylinder(h=1, r=1);")) ==
          std::set<std::string>{"pin/side", "pin/bottom", "pin/top"});
    CHECK(distinct(surface_names("cylinder(h=1, r1=1, r2=0);")) ==
          std::set<std::string>{"cylinder1/side", "cylinder1/bottom"});
    CHECK(surface_names("sphere(1); torus(2, 1); ellipsoid([1,2,3]);") ==
          Names{"sphere1/surface", "torus2/surface", "ellipsoid3/surface"});
    CHECK(distinct(surface_names("prism(3, 1, 1);")) == std::set<std::string>{"prism1/side0", "prism1/side1",
                                                                              "prism1/side2", "prism1/bottom",
                                                                              "prism1/top"});
    CHECK(distinct(surface_names("tetrahedron([[0,0,0], [2,0,0], [0,2,0], [0,0,2]]);")).size() == 4);
    const std::vector<ModelSurface> both = surfaces(model_of("sphere(1); cube(1);"));
    CHECK(both.size() == 7);
    CHECK(both[6].primitive == 1);
    CHECK(both[6].face == 5);
}

TEST_CASE("arithmetic") {
    check_solid("cube([2*3+1 - 5, 8/2/2, (1+1)*-1 + 4]);", [](const Point& p) {
        return in_box(p, {0, 0, 0}, {2, 2, 2});
    });
    check_solid("sphere(r = pi / 2);", [](const Point& p) { return p.norm() <= std::numbers::pi / 2; });
    check_solid(
        "translate([-+1, - -1, 0,]) cube(.5e0);",
        [](const Point& p) {
            return in_box(p, {-1, 1, 0}, {-.5, 1.5, .5});
        },
        1.6);
}

TEST_CASE("facets are kept where $fn is 3 to 8, or where all are asked for") {
    const auto n_surfaces = [](const std::string& text, Facets facets) {
        return surfaces(model_of(text, facets)).size();
    };
    const std::string hexagon =
        "cylinder($fn = 6, $fa = 12, $fs = 2, h = 1, r1 = 1, r2 = 1, center = false);";
    const std::string round =
        "cylinder($fn = 100, $fa = 12, $fs = 2, h = 1, r1 = 1, r2 = 1, center = false);";
    CHECK(n_surfaces(hexagon, Facets::automatic) == 8);
    CHECK(n_surfaces(hexagon, Facets::round) == 3);
    CHECK(n_surfaces(hexagon, Facets::keep) == 8);
    CHECK(n_surfaces(round, Facets::automatic) == 3);
    CHECK(n_surfaces(round, Facets::keep) == 102);
    CHECK(n_surfaces("sphere($fn = 2, r = 1);", Facets::automatic) == 1);
    CHECK(distinct(surface_names(hexagon)) ==
          std::set<std::string>{"cylinder1/side", "cylinder1/bottom", "cylinder1/top"});
    CHECK(distinct(surface_names("sphere($fn = 8, r = 1);")) == std::set<std::string>{"sphere1/surface"});
    CHECK_THROWS_WITH_AS(
        model_of("sphere($fn = 1e300, r = 1);", Facets::keep),
        "part.csg:1:1: sphere: 1e+300 facets around are more than 2000: lower $fn, or raise $fa or $fs",
        InputError);
}

TEST_CASE("the shipped examples are read") {
    int read = 0;
    for (const auto& entry : std::filesystem::directory_iterator(MAILLE_SOURCE_DIR "/examples")) {
        if (entry.path().extension() != ".csg") continue;
        CAPTURE(entry.path().string());
        CHECK(read_model(entry.path()).primitives.size() >= 2);
        ++read;
    }
    CHECK(read >= 8);
    CHECK(read_model(MAILLE_SOURCE_DIR "/examples/bracket.csg").primitives.size() >= 8);
}
