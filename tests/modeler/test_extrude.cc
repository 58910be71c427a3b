#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "modeler/build.hh"
#include "modeler/model.hh"
#include "modeler/openscad_facets.hh"
#include "modeler/outline.hh"
#include "modeler/tessellate.hh"
#include "tests/modeler/surface_checks.hh"
#include "volmesh/error.hh"
#include "volmesh/measure.hh"

using namespace maille;
using namespace maille::modeler;

namespace {

constexpr double pi = std::numbers::pi;

Model model_of(const std::string& text, Facets facets = Facets::automatic) {
    return parse_model(text, "part.csg", facets);
}

/// Of solids that are apart from each other.
double volume(const std::string& text, Facets facets = Facets::keep) {
    CAPTURE(text);
    double sum = 0;
    for (const Primitive& primitive : model_of(text, facets).primitives) {
        const auto figures = test::measure(tessellate(primitive, 1e3), *primitive.shape);
        CHECK(figures.closed);
        CHECK(figures.oriented);
        sum += figures.volume;
    }
    return sum;
}

std::set<std::string> names(const std::string& text, Facets facets = Facets::keep) {
    std::set<std::string> result;
    for (const ModelSurface& surface : surfaces(model_of(text, facets))) result.insert(surface.name);
    return result;
}

void check_inside(const std::string& text, Facets facets, const std::function<bool(const Point&)>& inside) {
    CAPTURE(text);
    const Model model = model_of(text, facets);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> coordinate(-6, 6);
    int n_inside = 0, n_wrong = 0;
    for (int i = 0; i < 20000; ++i) {
        const Point p(coordinate(random), coordinate(random), coordinate(random));
        const bool is_in = owner(model.tree, [&](std::uint32_t k) {
                               return model.primitives[k].shape->contains(p);
                           }).has_value();
        n_wrong += is_in != inside(p);
        n_inside += is_in;
    }
    CHECK(n_wrong == 0);
    CHECK(n_inside > 50);
}

/// Area of a regular polygon, and by how much it is less than the circle's.
double polygon_area(int n, double r) {
    return n / 2.0 * r * r * std::sin(2 * pi / n);
}

}  // namespace

TEST_CASE("extruded flat shapes have the volume of their area") {
    const auto area = [](const std::string& shape) {
        return volume("linear_extrude(height = 2) " + shape) / 2;
    };
    CHECK(area("square([3, 2]);") == doctest::Approx(6).epsilon(1e-14));
    CHECK(area("square(3, center = true);") == doctest::Approx(9).epsilon(1e-14));
    CHECK(area("circle(r = 2, $fn = 12);") == doctest::Approx(polygon_area(12, 2)).epsilon(1e-14));
    CHECK(area("circle(d = 2, $fn = 5);") == doctest::Approx(polygon_area(5, 1)).epsilon(1e-14));
    CHECK(area("polygon(points = [[0, 0], [4, 0], [0, 3]], paths = undef);") ==
          doctest::Approx(6).epsilon(1e-14));
    CHECK(area("polygon([[0,0],[6,0],[6,6],[0,6],[1,1],[2,1],[2,2],[1,2]], [[0,1,2,3],[4,5,6,7]]);") ==
          doctest::Approx(35).epsilon(1e-14));
    // Loops that cross: what is inside an odd number of them.
    CHECK(area("polygon([[0,0],[2,2],[2,0],[0,2]]);") == doctest::Approx(2).epsilon(1e-14));
    CHECK(area("union() { square(2); translate([1, 1]) square(2); }") == doctest::Approx(7).epsilon(1e-14));
    CHECK(area("intersection() { square(2); translate([1, 1]) square(2); }") ==
          doctest::Approx(1).epsilon(1e-14));
    CHECK(area("difference() { square(5); translate([1, 1]) square(1); translate([4, 4]) square(2); }") ==
          doctest::Approx(23).epsilon(1e-14));
    CHECK(area("{ square(1); translate([3, 0]) square(1); }") == doctest::Approx(2).epsilon(1e-14));
    CHECK(area("mirror([1, 0]) translate([2, 0]) scale([2, 3]) square(1);") ==
          doctest::Approx(6).epsilon(1e-14));
    CHECK(area("hull() { square(1); translate([3, 0]) square(1); translate([0, 3]) square(1); }") ==
          doctest::Approx(1 + 3 + 3 + 4.5).epsilon(1e-14));
}

TEST_CASE("an offset grows and shrinks as OpenSCAD's does") {
    const auto area = [](const std::string& shape) { return volume("linear_extrude(height = 1) " + shape); };
    CHECK(area("offset(delta = 1) square(10);") == doctest::Approx(144).epsilon(1e-12));
    CHECK(area("offset(delta = -1) square(10);") == doctest::Approx(64).epsilon(1e-12));
    // A chamfer cuts each corner at the distance from the old one.
    CHECK(area("offset(delta = 1, chamfer = true) square(10);") ==
          doctest::Approx(144 - 4 * std::pow(std::numbers::sqrt2 - 1, 2)).epsilon(1e-9));
    const double round = area("offset(r = 1, $fn = 64) square(10);");
    CHECK(round < 100 + 40 + pi);
    CHECK(round > 100 + 40 + polygon_area(48, 1));
    // An arc of a quarter has a quarter of the facets, to a whole number: a half is less, as 2021.01 has it.
    CHECK(area("offset(r = 1, $fn = 6) square(10);") == doctest::Approx(140 + 4 * 0.5).epsilon(1e-9));
    CHECK(area("offset(r = 1, $fn = 10) square(10);") ==
          doctest::Approx(140 + 4 * (sin_degrees(36) + sin_degrees(54)) / 2).epsilon(1e-5));
    // Shrinking rounds the corners that point inwards, and what is thinner is gone.
    const double between_arcs = 1 - (std::sqrt(3) / 4 + pi / 6);
    CHECK(area("offset(r = -1, $fn = 360) union() { square(10); translate([10, 4]) square([5, 1]); }") ==
          doctest::Approx(64 + between_arcs).epsilon(1e-5));
}

TEST_CASE("a twisted or narrowed extrusion has the prismatoid's volume") {
    // Between two layers the volume is h/6 (A1 + 4 Am + A2) exactly, Am the area half way, where each side
    // has a corner on its diagonal.
    const auto prismatoid = [](double angle, const Point2& scale, int slices, double height) {
        const std::vector<Point2> square{{1, .01}, {3, .01}, {3, 1.01}, {1, 1.01}};
        const auto image = [&](const Point2& p, double part) -> Point2 {
            const Eigen::Rotation2Dd turn(-angle * pi / 180 * part);
            return (Point2::Ones() + part * (scale - Point2::Ones())).cwiseProduct(turn * p);
        };
        const auto area = [](const std::vector<Point2>& loop) {
            double sum = 0;
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const Point2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
                sum += a.x() * b.y() - a.y() * b.x();
            }
            return sum / 2;
        };
        double sum = 0;
        for (int k = 0; k < slices; ++k) {
            std::vector<Point2> low, high, middle;
            for (std::size_t i = 0; i < square.size(); ++i) {
                const auto at = [&](std::size_t j, int layer) {
                    return image(square[j % square.size()], static_cast<double>(layer) / slices);
                };
                low.push_back(at(i, k));
                high.push_back(at(i, k + 1));
                middle.push_back((at(i, k) + at(i, k + 1)) / 2);
                // The shorter diagonal.
                const Point2 a = at(i, k), b = at(i + 1, k), c = at(i, k + 1), d = at(i + 1, k + 1);
                middle.push_back((a - d).norm() < (b - c).norm() ? (a + d) / 2 : (b + c) / 2);
            }
            sum += height / slices / 6 * (area(low) + 4 * area(middle) + area(high));
        }
        return sum;
    };
    const std::string shape = "translate([1, 0.01]) square([2, 1]);";  // no two diagonals are equal
    CHECK(volume("linear_extrude(height = 3, twist = 50, slices = 4) " + shape) ==
          doctest::Approx(prismatoid(50, {1, 1}, 4, 3)).epsilon(1e-12));
    CHECK(volume("linear_extrude(height = 3, twist = -70, slices = 5, scale = 0.5) " + shape) ==
          doctest::Approx(prismatoid(-70, {.5, .5}, 5, 3)).epsilon(1e-12));
    CHECK(volume("linear_extrude(height = 3, scale = [2, 0.5]) " + shape) ==
          doctest::Approx(prismatoid(0, {2, .5}, 1, 3)).epsilon(1e-12));
    CHECK(volume("linear_extrude(height = 3, scale = 0.5) " + shape) ==
          doctest::Approx(3.0 / 3 * 2 * (1 + .5 + .25)).epsilon(1e-12));
    CHECK(volume("linear_extrude(height = 3, center = true, scale = 0) square(2, center = true);") ==
          doctest::Approx(4).epsilon(1e-12));
}

TEST_CASE("twisted and unevenly scaled extrusions are those of OpenSCAD 2021.01") {
    // Volumes of the .stl files that it writes, with six digits a coordinate.
    const auto check = [](const std::string& arguments, const std::string& shape, double expected) {
        CHECK(volume("linear_extrude(height = 10, " + arguments + ") " + shape) ==
              doctest::Approx(expected).epsilon(2e-5));
    };
    const std::string aside = "translate([6, 0]) square([3, 2]);";
    check("twist = 90, slices = 5", aside, 63.656411);
    check("twist = -90, slices = 5", aside, 63.656411);
    check("scale = [1, 2], slices = 5", aside, 90);
    check("twist = 90, scale = [1, 2]", "translate([60, 0]) square([3, 2]);", 89.423828);
    check("scale = [0.5, 3], center = true", "translate([3, 1]) circle(r = 4);", 680.818546);
    check("twist = 120, center = true", "difference() { circle(r = 10); translate([2, 3]) square(4); }",
          2959.834988);
    check("twist = 200, scale = 0.3",
          "difference() { translate([3, 1]) circle(r = 6); translate([2, 3]) square(4); }", 448.621006);
    check("twist = -90, slices = 5",
          "difference() { translate([-6, -6]) square(12); translate([1, 0]) square([3, 2]); }", 1501.178374);
    CHECK(volume("linear_extrude(height = 5, twist = 720, $fn = 40) square(4, center = true);") ==
          doctest::Approx(83.843287).epsilon(2e-5));
    // A roof: the top is a line.
    CHECK(volume("linear_extrude(height = 3, scale = [1, 0]) square([4, 2], center = true);") ==
          doctest::Approx(12).epsilon(1e-14));
}

TEST_CASE("an extrusion may end in a line, wherever the corners of its shape come to lie there") {
    // Volumes of the .stl files that OpenSCAD 2021.01 writes.
    const auto check = [](const std::string& arguments, const std::string& shape, double expected) {
        CHECK(volume("linear_extrude(height = 3, " + arguments + ") " + shape) ==
              doctest::Approx(expected).epsilon(2e-5));
    };
    const std::string triangle = "polygon([[0, -1], [3, 0], [1, 2]]);", wheel = "circle(r = 2, $fn = 7);";
    const std::string hexagon = "polygon([[-2, -1], [0, -2], [3, -1], [4, 1], [1, 3], [-1, 2]]);";
    check("scale = [1, 0]", triangle, 6);
    check("scale = [1, 0], twist = 90", triangle, 5.706269);
    check("scale = [0, 1]", triangle, 5.888889);
    check("scale = [0, 2], twist = 90", triangle, 8.285559);
    check("scale = [1, 0]", wheel, 16.418474);
    check("scale = [.5, 0]", wheel, 13.269653);
    check("scale = [0, 2]", wheel, 21.891277);
    check("scale = [.5, 0]", hexagon, 23.722210);
    check("scale = [0, 2], twist = 90", hexagon, 39.439114);
    check("scale = [1, 0]", "polygon([[0, 0], [5, 0], [4, 2], [2, 1], [1, 3]]);", 11);
    CHECK(volmesh::volume(build(model_of("linear_extrude(height = 3, scale = [.5, 0]) " + wheel))) ==
          doctest::Approx(13.269653).epsilon(2e-5));
}

TEST_CASE("the number of slices is that of OpenSCAD 2021.01") {
    const auto slices = [](double height, double twist, const Point2& scale, double reach, double shift,
                           const FacetSettings& settings = {}) {
        return openscad_slices(height, twist, scale, reach, shift, settings);
    };
    const double far = std::hypot(9, 2),
                 near = std::sqrt(2);  // corners of the squares that it was tried with
    for (const auto& [twist, n] :
         {std::pair(100, 9), {95, 8}, {91, 8}, {40, 4}, {25, 3}, {-100, 9}, {370, 31}})
        CHECK(slices(10, twist, {1, 1}, far, 0) == n);
    CHECK(slices(3, 200, {1, 1}, far, 0) == 17);
    CHECK(slices(3, 200, {1, 1}, far, 0, {.fn = 7}) == 4);
    CHECK(slices(3, 200, {1, 1}, far, 0, {.fn = 20}) == 12);
    CHECK(slices(40, 30, {2, 1}, far, 9) == 3);
    CHECK(slices(40, 30, {2, 1}, far, 9, {.fn = 50}) == 5);
    CHECK(slices(1, 360, {1, 1}, near, 0) == 5);
    CHECK(slices(1, 360, {3, 3}, near, 0) == 4);
    CHECK(slices(1, 360, {.5, .5}, near, 0) == 4);
    CHECK(slices(1, 360, {0, 0}, near, 0) == 3);
    CHECK(slices(1, 10, {0, 0}, near, 0) == 1);
    CHECK(slices(1, 130, {1, 1}, near, 0, {.fn = 3}) == 2);
    CHECK(slices(1, 1000, {2, 1}, near, 0) == 13);
    CHECK(slices(10, 0, {2, 1}, far, 9) == 7);
    CHECK(slices(10, 0, {1, 3}, far, 4) == 6);
    CHECK(slices(10, 0, {.5, 2}, far, std::hypot(4.5, 2)) == 6);
    CHECK(slices(10, 0, {2, 1}, far, 9, {.fn = 10}) == 10);
    CHECK(slices(3, 0, {2, 1}, near, 1, {.fn = 2.5}) == 2);
    CHECK(slices(10, 0, {2, 2}, far, 9, {.fn = 10}) == 1);
    CHECK_THROWS_AS(slices(1e6, 0, {2, 1}, far, 9), InputError);
}

TEST_CASE("a turned shape has the volume of its rings") {
    const double ring = polygon_area(40, 3) - polygon_area(40, 2);
    CHECK(volume("rotate_extrude($fn = 40) translate([2, 0]) square([1, 5]);") ==
          doctest::Approx(5 * ring).epsilon(1e-12));
    CHECK(volume("rotate_extrude($fn = 40) translate([-3, 0]) square([1, 5]);") ==
          doctest::Approx(5 * ring).epsilon(1e-12));
    CHECK(volume("rotate_extrude(angle = 90, $fn = 40) translate([2, 0]) square([1, 5]);") ==
          doctest::Approx(5 * ring / 4).epsilon(1e-12));
    CHECK(volume("rotate_extrude(angle = -90, $fn = 40) translate([2, 0]) square([1, 5]);") ==
          doctest::Approx(5 * ring / 4).epsilon(1e-12));
    CHECK(volume("rotate_extrude(angle = 360, convexity = 2, $fn = 8) square([3, 5]);") ==
          doctest::Approx(5 * polygon_area(8, 3)).epsilon(1e-12));
    // A cone, whose apex is on the axis, and a ring with a hole all the way round.
    CHECK(volume("rotate_extrude($fn = 10) polygon([[0, 0], [3, 0], [0, 4]]);") ==
          doctest::Approx(4 * polygon_area(10, 3) / 3).epsilon(1e-12));
    CHECK(volume("rotate_extrude($fn = 16) difference() { translate([2, 0]) square(3); translate([3, 1]) "
                 "square(1); }") == doctest::Approx(3 * (polygon_area(16, 5) - polygon_area(16, 2)) -
                                                    polygon_area(16, 4) + polygon_area(16, 3))
                                        .epsilon(1e-12));
    check_inside("rotate_extrude(angle = 90, $fn = 200) translate([2, 0]) square([2, 4]);", Facets::keep,
                 [](const Point& p) {
                     const double r = p.head<2>().norm();
                     // Between the arc and its chord either answer would do: none of the points is there.
                     return p.x() >= 0 && p.y() >= 0 && r >= 2 && r <= 4 && p.z() >= 0 && p.z() <= 4;
                 });
}

TEST_CASE("extrusions name their faces") {
    CHECK(names("name(\"rail\") linear_extrude(height = 1) square(1);") ==
          std::set<std::string>{"rail/side0", "rail/side1", "rail/side2", "rail/side3", "rail/bottom",
                                "rail/top"});
    CHECK(names("cube(1); linear_extrude(height = 1) { square(1); translate([2, 0]) square(1); }").size() ==
          6 + 10);
    CHECK(names("rotate_extrude(angle = 90) translate([1, 0]) square(1);") ==
          std::set<std::string>{"rotate_extrude1/side0", "rotate_extrude1/side1", "rotate_extrude1/side2",
                                "rotate_extrude1/side3", "rotate_extrude1/start", "rotate_extrude1/end"});
}

TEST_CASE("extruded circles are round where circles are") {
    const std::string tube = "linear_extrude(height = 4) difference() { circle(r = 3); circle(r = 1); }";
    CHECK(names(tube, Facets::automatic) ==
          std::set<std::string>{"linear_extrude1/side", "linear_extrude1/bottom", "linear_extrude1/top"});
    check_inside(tube, Facets::automatic, [](const Point& p) {
        const double r = p.head<2>().norm();
        return p.z() >= 0 && p.z() <= 4 && r >= 1 && r <= 3;
    });
    CHECK(names("linear_extrude(height = 1) circle(r = 3, $fn = 6);", Facets::automatic).size() == 8);
    CHECK(names("linear_extrude(height = 1) circle(r = 3);", Facets::keep).size() == 12);
    // Away from the axis a narrowing cylinder leans.
    check_inside(
        "linear_extrude(height = 4, center = true, scale = 0.5) translate([3, 1]) scale([1, 2]) circle(r = "
        "1);",
        Facets::automatic, [](const Point& p) {
            const double part = (p.z() + 2) / 4;
            const Point2 q = p.head<2>() / (1 - part / 2) - Point2(3, 1);
            return part >= 0 && part <= 1 && q.cwiseProduct(Point2(1, .5)).norm() <= 1;
        });
    check_inside(
        "linear_extrude(height = 4) intersection() { circle(r = 3); translate([0, -1]) square([5, 2]); }",
        Facets::round, [](const Point& p) {
            return p.z() >= 0 && p.z() <= 4 && p.head<2>().norm() <= 3 && p.x() >= 0 && std::abs(p.y()) <= 1;
        });
}
