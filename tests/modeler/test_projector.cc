#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include <doctest/doctest.h>

#include "modeler/model.hh"
#include "modeler/projector_touch.hh"
#include "surface_checks.hh"
#include "volmesh/error.hh"

using namespace maille::modeler;

namespace {

const Eigen::Affine3d identity = Eigen::Affine3d::Identity();

Model model_of(std::vector<std::shared_ptr<const Shape>> shapes) {
    Model model;
    for (auto& shape : shapes) {
        const std::string name = "part" + std::to_string(model.primitives.size());
        model.primitives.push_back({std::move(shape), name, "", 0});
    }
    return model;
}

/// Number of a surface by its name.
std::uint32_t number(const maille::volmesh::Projector& projector, const std::string& name) {
    const auto place = std::ranges::find(projector.surfaces, name);
    REQUIRE(place != projector.surfaces.end());
    return static_cast<std::uint32_t>(place - projector.surfaces.begin());
}

std::optional<Point> project(const maille::volmesh::Projector& projector,
                             const std::vector<std::string>& names, const Point& p) {
    std::vector<std::uint32_t> numbers;
    for (const std::string& name : names) numbers.push_back(number(projector, name));
    return projector.project(numbers, p);
}

Point random_point(std::mt19937& random, double reach) {
    std::uniform_real_distribution<double> coordinate(-reach, reach);
    return {coordinate(random), coordinate(random), coordinate(random)};
}

}  // namespace

TEST_CASE("Where two solids share a name, each keeps surfaces of its own") {
    maille::modeler::Model model =
        model_of({make_cylinder(1, 0.5, 0.5, false),
                  make_cylinder(1, 0.5, 0.5, false, Eigen::Affine3d(Eigen::Translation3d(3, 0, 0)))});
    for (auto& primitive : model.primitives) primitive.name = "hole";
    const auto projector = maille::modeler::projector(model);
    REQUIRE(projector.surfaces.size() == 12);
    const auto of_name = [&](const char* name) {
        std::vector<std::uint32_t> numbers;
        for (std::uint32_t i = 0; i < projector.surfaces.size(); ++i)
            if (projector.surfaces[i] == name) numbers.push_back(i);
        REQUIRE(numbers.size() == 2);
        return numbers;
    };
    const auto side = of_name("hole/side"), top = of_name("hole/top");
    const auto project = [&](std::vector<std::uint32_t> numbers, const Point& p) {
        return *projector.project(numbers, p);
    };
    CHECK((project({side[0]}, {0.4, 0, 0.3}) - Point(0.5, 0, 0.3)).norm() < 1e-15);
    CHECK((project({side[1]}, {2.7, 0, 0.3}) - Point(2.5, 0, 0.3)).norm() < 1e-15);
    CHECK((project({side[1], top[1]}, {3.6, 0, 0.9}) - Point(3.5, 0, 1)).norm() < 1e-12);
}

TEST_CASE("A projector names all surfaces, then the same as inner ones") {
    const auto projector = maille::modeler::projector(
        model_of({make_cube({1, 1, 1}, false), make_cylinder(1, 1, 1, false), make_sphere(1)}));
    REQUIRE(projector.surfaces.size() == 20);
    CHECK(projector.surfaces[0] == "part0/x-");
    CHECK(projector.surfaces[6] == "part1/side");
    CHECK(projector.surfaces[9] == "part2/surface");
    CHECK(projector.surfaces[10] == "part0/x-/inner");
    CHECK(projector.model_size == doctest::Approx(std::sqrt(4 + 4 + 4)));
}

TEST_CASE("Edges and corners of a box are exact") {
    const auto projector = maille::modeler::projector(model_of({make_cube({1, 2, 3}, false)}));
    CHECK(*project(projector, {"part0/x+", "part0/y-"}, {0.9, 0.2, 1.234}) == Point(1, 0, 1.234));
    CHECK(*project(projector, {"part0/x+", "part0/y-", "part0/z+"}, {0.9, 0.2, 2.7}) == Point(1, 0, 3));
    CHECK(*project(projector, {"part0/x+", "part0/x+/inner", "part0/x+"}, {0.9, 0.2, 2.7}) ==
          Point(1, 0.2, 2.7));
    CHECK_FALSE(project(projector, {"part0/x+", "part0/x-"}, {0.5, 0.2, 2.7}));
}

TEST_CASE("What is on all its surfaces stays, bit by bit") {
    const auto projector =
        maille::modeler::projector(model_of({make_cylinder(1, 0.3, 0.3, false), make_sphere(0.7)}));
    std::mt19937 random(5);
    for (int i = 0; i < 200; ++i) {
        const Point p = random_point(random, 0.5);
        const auto once = project(projector, {"part0/side", "part1/surface"}, p);
        REQUIRE(once);
        CHECK(*project(projector, {"part0/side", "part1/surface"}, *once) == *once);
    }
}

TEST_CASE("The rim of a cylinder is a circle") {
    const auto projector = maille::modeler::projector(model_of({make_cylinder(1, 0.5, 0.5, false)}));
    std::mt19937 random(1);
    for (int i = 0; i < 1000; ++i) {
        const Point p = Point::UnitZ() + random_point(random, 0.8);
        const auto image = project(projector, {"part0/side", "part0/top"}, p);
        REQUIRE(image);
        const Eigen::Vector2d expected = 0.5 * p.head<2>().normalized();
        CHECK((*image - Point(expected.x(), expected.y(), 1)).norm() < 1e-13);
        CHECK(image->z() == 1);
    }
}

TEST_CASE("Two spheres meet in a circle") {
    const Eigen::Affine3d shift(Eigen::Translation3d(1, 0, 0));
    const auto projector = maille::modeler::projector(model_of({make_sphere(1), make_sphere(0.8, shift)}));
    const double x = (1 + 1 - 0.64) / 2, radius = std::sqrt(1 - x * x);
    std::mt19937 random(2);
    for (int i = 0; i < 1000; ++i) {
        const Point p = random_point(random, 0.9);
        const auto image = project(projector, {"part0/surface", "part1/surface"}, p);
        REQUIRE(image);
        const Eigen::Vector2d expected = radius * p.tail<2>().normalized();
        CHECK((*image - Point(x, expected.x(), expected.y())).norm() < 1e-13);
    }
}

TEST_CASE("Near a curve of any two surfaces the nearest of its points is found") {
    constexpr unsigned seed = 11;
    MESSAGE("seed " << seed);
    std::mt19937 random(seed);
    int found = 0;
    for (int round = 0; round < 25; ++round) {
        const auto frame = [&] { return test::random_frame(random, 2); };
        const std::vector<std::shared_ptr<const Shape>> kinds{
            make_sphere(1, frame()), make_cylinder(2, 0.7, 0.7, true, frame()), make_torus(1, 0.4, frame()),
            make_cylinder(2, 1, 0, true, frame()), make_cube({1.5, 1.5, 1.5}, true, frame())};
        const auto model = model_of({kinds[round % 5], kinds[(round / 5 + round + 1) % 5]});
        const auto projector = maille::modeler::projector(model);
        const std::uint32_t other = static_cast<std::uint32_t>(model.primitives[0].shape->faces().size());
        const std::array<std::uint32_t, 2> pair{0, other};
        for (int i = 0; i < 50; ++i) {
            const auto start = projector.project(pair, random_point(random, 1.5));
            if (!start) continue;
            const Point p = *start + random_point(random, 0.02);
            const auto image = projector.project(pair, p);
            if (!image) continue;
            ++found;
            std::array<Point, 2> normals;
            for (int k : {0, 1}) {
                const Shape& shape = *model.primitives[k].shape;
                CHECK((*image - shape.project(0, *image)).norm() <= 1e-12 * projector.model_size);
                normals[k] = shape.face_normal(0, *image);
            }
            const Point tangent = normals[0].cross(normals[1]);
            if (tangent.norm() > 0.2)
                CHECK(std::abs((p - *image).dot(tangent.normalized())) < 1e-11 * projector.model_size);
        }
    }
    CHECK(found > 600);
}

TEST_CASE("Redundant surfaces do no harm") {
    const Eigen::Affine3d beside(Eigen::Translation3d(1, 0.5, 0));
    const Eigen::Affine3d turned(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
    const auto projector = maille::modeler::projector(
        model_of({make_cube({1, 1, 1}, false), make_cube({1, 1, 1}, false, beside),
                  make_cylinder(1, 0.5, 0.5, false), make_cylinder(2, 0.5, 0.5, false, turned)}));
    CHECK(*project(projector, {"part0/z+", "part1/z+"}, {0.3, 0.4, 0.9}) == Point(0.3, 0.4, 1));
    CHECK(*project(projector, {"part0/z+", "part1/z+", "part0/x+", "part1/x-"}, {0.9, 0.4, 0.9}) ==
          Point(1, 0.4, 1));
    const auto same_cylinder = project(projector, {"part2/side", "part3/side"}, {0.3, 0.4, 0.7});
    REQUIRE(same_cylinder);
    CHECK((*same_cylinder - Point(0.3, 0.4, 0.7)).norm() < 1e-15);
    const auto rim =
        project(projector, {"part2/side", "part3/side", "part2/top", "part0/z+"}, {0.6, 0.8, 0.9});
    REQUIRE(rim);
    CHECK((*rim - Point(0.3, 0.4, 1)).norm() < 1e-15);
}

TEST_CASE("A plane that touches a cylinder meets it in a line") {
    const Eigen::Affine3d touching(Eigen::Translation3d(0.5, -1, 0));
    const auto projector = maille::modeler::projector(
        model_of({make_cylinder(1, 0.5, 0.5, false), make_cube({1, 2, 1}, false, touching)}));
    const auto image = project(projector, {"part0/side", "part1/x-"}, {0.48, 0.05, 0.4});
    REQUIRE(image);
    CHECK(image->x() == 0.5);
    CHECK(std::abs(image->y()) < 1e-5);
    CHECK(image->z() == doctest::Approx(0.4).epsilon(1e-12));
}

TEST_CASE("The point where two curved surfaces touch is found from near it") {
    constexpr unsigned seed = 11;
    MESSAGE("seed " << seed);
    std::mt19937 random(seed);
    const Eigen::Affine3d lying(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitY()));
    const Eigen::Affine3d beside(Eigen::Translation3d(1, 0, 0));
    const auto upright = make_cylinder(4, 1, 1, true), crossing = make_cylinder(4, 1, 1, true, lying);
    const auto ball = make_sphere(2), off_centre = make_cylinder(6, 1, 1, true, beside);
    const auto touch = [](const auto& a, const auto& b, const Point& p) {
        return touching_point({a.get(), 0}, {b.get(), 0}, p, 5);
    };
    for (int round = 0; round < 100; ++round) {
        const Point shift = random_point(random, 0.3);
        const auto steinmetz = touch(upright, crossing, Point(0, -1, 0) + shift);
        REQUIRE(steinmetz);
        CHECK((*steinmetz - Point(0, -1, 0)).norm() < 5e-12);
        const auto viviani = touch(ball, off_centre, Point(2, 0, 0) + shift);
        REQUIRE(viviani);
        CHECK((*viviani - Point(2, 0, 0)).norm() < 5e-12);
    }
    // Along the equator.
    const auto along = touch(make_sphere(1), upright, {0.9, 0.2, 0.1});
    REQUIRE(along);
    CHECK(along->head<2>().norm() == doctest::Approx(1).epsilon(1e-12));
    CHECK(std::abs(along->z()) < 1e-12);
    CHECK_FALSE(touch(ball, upright, {1, 0, 1.7}));
}

TEST_CASE("Where surfaces have no common point there is none") {
    const Eigen::Affine3d far(Eigen::Translation3d(3, 0, 0));
    const auto projector = maille::modeler::projector(model_of(
        {make_sphere(1), make_sphere(1, far), make_cylinder(1, 0.2, 0.2, false), make_torus(1, 0.2)}));
    CHECK_FALSE(project(projector, {"part0/surface", "part1/surface"}, {1.5, 0.1, 0.2}));
    CHECK_FALSE(project(projector, {"part2/side", "part3/surface"}, {0.3, 0.1, 0.2}));
    CHECK_FALSE(project(projector, {"part2/side", "part2/top", "part2/bottom"}, {0.3, 0.1, 0.2}));
}

TEST_CASE("The corners of a pyramid lie on all its planes") {
    constexpr unsigned seed = 3;
    MESSAGE("seed " << seed);
    std::mt19937 random(seed);
    for (int round = 0; round < 20; ++round) {
        const Eigen::Affine3d frame = test::random_frame(random, 4);
        const auto projector = maille::modeler::projector(model_of({make_pyramid(7, 1, 2, frame)}));
        const Point tip = frame * Point(0, 0, 2);
        const std::array<std::uint32_t, 7> sides{0, 1, 2, 3, 4, 5, 6};
        const auto image = projector.project(sides, tip + random_point(random, 0.1));
        REQUIRE(image);
        CHECK((*image - tip).norm() < 1e-13 * projector.model_size);
    }
}

namespace {

/// A curve in which two faces meet, with a parametrization of its own.
struct KnownCurve {
    const char* name;
    std::vector<std::shared_ptr<const Shape>> shapes;  ///< one, or two
    std::array<std::uint32_t, 2> surfaces;             ///< numbers
    std::function<Point(double)> at;                   ///< from 0 to 2 pi
};

std::vector<KnownCurve> known_curves(std::mt19937& random) {
    const Eigen::Affine3d frame = test::random_frame(random, 2);
    const auto slab = [&](const Eigen::Affine3d& by) { return make_cube({6, 6, 6}, true, frame * by); };
    const Eigen::Affine3d up(Eigen::Translation3d(0, 0, 3.4)), aside(Eigen::Translation3d(3.7, 0, 0));
    const Eigen::Affine3d offset(Eigen::Translation3d(0.4, 0, 0));
    Eigen::Affine3d sheared = Eigen::Affine3d::Identity();  // its lower face is the plane z = 0.4 + 0.2 x
    sheared.linear()(2, 0) = 0.2;
    sheared = up * sheared;
    return {
        {"rim",
         {make_cylinder(1, 0.7, 0.7, false, frame)},
         {0, 2},
         [=](double u) { return Point(frame * Point(0.7 * std::cos(u), 0.7 * std::sin(u), 1)); }},
        {"cone's rim",
         {make_cylinder(1, 0.9, 0.3, false, frame)},
         {0, 1},
         [=](double u) { return Point(frame * Point(0.9 * std::cos(u), 0.9 * std::sin(u), 0)); }},
        {"ellipsoid by a plane",
         {make_sphere(1, frame), slab(up)},
         {0, 5},
         [=](double u) {
             const double r = std::sqrt(1 - 0.16);
             return Point(frame * Point(r * std::cos(u), r * std::sin(u), 0.4));
         }},
        {"ellipsoid by a cylinder",
         {make_sphere(1, frame), make_cylinder(3, 0.5, 0.5, true, frame * offset)},
         {0, 1},
         [=](double u) {
             const double x = 0.4 + 0.5 * std::cos(u), y = 0.5 * std::sin(u);
             return Point(frame * Point(x, y, std::sqrt(1 - x * x - y * y)));
         }},
        {"cone by a slanting plane",
         {make_cylinder(2, 1, 0, false, frame), slab(sheared)},
         {0, 6},
         [=](double u) {
             // z = 0.4 + 0.2 x, x = (1 - z / 2) cos u.
             const double z = (0.4 + 0.2 * std::cos(u)) / (1 + 0.1 * std::cos(u)), r = 1 - z / 2;
             return Point(frame * Point(r * std::cos(u), r * std::sin(u), z));
         }},
        {"torus by a plane",
         {make_torus(1.2, 0.4, frame), slab(aside)},
         {0, 1},
         [=](double u) {
             const double rho = 1.2 + 0.4 * std::cos(u);
             return Point(frame * Point(0.7, std::sqrt(rho * rho - 0.49), 0.4 * std::sin(u)));
         }},
    };
}

/// The least distance from p to the curve, from samples, then closer ones around the best.
double brute_distance(const KnownCurve& curve, const Point& p) {
    constexpr int samples = 400;
    double best = 0, width = std::numbers::pi, least = 1e300;
    for (int level = 0; level < 10; ++level, width /= 40) {
        const double middle = best;
        for (int i = -samples; i <= samples; ++i) {
            const double u = middle + width * i / samples;
            const double distance = (curve.at(u) - p).norm();
            if (distance < least) least = distance, best = u;
        }
    }
    return least;
}

}  // namespace

TEST_CASE("The nearest points of curves, against samples of the curves") {
    constexpr unsigned seed = 23;
    MESSAGE("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
    for (int round = 0; round < 12; ++round)
        for (const KnownCurve& curve : known_curves(random)) {
            CAPTURE(curve.name);
            const auto projector = maille::modeler::projector(model_of(curve.shapes));
            for (int i = 0; i < 20; ++i) {
                const Point on_curve = curve.at(angle(random)), p = on_curve + random_point(random, 0.03);
                const auto stays = projector.project(curve.surfaces, on_curve);
                REQUIRE(stays);
                CHECK((*stays - on_curve).norm() < 1e-12 * projector.model_size);
                const auto image = projector.project(curve.surfaces, p);
                REQUIRE(image);
                CHECK(std::abs((*image - p).norm() - brute_distance(curve, p)) <
                      1e-12 * projector.model_size);
            }
        }
}

TEST_CASE("Corners where round and flat surfaces meet are found from near them") {
    constexpr unsigned seed = 29;
    MESSAGE("seed " << seed);
    std::mt19937 random(seed);
    for (int round = 0; round < 50; ++round) {
        const Eigen::Affine3d frame = test::random_frame(random, 2);
        const Eigen::Affine3d low(Eigen::Translation3d(0, 0, -2.7)), left(Eigen::Translation3d(-2.8, 0, 0));
        // The planes z = 0.3 and x = 0.2, the unit ball, a cylinder of radius 0.5 around z.
        const auto projector = maille::modeler::projector(
            model_of({make_sphere(1, frame), make_cylinder(3, 0.5, 0.5, true, frame),
                      make_cube({6, 6, 6}, true, frame * low), make_cube({6, 6, 6}, true, frame * left)}));
        const auto check = [&](const std::vector<std::string>& names, const Point& corner) {
            const Point expected = frame * corner;
            const auto found = project(projector, names, expected + random_point(random, 0.02));
            REQUIRE(found);
            CHECK((*found - expected).norm() < 1e-12 * projector.model_size);
        };
        check({"part0/surface", "part2/z+", "part3/x+"}, {0.2, std::sqrt(1 - 0.09 - 0.04), 0.3});
        check({"part1/side", "part2/z+", "part3/x+"}, {0.2, std::sqrt(0.25 - 0.04), 0.3});
        check({"part0/surface", "part1/side", "part3/x+"}, {0.2, std::sqrt(0.21), std::sqrt(0.75)});
        // Four surfaces through one point.
        check({"part1/side", "part2/z+", "part3/x+", "part2/z+/inner"}, {0.2, std::sqrt(0.21), 0.3});
    }
}
