#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "modeler/build.hh"
#include "modeler/outline.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

using namespace maille;
using namespace maille::modeler;

namespace {

Outline rectangle(double x, double y, double width, double height) {
    return {{{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}}};
}

double area(const Outline& shape) {
    double sum = 0;
    for (const PlaneRegion& region : shape)
        for (const PlaneLoop& loop : region)
            for (std::size_t k = 0; k < loop.size(); ++k) {
                const Point2 &a = loop[k], &b = loop[(k + 1) % loop.size()];
                sum += (a.x() * b.y() - a.y() * b.x()) / 2;
            }
    return sum;
}

std::size_t n_corners(const Outline& shape) {
    std::size_t n = 0;
    for (const PlaneRegion& region : shape)
        for (const PlaneLoop& loop : region) n += loop.size();
    return n;
}

/// Each loop passes each place once, has no edge shorter than the distance, and turns as it should.
void check_sound(const Outline& shape, double distance) {
    for (const PlaneRegion& region : shape)
        for (const PlaneLoop& loop : region) {
            std::set<std::pair<double, double>> places;
            for (std::size_t k = 0; k < loop.size(); ++k) {
                places.emplace(loop[k].x(), loop[k].y());
                CHECK((loop[(k + 1) % loop.size()] - loop[k]).norm() > distance);
            }
            CHECK(places.size() == loop.size());
            CHECK((area({{loop}}) > 0) == (&loop == &region.front()));
        }
}

/// Meshes it, and checks that.
double volume_of(const std::string& text) {
    CAPTURE(text);
    const auto mesh = build(parse_model(text, "part.csg"));
    CHECK(volmesh::validate(mesh).ok());
    return volmesh::volume(mesh);
}

}  // namespace

TEST_CASE("flat shapes that six digits leave askew are flush") {
    constexpr double askew = 3e-6;
    const std::array beside{rectangle(0, 0, 2, 2), rectangle(2 + askew, askew, 3, 2)};
    const Outline both = combine(Operation::join, beside);
    REQUIRE(both.size() == 1);
    check_sound(both, 1e-4);
    CHECK(n_corners(both) <= 6);
    CHECK(area(both) == doctest::Approx(10).epsilon(1e-5));

    // What is cut away to the edge leaves no film there.
    const std::array cut{rectangle(0, 0, 4, 4), rectangle(1, askew, 2, 5),
                         rectangle(3 + askew, -1, 1 - 2 * askew, 6)};
    const Outline rest = combine(Operation::difference, cut);
    REQUIRE(rest.size() == 1);
    check_sound(rest, 1e-4);
    CHECK(area(rest) == doctest::Approx(4).epsilon(1e-4));
}

TEST_CASE("corners that nothing is near keep their places to the bit") {
    const Outline triangle{{{{0.1, 0.2}, {1.0 / 3, 0.7}, {-0.3, 1.1}}}};
    const std::array apart{triangle, rectangle(5, 5, 1.0 / 7, 1.0 / 11)};
    const Outline both = combine(Operation::join, apart);
    REQUIRE(both.size() == 2);
    for (const Outline& shape : apart)
        for (const Point2& p : shape.front().front())
            CHECK(std::ranges::any_of(both, [&](const PlaneRegion& region) {
                return std::ranges::find(region.front(), p) != region.front().end();
            }));
}

TEST_CASE("outlines that touch themselves are cut in two there") {
    const std::array squares{rectangle(0, 0, 1, 1), rectangle(1, 1, 1, 1)};
    const Outline diagonal = combine(Operation::join, squares);
    CHECK(diagonal.size() == 2);
    check_sound(diagonal, 0.5);
    CHECK(area(diagonal) == doctest::Approx(2).epsilon(1e-14));

    // A corner on the middle of an edge.
    const Outline flag = make_outline({{{0, 0}, {4, 0}, {4, 4}, {2, 2}, {4, 2}, {4, 1}, {0, 1}}});
    check_sound(flag, 0.5);
    CHECK(area(flag) == doctest::Approx(4 + 2).epsilon(1e-14));

    // A hole that touches the outline, and one that touches that hole.
    const std::array holed{rectangle(0, 0, 9, 9), Outline{{{{0, 4}, {2, 3}, {2, 5}}}}, rectangle(2, 5, 1, 1)};
    const Outline ring = combine(Operation::difference, holed);
    REQUIRE(ring.size() == 1);
    check_sound(ring, 0.5);
    CHECK(area(ring) == doctest::Approx(81 - 2 - 1).epsilon(1e-14));
}

TEST_CASE("shapes that touch themselves are extruded") {
    CHECK(volume_of("linear_extrude(height = 2) { square(1); translate([1, 1]) square(1); }") ==
          doctest::Approx(4).epsilon(1e-12));
    CHECK(volume_of("linear_extrude(height = 2) difference() { square(9); translate([3, 3]) square(1); "
                    "translate([4, 4]) square(2); polygon([[0, 4], [2, 7], [1, 8]]); }") ==
          doctest::Approx(2 * (81 - 1 - 4 - 2.5)).epsilon(1e-12));
    CHECK(volume_of("linear_extrude(height = 3) polygon([[4,0],[4,1],[3.5,1],[4,0.5],[-3,0.5],[-3,0]]);") ==
          doctest::Approx(3 * (0.5 * 7 + 0.125)).epsilon(1e-12));
}
