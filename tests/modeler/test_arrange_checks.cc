#include <doctest/doctest.h>

#include "modeler/arrange_classifier.hh"
#include "modeler/arrange_self_intersection.hh"
#include "tests/modeler/surfaces.hh"

using namespace maille::modeler;
using namespace maille::modeler::test;

namespace {

FacetComplex complex_of(std::vector<Vector3d> points, std::vector<std::array<std::uint32_t, 3>> triangles) {
    FacetComplex complex{std::move(points), {}};
    for (const auto& t : triangles) complex.facets.push_back({t, 0, outside, 0});
    return complex;
}

bool collide(std::vector<Vector3d> points, std::vector<std::array<std::uint32_t, 3>> triangles) {
    const FacetComplex complex = complex_of(std::move(points), std::move(triangles));
    const auto found = find_self_intersection(complex);
    CHECK(found.has_value() != find_self_intersections(complex).empty());
    return found.has_value();
}

}  // namespace

TEST_CASE("Facets that meet only in common vertices and edges are fit") {
    const std::vector<Vector3d> p{{0, 0, 0}, {1, 0, 0},   {0, 1, 0}, {0, 0, 1},
                                  {1, 1, 0}, {-1, -1, 0}, {-1, 0, 1}};
    CHECK_FALSE(collide(p, {{0, 1, 2}}));
    CHECK_FALSE(collide(p, {{0, 1, 2}, {0, 3, 1}}));
    CHECK_FALSE(collide(p, {{0, 1, 2}, {1, 4, 2}}));  // in one plane, side by side
    CHECK_FALSE(collide(p, {{0, 1, 2}, {0, 5, 6}}));  // a common vertex
    CHECK_FALSE(collide({}, {}));
    const auto ball = sphere({0, 0, 0}, 1, 3);
    CHECK_FALSE(collide(ball.points, ball.triangles));
}

TEST_CASE("Facets that cross, overlap or touch are found") {
    const std::vector<Vector3d> p{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {2, 1, 1},
                                  {4, 4, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0},  {2, 2, 0}, {8, 0, 0}};
    CHECK(collide(p, {{0, 1, 2}, {3, 4, 5}}));   // through the inside
    CHECK(collide(p, {{0, 1, 2}, {0, 3, 4}}));   // from a common vertex through the inside
    CHECK(collide(p, {{0, 1, 2}, {0, 1, 7}}));   // folded over a common edge
    CHECK(collide(p, {{0, 1, 2}, {7, 4, 5}}));   // a vertex on the inside
    CHECK(collide(p, {{0, 1, 2}, {8, 4, 5}}));   // a vertex on an edge
    CHECK(collide(p, {{0, 1, 2}, {9, 3, 5}}));   // two points at one place
    CHECK(collide(p, {{0, 1, 2}, {0, 1, 2}}));   // twice the same
    CHECK(collide(p, {{0, 1, 2}, {0, 2, 1}}));   // twice the same, turned over
    CHECK(collide(p, {{0, 1, 2}, {1, 6, 10}}));  // an edge of one is part of the other's
    CHECK(collide(p, {{0, 1, 11}}));             // no area
    CHECK(collide(p, {{0, 1, 2}, {0, 6, 11}}));  // one in the plane of the other, with a common vertex
}

TEST_CASE("Points are located in every primitive") {
    const std::vector solids{box({0, 0, 0}, {2, 2, 2}), box({1, 1, 1}, {3, 3, 3}), sphere({0, 0, 0}, 1, 3)};
    const SolidClassifier classifier(solids);
    const auto in = [&](double x, double y, double z) { return classifier.locate({x, y, z}).inside; };
    const auto on = [&](double x, double y, double z) { return classifier.locate({x, y, z}).boundary; };
    using Set = std::vector<std::uint32_t>;
    CHECK(in(0.25, 0.25, 0.25) == Set{0, 2});
    CHECK(in(1.5, 1.5, 1.5) == Set{0, 1});
    CHECK(in(2.5, 2.5, 2.5) == Set{1});
    CHECK(in(-0.1, -0.1, -0.1) == Set{2});
    CHECK(in(9, 9, 9).empty());
    CHECK(in(2.5, 0.5, 0.5).empty());
    CHECK(on(2, 1.5, 1.5) == Set{0});
    CHECK(in(2, 1.5, 1.5) == Set{1});
    CHECK(on(1, 1, 1) == Set{1});
    CHECK(on(2, 2, 1) == Set{0, 1});
    CHECK(on(0, 1.5, 0) == Set{0});
    CHECK(on(0.5, 0.25, 0.125).empty());
}

TEST_CASE("Location agrees with the distance from the middle") {
    const SolidClassifier classifier(std::vector{sphere({0, 0, 0}, 1, 4)});
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(-1, 1);
    for (int i = 0; i < 5000; ++i) {
        const Vector3d p(u(random), u(random), u(random));
        if (std::abs(p.norm() - 0.995) < 0.006) continue;
        CHECK(classifier.locate(p).inside.size() == (p.norm() < 1 ? 1 : 0));
    }
}
