#include <algorithm>
#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include "refine/simplex_tree.hh"

using namespace maille::refine;

namespace {

class Random {
  public:
    explicit Random(unsigned seed) : engine_(seed) {}
    Point point(double reach) {
        std::uniform_real_distribution<double> u(-reach, reach);
        return {u(engine_), u(engine_), u(engine_)};
    }
    Simplex simplex(int n_corners, const Point& at, double reach) {
        Simplex s{{}, n_corners};
        for (int i = 0; i < n_corners; ++i) s.corners[i] = at + point(reach);
        return s;
    }

  private:
    std::mt19937 engine_;
};

/// A point of a convex set is the nearest to p if and only if no way into the set leads towards p.
void check_is_nearest(const Simplex& s, const NearestOnSimplex& found, const Point& p) {
    CHECK(found.weights.minCoeff() >= -1e-12);
    CHECK(found.weights.sum() == doctest::Approx(1).epsilon(1e-12));
    for (int i = s.n_corners; i < 4; ++i) CHECK(found.weights[i] == 0);
    const Point q = found.of(s);
    CHECK(found.squared_distance == doctest::Approx((p - q).squaredNorm()).epsilon(1e-9));
    for (int i = 0; i < s.n_corners; ++i) CHECK((p - q).dot(s.corners[i] - q) < 1e-10);
}

}  // namespace

TEST_CASE("the nearest point of a simplex leaves no way towards the point asked for") {
    Random random(1);
    for (int n_corners = 1; n_corners <= 4; ++n_corners)
        for (int i = 0; i < 3000; ++i) {
            const Simplex s = random.simplex(n_corners, Point::Zero(), 1);
            const Point p = random.point(2);
            check_is_nearest(s, nearest_on(s, p), p);
        }
}

TEST_CASE("degenerate simplices have a nearest point too") {
    const Point a(1, 2, 3), b(2, 2, 3), c(3, 2, 3), p(2.5, 3, 3);
    CHECK(nearest_on({{a, a}, 2}, p).squared_distance == doctest::Approx((p - a).squaredNorm()));
    CHECK(nearest_on({{a, b, c}, 3}, p).squared_distance == doctest::Approx(1));
    CHECK(nearest_on({{a, b, c, b}, 4}, p).squared_distance == doctest::Approx(1));
}

TEST_CASE("the tree finds what looking at all of them finds") {
    Random random(2);
    std::vector<Simplex> simplices;
    for (int i = 0; i < 400; ++i) simplices.push_back(random.simplex(1 + i % 4, random.point(3), 0.3));
    const SimplexTree tree(simplices);
    REQUIRE(tree.size() == simplices.size());
    for (int i = 0; i < 1000; ++i) {
        const Point p = random.point(4);
        double least = std::numeric_limits<double>::infinity();
        double least_value = least;
        for (std::uint32_t s = 0; s < simplices.size(); ++s) {
            const double found = nearest_on(simplices[s], p).squared_distance;
            least = std::min(least, found);
            least_value = std::min(least_value, 1 + s % 3 + 2 * std::sqrt(found));
        }
        const SimplexTree::Nearest nearest = tree.nearest(p);
        CHECK(nearest.squared_distance == least);
        CHECK(nearest_on(simplices[nearest.simplex], p).squared_distance == least);
        CHECK(tree.nearest(p, std::sqrt(least) * 1.001).squared_distance == least);
        CHECK(tree.nearest(p, std::sqrt(least) * 0.5).squared_distance >= least);
        const double value = tree.least(
            p, [](double distance) { return 1 + 2 * distance; },
            [&](std::uint32_t s) {
                return 1 + s % 3 + 2 * std::sqrt(nearest_on(simplices[s], p).squared_distance);
            });
        CHECK(value == least_value);
    }
}

TEST_CASE("a tree of one simplex finds it") {
    const SimplexTree tree({{{Point(1, 0, 0)}, 1}});
    CHECK(tree.nearest(Point(3, 0, 0)).squared_distance == 4);
}
