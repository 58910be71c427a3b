#include <cmath>
#include <map>
#include <numbers>

#include <doctest/doctest.h>

#include "modeler/openscad_facets.hh"
#include "volmesh/error.hh"

using namespace maille;
using namespace maille::modeler;

namespace {

/// Volume by the divergence theorem; positive where the faces turn counter-clockwise seen from outside.
double volume(const FacetedSolid& solid) {
    double sum = 0;
    for (const auto& face : solid.faces)
        for (std::size_t i = 2; i < face.size(); ++i)
            sum += solid.points[face[0]].dot(solid.points[face[i - 1]].cross(solid.points[face[i]])) / 6;
    return sum;
}

bool is_closed(const FacetedSolid& solid) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    for (const auto& face : solid.faces)
        for (std::size_t i = 0; i < face.size(); ++i) {
            const std::uint32_t a = face[i];
            const std::uint32_t b = face[(i + 1) % face.size()];
            balance[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    return std::ranges::all_of(balance, [](const auto& entry) { return entry.second == 0; });
}

}  // namespace

TEST_CASE("angles in degrees are exact where they can be") {
    CHECK(sin_degrees(0) == 0);
    CHECK(sin_degrees(30) == 0.5);
    CHECK(sin_degrees(90) == 1);
    CHECK(sin_degrees(180) == 0);
    CHECK(sin_degrees(-90) == -1);
    CHECK(cos_degrees(60) == 0.5);
    CHECK(cos_degrees(90) == 0);
    CHECK(cos_degrees(-270) == 0);
    CHECK(cos_degrees(180) == -1);
    CHECK(cos_degrees(720) == 1);
    CHECK(sin_degrees(45) == std::sqrt(0.5));
    CHECK(cos_degrees(45) == std::sqrt(0.5));
    CHECK(sin_degrees(120) == std::sqrt(3.0) / 2);
    CHECK(cos_degrees(30) == std::sqrt(3.0) / 2);
    for (double angle = -800; angle < 800; angle += 7.3) {
        CHECK(sin_degrees(angle) == doctest::Approx(std::sin(angle * std::numbers::pi / 180)).epsilon(1e-12));
        CHECK(cos_degrees(angle) == doctest::Approx(std::cos(angle * std::numbers::pi / 180)).epsilon(1e-12));
    }
}

TEST_CASE("the number of facets follows OpenSCAD's rule") {
    CHECK(openscad_fragments(1, {.fn = 0, .fa = 12, .fs = 2}) == 5);     // never less than 5
    CHECK(openscad_fragments(4, {.fn = 0, .fa = 12, .fs = 2}) == 13);    // ceil(8 pi / 2)
    CHECK(openscad_fragments(100, {.fn = 0, .fa = 12, .fs = 2}) == 30);  // 360 / 12
    CHECK(openscad_fragments(10, {.fn = 0, .fa = 5, .fs = 0.1}) == 72);
    CHECK(openscad_fragments(1, {.fn = 1}) == 3);
    CHECK(openscad_fragments(1, {.fn = 6.9}) == 6);
    CHECK(openscad_fragments(1e-9, {.fn = 50}) == 3);
    CHECK_THROWS_AS(openscad_fragments(1, {.fn = 2001}), InputError);
    CHECK_THROWS_AS(openscad_fragments(1e6, {.fn = 0, .fa = 0, .fs = 0}), InputError);
}

TEST_CASE("a faceted cylinder is OpenSCAD's prism") {
    for (const int n : {3, 6, 7, 30}) {
        const double polygon = n / 2.0 * std::sin(2 * std::numbers::pi / n);  // of the unit circle
        const FacetedSolid prism = openscad_cylinder(3, 2, 2, true, n);
        CHECK(is_closed(prism));
        CHECK(volume(prism) == doctest::Approx(polygon * 4 * 3).epsilon(1e-12));
        CHECK(prism.points[0] == Point(2, 0, -1.5));
        for (const bool tip_up : {true, false}) {
            const FacetedSolid cone = openscad_cylinder(3, tip_up ? 2 : 0, tip_up ? 0 : 2, false, n);
            CHECK(is_closed(cone));
            CHECK(cone.faces.size() == static_cast<std::size_t>(n) + 1);
            CHECK(volume(cone) == doctest::Approx(polygon * 4).epsilon(1e-12));
        }
        const FacetedSolid frustum = openscad_cylinder(3, 2, 1, false, n);
        CHECK(is_closed(frustum));
        CHECK(volume(frustum) == doctest::Approx(polygon * (4 + 2 + 1)).epsilon(1e-12));
    }
}

TEST_CASE("a faceted sphere is OpenSCAD's rings at half angles") {
    for (const int n : {3, 5, 8, 30}) {
        const FacetedSolid ball = openscad_sphere(2, n);
        const int rings = (n + 1) / 2;
        CHECK(is_closed(ball));
        CHECK(ball.points.size() == static_cast<std::size_t>(n * rings));
        CHECK(ball.points[0].z() == doctest::Approx(2 * std::cos(std::numbers::pi / 2 / rings)));
        for (const Point& p : ball.points) CHECK(p.norm() == doctest::Approx(2).epsilon(1e-14));
        // Frusta between the rings.
        const double polygon = n / 2.0 * std::sin(2 * std::numbers::pi / n);
        double expected = 0;
        for (int i = 1; i < rings; ++i) {
            const double upper = std::numbers::pi * (i - 0.5) / rings;
            const double lower = std::numbers::pi * (i + 0.5) / rings;
            const double a = 2 * std::sin(upper);
            const double b = 2 * std::sin(lower);
            expected += polygon * (a * a + a * b + b * b) / 3 * 2 * (std::cos(upper) - std::cos(lower));
        }
        CHECK(volume(ball) == doctest::Approx(expected).epsilon(1e-12));
    }
}
