#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <doctest/doctest.h>

#include "modeler/build.hh"
#include "modeler/shared_surface.hh"
#include "modeler/tessellate.hh"
#include "quality/measures.hh"
#include "tests/modeler/name_checks.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

namespace {

using namespace maille;
using namespace maille::modeler;
constexpr double pi = std::numbers::pi;

/// The triangles of the primitive's curved surface between two heights, by their corners to nine digits.
std::set<std::array<std::array<long, 3>, 3>> triangles(const volmesh::TriMesh& mesh, double low,
                                                       double high) {
    std::set<std::array<std::array<long, 3>, 3>> found;
    for (const auto f : mesh.faces()) {
        if (surface_of(mesh, f) != 0) continue;
        std::array<std::array<long, 3>, 3> corners;
        bool is_between = true;
        std::ranges::transform(mesh.fv_range(f), corners.begin(), [&](auto v) {
            const Point& p = mesh.point(v);
            is_between = is_between && p.z() > low - 1e-9 && p.z() < high + 1e-9;
            return std::array{std::lround(p.x() * 1e9), std::lround(p.y() * 1e9), std::lround(p.z() * 1e9)};
        });
        std::ranges::rotate(corners, std::ranges::min_element(corners));
        if (is_between) found.insert(corners);
    }
    return found;
}

std::vector<volmesh::TriMesh> tessellated(const std::string& text, std::vector<double> sizes) {
    const Model model = parse_model(text, "shared");
    const auto shared = find_shared_surfaces(model.primitives, sizes, 0);
    std::vector<volmesh::TriMesh> meshes;
    for (std::size_t i = 0; i < shared.size(); ++i)
        meshes.push_back(tessellate(model.primitives[i], {.size = sizes[i], .shared = shared[i]}));
    return meshes;
}

struct Case {
    std::string text;
    double volume;
    double least_angle;  ///< degrees
};

void check(const Case& test) {
    CAPTURE(test.text);
    const Model model = parse_model(test.text, "shared");
    BuildReport report;
    const auto mesh = build(model, {.size = .2}, &report);
    CHECK(report.warnings.empty());
    CHECK(report.projection.short_of_target.empty());
    CHECK(volmesh::validate(mesh).ok());
    // Chords of that length take no more than this from the smallest of the circles.
    CHECK(volmesh::volume(mesh) == doctest::Approx(test.volume).epsilon(.06));
    const auto names = test::check_names(mesh, model);
    CHECK(names.nameless + names.ambiguous == 0);
    CHECK(names.farthest < 1e-9);
    double least = 180;
    for (const auto c : mesh.cells()) {
        const auto p = mesh.cell_points(c);
        least = std::min(least, quality::dihedral_min(quality::tet_geometry(p[0], p[1], p[2], p[3])));
    }
    CHECK(least > test.least_angle);
}

}  // namespace

TEST_CASE("cylinders and cones on one another have the same triangles where both are") {
    for (const std::string turn : {"", "rotate(17)", "mirror([1, 2, 0])"}) {
        CAPTURE(turn);
        for (const auto& [solids, low, high] :
             {std::tuple("cylinder(h = 2, r = .5); #translate([0, 0, 1.3]) cylinder(h = 2.4, r = .5);", 1.3,
                         2.),
              {"cylinder(h = 4, r = .5); #translate([0, 0, 2.3]) cylinder(h = .4, r = .5);", 2.3, 2.7},
              {"cylinder(h = 2, r1 = 1, r2 = .5); #translate([0, 0, 1]) cylinder(h = 3, r1 = .75, r2 = 0);",
               1., 2.}}) {
            std::string text = solids;
            text.replace(text.find('#'), 1, turn + " ");
            const auto meshes = tessellated("union() {" + text + "}", {.1, .2});
            const auto first = triangles(meshes[0], low, high);
            CHECK(first.size() > 50);
            CHECK(first == triangles(meshes[1], low, high));
        }
    }
}

TEST_CASE("a cylinder upside down has the same triangles too") {
    const auto meshes = tessellated(
        "cylinder(h = 2, r = .5); translate([0, 0, 3]) rotate([180, 0, 40]) cylinder(h = 2, r = .5);",
        {.2, .2});
    CHECK(triangles(meshes[0], 1, 2).size() > 50);
    CHECK(triangles(meshes[0], 1, 2) == triangles(meshes[1], 1, 2));
}

TEST_CASE("equal spheres have the same triangles, those of the smaller size") {
    const auto meshes = tessellated(
        "sphere(1); rotate([10, 20, 30]) sphere(1); translate([3, 0, 0]) sphere(1);", {.3, .2, .3});
    CHECK(triangles(meshes[0], -1, 1) == triangles(meshes[1], -1, 1));
    CHECK(triangles(meshes[0], -1, 1).size() > 3 * triangles(meshes[2], -1, 1).size() / 2);
}

TEST_CASE("spheres that are shared keep the chord tolerance") {
    const Model model = parse_model("union() { sphere(.5); rotate([10, 20, 30]) sphere(.5); }", "spheres");
    for (const double tolerance : {.05, .01, .001}) {
        std::vector<double> sizes{.35, .35};
        const auto shared = find_shared_surfaces(model.primitives, sizes, tolerance);
        const auto mesh =
            tessellate(model.primitives[0], {.size = .35, .chord_tolerance = tolerance, .shared = shared[0]});
        double depth = 0;
        for (const auto f : mesh.faces()) depth = std::max(depth, .5 - mesh.calc_face_centroid(f).norm());
        CHECK(depth < tolerance);
        CHECK(depth > tolerance / 4);
    }
}

TEST_CASE("what shares no round surface is cut as it likes") {
    const Model model = parse_model(
        "cylinder(h = 1, r = 1); translate([0, 0, 2]) cylinder(h = 1, r = 1); cylinder(h = 3, r = .7);"
        "translate([5, 0, 0]) { cylinder(h = 1, r = 1); sphere(.9); cube(3, center = true); }"
        "translate([0, 5, 0]) scale([1, 2, 1]) sphere(1);",
        "apart");
    std::vector<double> sizes(model.primitives.size(), .1);
    for (const auto& shared : find_shared_surfaces(model.primitives, sizes, 0)) CHECK_FALSE(shared);
}

TEST_CASE("surfaces of revolution on one axis that touch, or have rims on one another, leave no slivers") {
    const std::string capped = "cylinder(h = 1, r = .5); translate([0, 0, 1]) scale([1, 1, .4]) sphere(.5);";
    const double capped_volume = pi / 4 + pi / 30;
    const std::string by_six_digits =
        "multmatrix([[.866025, 0, .5, 0], [0, 1, 0, 0], [-.5, 0, .866025, 0], [0, 0, 0, 1]])";
    for (const Case& test : {
             Case{capped, capped_volume, 10},
             {"rotate([50, 60, 70]) {" + capped + "}", capped_volume, 10},
             {"scale([1.5, 1, 1]) {" + capped + "}", 1.5 * capped_volume, 10},
             {by_six_digits + "{" + capped + "}", capped_volume, 10},
             {by_six_digits +
                  "{ cylinder(h = 2, r = .5); sphere(.5); translate([-1, .5, .5]) cube([2, 1, 1]); }",
              2 + pi / 2 + pi / 12, 10},
             {"translate([0, 0, -.5]) cylinder(h = .5, r = .5); rotate(9) translate([0, 0, -.5]) " + capped,
              capped_volume, 10},
             {"fragment() { sphere(1); cylinder(h = 1.6, r = .6, center = true); }", 4 * pi / 3, 10},
             {"translate([0, 0, .3]) cylinder(h = .8 / 1.5, r1 = .4, r2 = 0); sphere(.5);",
              pi / 6 - pi * .04 * 1.3 / 3 + pi * .16 * .8 / 4.5, 10},
             {"translate([0, 0, .1]) cylinder(h = 2.2 / 3, r1 = 1.65 / 3, r2 = 0); sphere(.5);",
              pi / 6 - pi * .16 * 1.1 / 3 + pi * .3025 * 2.2 / 9, 10},
             {"fragment() { cylinder(h = .8, r = 1.4, center = true); torus(1, .4); }", pi * 1.96 * .8, 10},
             {"sphere(1); torus(1.4, .4);", 4 * pi / 3 + 2 * pi * pi * 1.4 * .16, 10},
             {"fragment() { sphere(1); scale([1, 1, .5]) sphere(1); }", 4 * pi / 3, 10},
             {"scale([1, 2, 1]) rotate([0, 40, 0]) fragment() { sphere(.6); scale([1, 1, .5]) sphere(.6); }",
              2 * 4 * pi / 3 * .216, 10},
             {"cylinder(h = 2, r = .5); linear_extrude(2) polygon([[.5, 0], [1, 1], [0, .5]]);",
              2 * (3 * pi / 16 + .5), 10},
         })
        check(test);
}

TEST_CASE("surfaces that coincide or touch leave no slivers") {
    const std::string bored =
        "difference() { cube(2, center = true); cylinder(h = 4, r = .5, center = true); }";
    for (const Case& test : {
             Case{"sphere(1); rotate([20, 30, 40]) sphere(1);", 4 * pi / 3, 10},
             {"cylinder(h = 2, r = .5); rotate([0, 0, 17]) translate([0, 0, 1.3]) cylinder(h = 2, r = .5);",
              3.3 * pi / 4, 10},
             {"fragment() { cylinder(h = 1, r = .5); translate([0, 0, 1]) rotate(17) cylinder(h = 2, r = "
              ".5); }",
              3 * pi / 4, 10},
             {"fragment() { cylinder(h = 2, r = .5); sphere(.5); translate([0, 0, 2]) sphere(.5); }",
              pi / 2 + pi / 6, 10},
             {"rotate([31, 12, 7]) cylinder(h = 2, r = .5); sphere(.5);", pi / 2 + pi / 12, 10},
             {"cylinder(h = 2, r = .5); translate([0, 0, 2]) rotate(9) cylinder(h = 1, r1 = .5, r2 = 0);",
              pi / 2 + pi / 12, 10},
             {"fragment() { " + bored + " rotate(11) cylinder(h = 1, r = .5, center = true); }", 8 - pi / 4,
              10},
             {"cylinder(h = 2, r = .5); translate([.5, -1, 0]) cube([1, 2, 2]);", pi / 2 + 4, 8},
             {"rotate(20) { cylinder(h = 2, r = .5); translate([.8, 0, 1]) cylinder(h = 2, r = .3); }",
              pi / 2 + .18 * pi, 8},
             {"cylinder(h = 3, r = .5, center = true); rotate([90, 0, 0]) cylinder(h = 3, r = .5, center = "
              "true);",
              1.5 * pi - 2. / 3, 3},
             {"fragment() { ellipsoid([1, .7, .5]); mirror([1, 1, 0]) ellipsoid([.7, 1, .5]); }",
              4 * pi / 3 * .35, 10},
             {"fragment() { torus(1, .4); rotate(20) intersection() { torus(1, .4); cube(3); } }",
              2 * pi * pi * .16, 10},
         })
        check(test);
}
