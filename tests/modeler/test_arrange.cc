#include <numeric>

#include <doctest/doctest.h>

#include "modeler/arrange.hh"
#include "modeler/arrange_classifier.hh"
#include "tests/modeler/arrange_checks.hh"
#include "tests/modeler/surfaces.hh"
#include "volmesh/error.hh"

using namespace maille::modeler;
using namespace maille::modeler::test;
using maille::InputError;

TEST_CASE("Two boxes at every offset of nothing, a half and one") {
    for (int i = 0; i < 125; ++i) {
        const Vector3d shift(i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2);
        const std::vector<std::array<Vector3d, 2>> corners{
            {Vector3d(2, 2, 2), Vector3d(4, 4, 4)}, {Vector3d(2, 2, 2) + shift, Vector3d(4, 4, 4) + shift}};
        const std::vector primitives{box(corners[0][0], corners[0][1]), box(corners[1][0], corners[1][1], 6)};
        for (const auto operation : operations) {
            CAPTURE(shift.transpose());
            CAPTURE(int(operation));
            check_volumes(arrange(primitives, pair(operation)), count_cells(corners, pair(operation), 6),
                          1e-14);
        }
    }
}

TEST_CASE("Random deep trees of boxes on a grid have the volumes that counting cells gives") {
    for (unsigned seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        std::vector<std::array<Vector3d, 2>> corners;
        std::vector<ClosedSurface> primitives;
        for (std::uint32_t i = 0; i < 12; ++i) {
            Vector3d low, high;
            for (int k = 0; k < 3; ++k) {
                const auto start = static_cast<int>(random() % 5), length = static_cast<int>(random() % 5);
                low[k] = start;
                high[k] = std::min(6, start + 1 + length);
            }
            corners.push_back({low, high});
            primitives.push_back(box(low, high, 6 * i));
        }
        const CsgTree tree = random_tree(random, 0, 12);
        const auto expected = count_cells(corners, tree, 6);
        check_volumes(arrange(primitives, tree), expected, 1e-13);

        // The same turned: no plane is exact any more.
        if (seed % 8 != 0) continue;
        const Eigen::Affine3d motion = random_motion(random, 1);
        std::vector<ClosedSurface> turned;
        for (const auto& p : primitives) turned.push_back(transformed(p, motion));
        check_volumes(arrange(turned, tree), expected, 1e-12);
    }
}

TEST_CASE("Volumes add up for solids in general position") {
    for (unsigned seed = 0; seed < 9; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        const auto solid = [&](unsigned kind) {
            const ClosedSurface s = kind == 0   ? box({-1, -1, -1}, {1, 1, 1})
                                    : kind == 1 ? sphere({0, 0, 0}, 1.1, 2)
                                                : cylinder(0.7, 2, 24);
            return transformed(s, random_motion(random, 0.7));
        };
        const std::vector primitives{solid(seed % 3), solid(seed / 3 % 3)};
        const double a = volume(primitives[0]), b = volume(primitives[1]);
        const double both = volume_of(primitives, pair(Operation::intersection));
        CHECK(volume_of(primitives, pair(Operation::join)) == doctest::Approx(a + b - both).epsilon(1e-12));
        CHECK(volume_of(primitives, pair(Operation::difference)) == doctest::Approx(a - both).epsilon(1e-12));
        const auto parts = volumes(arrange(primitives, pair(Operation::fragment)).complex);
        CHECK(parts.at(0) == doctest::Approx(a).epsilon(1e-12));
        if (parts.contains(1)) CHECK(parts.at(1) == doctest::Approx(b - both).epsilon(1e-12));
    }
}

TEST_CASE("Random points are in the regions that the tree says") {
    for (unsigned seed = 0; seed < 6; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        std::vector<ClosedSurface> primitives;
        for (std::uint32_t i = 0; i < 5; ++i) {
            const ClosedSurface s =
                i % 2 ? sphere({0, 0, 0}, 0.8, 1, 10 * i) : box({0, 0, 0}, {1, 1.2, 1.4}, 10 * i);
            primitives.push_back(transformed(s, random_motion(random, 0.6)));
        }
        const CsgTree tree = random_tree(random, 0, 5);
        const Arrangement a = arrange(primitives, tree);
        check_sound(a);
        std::vector<ClosedSurface> shells;
        for (Region r = 0; r < 5; ++r) shells.push_back(shell(a.complex, r));
        const SolidClassifier before(primitives), after(shells);
        std::uniform_real_distribution<double> u(-1.5, 1.5);
        for (int i = 0; i < 2000; ++i) {
            const Vector3d p(u(random), u(random), u(random));
            const auto in = before.locate(p).inside;
            const auto expected = owner(tree, [&](std::uint32_t k) { return std::ranges::count(in, k) > 0; });
            const auto found = after.locate(p).inside;
            CHECK(found.size() == (expected ? 1 : 0));
            if (expected && !found.empty()) CHECK(found[0] == *expected);
        }
    }
}

TEST_CASE("Identical, nested, disjoint and touching solids") {
    const auto big = box({0, 0, 0}, {4, 4, 4}), small = box({1, 1, 1}, {2, 2, 2}, 6),
               far = box({9, 0, 0}, {10, 1, 1}, 6);
    CHECK(volume_of({big, big}, pair(Operation::join)) == doctest::Approx(64).epsilon(1e-14));
    CHECK(volume_of({big, big}, pair(Operation::intersection)) == doctest::Approx(64).epsilon(1e-14));
    CHECK(volume_of({big, small}, pair(Operation::join)) == doctest::Approx(64).epsilon(1e-14));
    CHECK(volume_of({big, small}, pair(Operation::difference)) == doctest::Approx(63).epsilon(1e-14));
    CHECK(volume_of({big, small}, pair(Operation::intersection)) == doctest::Approx(1).epsilon(1e-14));
    CHECK(volume_of({big, far}, pair(Operation::join)) == doctest::Approx(65).epsilon(1e-14));

    const auto ball = sphere({0, 0, 0}, 1, 2);
    CHECK(volume_of({ball, ball}, pair(Operation::join)) == doctest::Approx(volume(ball)).epsilon(1e-14));

    // Two cubes that touch along one edge, and at one corner.
    CHECK(volume_of({big, box({4, 4, 0}, {5, 5, 3}, 6)}, pair(Operation::join)) ==
          doctest::Approx(67).epsilon(1e-14));
    CHECK(volume_of({big, box({4, 4, 4}, {5, 5, 5}, 6)}, pair(Operation::join)) ==
          doctest::Approx(65).epsilon(1e-14));

    // An edge through a face, a corner on a face.
    const Eigen::Affine3d turn(Eigen::AngleAxisd(std::numbers::pi / 4, Vector3d::UnitZ()));
    const auto diamond = transformed(box({-1, -1, 0}, {1, 1, 2}, 6), turn);
    const auto touching =
        transformed(diamond, Eigen::Affine3d(Eigen::Translation3d(4 + std::sqrt(2.0), 2, 1)));
    CHECK(volume_of({big, touching}, pair(Operation::join)) == doctest::Approx(72).epsilon(1e-12));

    // A corner that touches a face in its middle.
    const auto pointed = transformed(
        box({0, 0, 0}, {1, 1, 1}, 6),
        Eigen::Affine3d(Eigen::Quaterniond::FromTwoVectors(Vector3d(1, 1, 1), Vector3d(0, 0, 1))));
    const auto on_top = transformed(pointed, Eigen::Affine3d(Eigen::Translation3d(2.25, 1.5, 4)));
    CHECK(volume_of({big, on_top}, pair(Operation::join)) == doctest::Approx(65).epsilon(1e-12));
}

TEST_CASE("Empty results are empty") {
    const auto a = box({0, 0, 0}, {1, 1, 1}), b = box({2, 0, 0}, {3, 1, 1}, 6);
    for (const auto& [primitives, operation] :
         {std::pair(std::vector{a, b}, Operation::intersection),
          {std::vector{a, a}, Operation::difference},
          {std::vector{a, box({1, 0, 0}, {2, 1, 1})}, Operation::intersection}}) {
        const Arrangement result = arrange(primitives, pair(operation));
        CHECK(result.complex.facets.empty());
        CHECK(result.complex.points.empty());
    }
    CHECK(arrange({}, node(Operation::join, {})).complex.facets.empty());
    CHECK(arrange(std::vector{ClosedSurface{}, a}, pair(Operation::join)).complex.facets.size() == 12);
}

TEST_CASE("Cubes turned inside each other") {
    std::vector<ClosedSurface> cubes;
    CsgTree join = node(Operation::join, {}), meet = node(Operation::intersection, {});
    double least = 8;
    for (std::uint32_t i = 0; i < 4; ++i) {
        const Eigen::Affine3d turn(Eigen::AngleAxisd(0.2 * i, Vector3d(1, 2, 3).normalized()));
        cubes.push_back(transformed(box({-1, -1, -1}, {1, 1, 1}, 6 * i), turn));
        join.children.push_back(leaf(i));
        meet.children.push_back(leaf(i));
        const double both = volume_of(cubes, meet);
        CHECK(both <= least);
        least = both;
    }
    CHECK(volume_of(cubes, join) > 8);
    CHECK(least > 4 * std::numbers::pi / 3);  // all hold the unit ball
}

TEST_CASE("Size and place make no difference") {
    const auto a = box({0, 0, 0}, {1, 1, 1});
    const auto b =
        transformed(sphere({0, 0, 0}, 0.7, 2, 6), Eigen::Affine3d(Eigen::Translation3d(0.9, 0.8, 0.7)));
    const double expected = volume_of({a, b}, pair(Operation::difference));
    for (const double scale : {1e-6, 1e6}) {
        const Eigen::Affine3d t(Eigen::Scaling(scale));
        const double v = volume_of({transformed(a, t), transformed(b, t)}, pair(Operation::difference));
        CHECK(v / (scale * scale * scale) == doctest::Approx(expected).epsilon(1e-12));
    }
    const Eigen::Affine3d away(Eigen::Translation3d(1e6, -1e6, 1e6));
    const double v = volume_of({transformed(a, away), transformed(b, away)}, pair(Operation::difference));
    CHECK(v == doctest::Approx(expected).epsilon(1e-8));
}

TEST_CASE("What nothing meets comes back as it was") {
    const auto ball = sphere({0, 0, 0}, 1, 3, 7);
    const std::vector primitives{ball, box({0.8, -0.1, -0.1}, {1.2, 0.1, 0.1}, 20)};
    const Arrangement a = arrange(primitives, pair(Operation::join));
    std::size_t whole = 0;
    for (std::size_t i = 0; i < a.parents.size(); ++i) {
        const FacetParent& parent = a.parents[i];
        const Facet& f = a.complex.facets[i];
        CHECK(f.surface == primitives[parent.primitive].surfaces[parent.triangle]);
        if (!parent.whole || parent.primitive != 0) continue;
        ++whole;
        for (const auto v : f.vertices) {
            const auto& t = ball.triangles[parent.triangle];
            CHECK(std::ranges::any_of(t, [&](auto k) { return ball.points[k] == a.complex.points[v]; }));
        }
    }
    CHECK(whole > 1180);
    CHECK(whole < 1280);
}

TEST_CASE("Facets know the surface that they lie on") {
    const std::vector primitives{box({0, 0, 0}, {2, 2, 2}), box({1, 0, 0}, {3, 2, 2}, 6)};
    const auto area_of = [](const Arrangement& a, std::uint32_t surface) {
        FacetComplex part = a.complex;
        std::erase_if(part.facets, [&](const Facet& f) { return f.surface != surface; });
        return outer_area(part);
    };
    const Arrangement join = arrange(primitives, pair(Operation::join));
    CHECK(area_of(join, 0) == 4);
    CHECK(area_of(join, 1) == 0);
    CHECK(area_of(join, 7) == 4);
    for (const std::uint32_t k : {2U, 3U, 4U, 5U}) {
        CHECK(area_of(join, k) == 4);
        CHECK(area_of(join, 6 + k) == 2);
    }
    const Arrangement difference = arrange(primitives, pair(Operation::difference));
    CHECK(area_of(difference, 6) == 4);
    for (const std::uint32_t k : {2U, 3U, 4U, 5U}) {
        CHECK(area_of(difference, k) == 2);
        CHECK(area_of(difference, 6 + k) == 0);
    }
}

TEST_CASE("The same input gives the same bytes") {
    std::mt19937 random(3);
    const std::vector primitives{sphere({0, 0, 0}, 1, 2),
                                 transformed(cylinder(0.5, 3, 17, 1), random_motion(random, 0.5))};
    const Arrangement a = arrange(primitives, pair(Operation::fragment)),
                      b = arrange(primitives, pair(Operation::fragment));
    CHECK(a.complex.points == b.complex.points);
    REQUIRE(a.complex.facets.size() == b.complex.facets.size());
    for (std::size_t i = 0; i < a.complex.facets.size(); ++i)
        CHECK(a.complex.facets[i].vertices == b.complex.facets[i].vertices);
}

TEST_CASE("Surfaces that cannot be used are refused") {
    const auto good = box({0, 0, 0}, {1, 1, 1});
    auto open = good;
    open.triangles.pop_back(), open.surfaces.pop_back();
    CHECK_THROWS_AS(arrange(std::vector{open}, leaf(0)), InputError);
    auto wild = good;
    wild.triangles[3][1] = 8;
    CHECK_THROWS_AS(arrange(std::vector{wild}, leaf(0)), InputError);
    auto infinite = good;
    infinite.points[2].x() = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(arrange(std::vector{infinite}, leaf(0)), InputError);
    CHECK_THROWS_AS(arrange(std::vector{good}, leaf(1)), InputError);
    auto unnumbered = good;
    unnumbered.surfaces.pop_back();
    CHECK_THROWS_AS(arrange(std::vector{unnumbered}, leaf(0)), InputError);
}

TEST_CASE("an arrangement that fails names the primitives and the place") {
    const ArrangeError error("cannot be cut where they meet", {1, 4}, {0.5, -2, 1e6});
    CHECK(std::string(error.what()) ==
          "the surfaces of primitives 1 and 4 near (0.5, -2, 1000000) cannot be cut where they meet");
    CHECK(error.primitives() == std::vector<std::uint32_t>{1, 4});
    CHECK(error.place() == Vector3d(0.5, -2, 1e6));
    CHECK(error.problem() == "cannot be cut where they meet");
}

TEST_CASE("an arrangement that takes too much work fails, and tells where") {
    const std::vector boxes{box({0, 0, 0}, {2, 2, 2}), box({1, 1, 1}, {3, 3, 3})};
    const CsgTree tree{Operation::join, 0, {leaf(0), leaf(1)}};
    const Arrangement all = arrange(boxes, tree);
    int n_failed = 0, n_done = 0;
    for (double most = 1.0 / 16; most < 100; most *= 1.25) {
        CAPTURE(most);
        try {
            const Arrangement limited = arrange(boxes, tree, {.most_contacts = most});
            CHECK(limited.complex.points == all.complex.points);
            CHECK(limited.complex.facets.size() == all.complex.facets.size());
            ++n_done;
        } catch (const ArrangeLimitError& error) {
            // Once it is enough, more is enough.
            CHECK(n_done == 0);
            ++n_failed;
            CHECK(error.primitives() == std::vector<std::uint32_t>{0, 1});
            CHECK(Eigen::AlignedBox3d(Vector3d(0, 0, 0), Vector3d(3, 3, 3)).contains(error.place()));
        }
    }
    CHECK(n_failed > 5);
    CHECK(n_done > 5);
}
