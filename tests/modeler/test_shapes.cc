#include <functional>
#include <limits>
#include <numbers>

#include <doctest/doctest.h>

#include "modeler/shapes.hh"
#include "surface_checks.hh"
#include "volmesh/error.hh"

using namespace maille::modeler;
using std::numbers::pi;

namespace {

const Eigen::Affine3d identity = Eigen::Affine3d::Identity();

/// A curved face, and its own parametrization over the unit square: an oracle that shares nothing with the
/// shape.
struct CurvedFace {
    const char* name;
    std::shared_ptr<const Shape> shape;
    std::function<Point(double, double)> at;
    bool is_similar = false;  ///< the frame keeps angles
};

std::vector<CurvedFace> curved_faces(const Eigen::Affine3d& frame) {
    const auto around = [](double u) { return Eigen::Vector2d(std::cos(2 * pi * u), std::sin(2 * pi * u)); };
    // What is unbounded is bounded far away from the points that the tests ask for.
    const auto cone = [=](double r1, double r2) {
        return [=](double u, double v) {
            const double apex = r1 == r2 ? -20 : -r1 / (r2 - r1);
            const double z = apex + 20 * v * (r2 >= r1 ? 1 : -1) * (r1 == r2 ? 2 : 1);
            const Eigen::Vector2d xy = (r1 + (r2 - r1) * z) * around(u);
            return Point(frame * Point(xy.x(), xy.y(), z));
        };
    };
    return {{"ellipsoid", make_ellipsoid({1, 0.8, 0.3}, frame),
             [=](double u, double v) {
                 const Eigen::Vector2d xy = std::sin(pi * v) * around(u);
                 return Point(frame * Point(xy.x(), 0.8 * xy.y(), 0.3 * std::cos(pi * v)));
             }},
            {"sphere", make_sphere(0.7, frame),
             [=](double u, double v) {
                 const Eigen::Vector2d xy = 0.7 * std::sin(pi * v) * around(u);
                 return Point(frame * Point(xy.x(), xy.y(), 0.7 * std::cos(pi * v)));
             }},
            {"cylinder", make_cylinder(1, 0.6, 0.6, false, frame), cone(0.6, 0.6)},
            {"cone", make_cylinder(1, 0.6, 0, false, frame), cone(0.6, 0)},
            {"frustum", make_cylinder(1, 0.3, 0.9, false, frame), cone(0.3, 0.9)},
            {"torus", make_torus(1, 0.4, frame), [=](double u, double v) {
                 const Eigen::Vector2d xy = (1 + 0.4 * around(v).x()) * around(u);
                 return Point(frame * Point(xy.x(), xy.y(), 0.4 * around(v).y()));
             }}};
}

/// The least distance from p to the surface, from samples, then closer ones around the best.
double brute_distance(const CurvedFace& face, const Point& p) {
    constexpr int samples = 60;
    Eigen::Vector2d best(0.5, 0.5);
    double width = 0.5, least = std::numeric_limits<double>::infinity();
    for (int level = 0; level < 14; ++level, width /= 8) {
        const Eigen::Vector2d middle = best;
        for (int i = 0; i <= samples; ++i)
            for (int j = 0; j <= samples; ++j) {
                const Eigen::Vector2d uv =
                    middle + width * Eigen::Vector2d(2.0 * i / samples - 1, 2.0 * j / samples - 1);
                const double distance = (face.at(uv.x(), std::clamp(uv.y(), 0.0, 1.0)) - p).norm();
                if (distance < least) {
                    least = distance;
                    best = {uv.x(), std::clamp(uv.y(), 0.0, 1.0)};
                }
            }
    }
    return least;
}

Point random_point(std::mt19937& random, double reach) {
    std::uniform_real_distribution<double> coordinate(-reach, reach);
    return {coordinate(random), coordinate(random), coordinate(random)};
}

double size_of(const Shape& shape) {
    return shape.bounding_box().diagonal().norm();
}

std::string message_of(const std::function<void()>& make) {
    try {
        make();
    } catch (const maille::InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("Nothing on a surface is nearer than the projection") {
    constexpr unsigned seed = 23;
    MESSAGE("seed " << seed);
    std::mt19937 random(seed);
    for (int round = 0; round < 6; ++round) {
        const Eigen::Affine3d frame = round == 0 ? identity : test::random_frame(random, round < 4 ? 3 : 20);
        for (const CurvedFace& face : curved_faces(frame)) {
            CAPTURE(face.name);
            CAPTURE(round);
            const double size = size_of(*face.shape);
            for (int i = 0; i < 6; ++i) {
                const Point p = frame * random_point(random, i < 4 ? 1.2 : 4);
                const Point image = face.shape->project(0, p);
                CHECK(std::abs(face.shape->face_implicit(0, image)) <= 1e-13 * size);
                CHECK((image - p).norm() <= brute_distance(face, p) + 1e-12 * size);
            }
        }
    }
}

TEST_CASE("Points of a surface are on it, and stay") {
    constexpr unsigned seed = 29;
    MESSAGE("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    for (int round = 0; round < 8; ++round) {
        const Eigen::Affine3d frame = round == 0 ? identity : test::random_frame(random, 4);
        for (const CurvedFace& face : curved_faces(frame)) {
            CAPTURE(face.name);
            const double size = size_of(*face.shape);
            for (int i = 0; i < 50; ++i) {
                const double v =
                    std::string(face.name) == "torus" ? share(random) : 0.5 + 0.02 * share(random);
                const Point p = face.at(share(random), v);
                CHECK(std::abs(face.shape->face_implicit(0, p)) <= 1e-14 * size);
                const Point image = face.shape->project(0, p);
                CHECK((image - p).norm() <= 1e-14 * size);
                const Point off = face.shape->project(0, p + 0.1 * random_point(random, 1));
                CHECK((face.shape->project(0, off) - off).norm() <= (round == 0 ? 0 : 1e-15 * size));
            }
        }
    }
}

TEST_CASE("Normals point outwards and turn as the curvature says") {
    constexpr unsigned seed = 31;
    MESSAGE("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    for (int round = 0; round < 6; ++round) {
        const Eigen::Affine3d frame = round == 0 ? identity : test::random_frame(random, 3);
        for (const CurvedFace& face : curved_faces(frame)) {
            CAPTURE(face.name);
            const double limit = face.shape->max_curvature(0);
            for (int i = 0; i < 20; ++i) {
                const double v = std::string(face.name) == "torus" ? share(random) : 0.55;
                const Point p = face.at(share(random), v);
                const Point n = face.shape->face_normal(0, p);
                CHECK(n.norm() == doctest::Approx(1));
                const double step = 1e-6;
                CHECK(face.shape->face_implicit(0, p + step * n) == doctest::Approx(step).epsilon(1e-3));
                CHECK(face.shape->face_implicit(0, p - step * n) == doctest::Approx(-step).epsilon(1e-3));
                const Eigen::Matrix3d curvature = face.shape->face_curvature(0, p);
                CHECK((curvature * n).norm() < 1e-9 * (1 + curvature.norm()));
                const Point t = n.unitOrthogonal();
                const Point turned = (face.shape->face_normal(0, face.shape->project(0, p + step * t)) -
                                      face.shape->face_normal(0, face.shape->project(0, p - step * t))) /
                                     (2 * step);
                CHECK((curvature * t - turned).norm() < 1e-4 * (1 + limit));
                if (std::string(face.name).ends_with("sphere") || std::string(face.name) == "torus")
                    CHECK(curvature.norm() < 1.5 * limit);
            }
        }
    }
}

TEST_CASE("Places with many nearest points give one of them") {
    const double tolerance = 1e-15;
    CHECK(make_sphere(2)->project(0, Point::Zero()).norm() == doctest::Approx(2).epsilon(tolerance));
    const Point on_ellipsoid = make_ellipsoid({3, 2, 1})->project(0, Point::Zero());
    CHECK((on_ellipsoid - Point(0, 0, 1)).norm() < tolerance);
    // Within the focal ellipse: x / 3 = 3 * 0.5 / (9 - 1), and so on.
    const Point focal = make_ellipsoid({3, 2, 1})->project(0, {0.5, 0.25, 0});
    const double x = 9 * 0.5 / 8, y = 4 * 0.25 / 3;
    CHECK((focal - Point(x, y, std::sqrt(1 - x * x / 9 - y * y / 4))).norm() < 4 * tolerance);
    const Point on_cylinder = make_cylinder(1, 0.5, 0.5, false)->project(0, {0, 0, 0.3});
    CHECK(on_cylinder.head<2>().norm() == doctest::Approx(0.5));
    CHECK(on_cylinder.z() == 0.3);
    const auto cone = make_cylinder(1, 1, 0, false);
    CHECK(cone->project(0, {0, 0, 1}) == Point(0, 0, 1));
    CHECK(cone->project(0, {0.1, 0.1, 3}) == Point(0, 0, 1));
    const Point on_torus = make_torus(2, 0.5)->project(0, {2, 0, 0});
    CHECK(std::hypot(on_torus.head<2>().norm() - 2, on_torus.z()) == doctest::Approx(0.5));
    CHECK(make_torus(2, 0.5)->project(0, Point::Zero()).norm() == doctest::Approx(1.5));
    const auto stretched = make_cylinder(1, 1, 0, false, Eigen::Affine3d(Eigen::Scaling(2.0, 1.0, 1.0)));
    CHECK((stretched->project(0, {0, 0, 5}) - Point(0, 0, 1)).norm() < tolerance);
    const Point inside = stretched->project(0, {0, 0, 0.5});
    CHECK((inside - Point(0, 0.25, 0.75)).cwiseAbs().norm() < 1e-14);
}

TEST_CASE("The implicit function has the sign of the solid and grows as the distance") {
    constexpr unsigned seed = 37;
    MESSAGE("seed " << seed);
    std::mt19937 random(seed);
    const auto box = [](const Point& p) { return (p.array() >= 0).all() && (p.array() <= 1).all(); };
    for (int round = 0; round < 10; ++round) {
        const Eigen::Affine3d frame = round == 0 ? identity : test::random_frame(random, 4);
        struct Case {
            std::shared_ptr<const Shape> shape;
            std::function<bool(const Point&)> inside;
        };
        const std::vector<Case> cases{
            {make_cube({1, 1, 1}, false, frame), box},
            {make_sphere(0.9, frame), [](const Point& p) { return p.norm() <= 0.9; }},
            {make_cylinder(1, 0.9, 0.4, false, frame),
             [](const Point& p) {
                 return p.z() >= 0 && p.z() <= 1 && p.head<2>().norm() <= 0.9 - 0.5 * p.z();
             }},
            {make_torus(1, 0.4, frame),
             [](const Point& p) { return std::hypot(p.head<2>().norm() - 1, p.z()) <= 0.4; }},
            {make_wedge({1, 1, 1}, 0.5, frame),
             [&](const Point& p) { return box(p) && p.x() <= 1 - 0.5 * p.z(); }},
            {make_pyramid(4, 1, 1, frame),
             [](const Point& p) { return p.z() >= 0 && std::abs(p.x()) + std::abs(p.y()) <= 1 - p.z(); }}};
        for (const Case& c : cases)
            for (int i = 0; i < 200; ++i) {
                const Point p = random_point(random, 1.5);
                CHECK((c.shape->implicit(frame * p) <= 0) == c.inside(p));
                CHECK(c.shape->contains(frame * p) == c.inside(p));
            }
    }
}

TEST_CASE("Concave polyhedra know their inside") {
    // An L: 2 x 2 less its upper right quarter, 1 high.
    std::vector<Point> points;
    for (double z : {0.0, 1.0})
        for (auto [x, y] : {std::pair(0, 0), {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})
            points.emplace_back(x, y, z);
    std::vector<std::vector<std::uint32_t>> faces{{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
    std::vector<std::string> names{"bottom", "top"};
    for (std::uint32_t i = 0; i < 6; ++i) {
        faces.push_back({i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i});
        names.push_back("side" + std::to_string(i));
    }
    for (bool inside_out : {false, true}) {
        auto given = faces;
        if (inside_out)
            for (auto& face : given) std::ranges::reverse(face);
        const auto shape = make_polyhedron(points, given, names);
        CHECK(shape->implicit({0.5, 1.5, 0.5}) == doctest::Approx(-0.5));
        CHECK(shape->implicit({1.5, 1.5, 0.5}) == doctest::Approx(0.5));
        CHECK(shape->implicit({0.9, 0.9, 0.5}) == doctest::Approx(-std::hypot(0.1, 0.1)));
        CHECK(shape->implicit({1, 1, 0.5}) == 0);
        CHECK(shape->face_normal(0, Point::Zero()) == Point(0, 0, -1));
        CHECK(shape->faces()[3].name == "side1");
    }
}

TEST_CASE("Planes that are axis-aligned are so exactly") {
    Eigen::Affine3d quarter = Eigen::Affine3d::Identity();
    quarter.rotate(Eigen::AngleAxisd(pi / 2, Eigen::Vector3d::UnitZ()));  // its cosine is 6e-17
    for (const auto& shape : {make_cube({1, 2, 3}, false, quarter), make_cylinder(3, 1, 1, false, quarter)})
        for (std::uint32_t face = 0; face < shape->faces().size(); ++face) {
            if (!shape->faces()[face].planar) continue;
            const Point n = shape->face_normal(face, Point::Zero());
            CHECK(n.cwiseAbs().maxCoeff() == 1);
            CHECK(n.cwiseAbs().sum() == 1);
        }
    const auto cube = make_cube({1, 2, 3}, false, quarter);
    CHECK(cube->project(0, {0.3, 0.4, 0.5}).y() == 0);
    CHECK(cube->project(1, {0.3, 0.4, 0.5}).y() == 1);
    CHECK(cube->bounding_box().min() == Point(-2, 0, 0));
}

TEST_CASE("Faces have their names") {
    const auto names = [](const std::shared_ptr<const Shape>& shape) {
        std::string all;
        for (const PrimitiveFace& face : shape->faces()) all += (all.empty() ? "" : " ") + face.name;
        return all;
    };
    CHECK(names(make_cube({1, 1, 1}, true)) == "x- x+ y- y+ z- z+");
    CHECK(names(make_wedge({1, 1, 1}, 0.5)) == "x- x+ y- y+ z- z+");
    CHECK(names(make_wedge({1, 1, 1}, 0)) == "x- x+ y- y+ z-");
    CHECK(names(make_cylinder(1, 1, 2, true)) == "side bottom top");
    CHECK(names(make_cylinder(1, 1, 0, true)) == "side bottom");
    CHECK(names(make_cylinder(1, 0, 1, true)) == "side top");
    CHECK(names(make_prism(3, 1, 1)) == "side0 side1 side2 bottom top");
    CHECK(names(make_pyramid(3, 1, 1)) == "side0 side1 side2 bottom");
    CHECK(names(make_torus(2, 1)) == "surface");
    const Eigen::AlignedBox3d clip(Point(-1, -1, -1), Point(1, 1, 1));
    CHECK(names(make_halfspace({0, 0, 0}, {0, 0, 1}, clip)) == "plane clip1 clip2 clip3 clip4 clip5");
    const auto wedge = make_wedge({1, 1, 1}, 0.5);
    CHECK(wedge->face_normal(1, Point::Zero()).isApprox(Point(2, 0, 1).normalized()));
    const auto tetrahedron =
        make_tetrahedron({Point(0, 0, 0), Point(0, 1, 0), Point(1, 0, 0), Point(0, 0, 1)});
    CHECK(tetrahedron->face_normal(3, Point::Zero()) == Point(0, 0, -1));
    CHECK(tetrahedron->implicit({0.1, 0.1, 0.1}) < 0);
}

TEST_CASE("A half-space is what lies behind its plane, within the clip box") {
    constexpr unsigned seed = 41;
    MESSAGE("seed " << seed);
    std::mt19937 random(seed);
    const Eigen::AlignedBox3d clip(Point(-1, -2, -1), Point(1, 2, 3));
    for (int round = 0; round < 30; ++round) {
        const Point point = random_point(random, 2), normal = random_point(random, 1);
        const auto shape = make_halfspace(point, normal, clip);
        for (int i = 0; i < 100; ++i) {
            const Point p = clip.sample();
            CHECK(shape->contains(p) == (normal.dot(p - point) <= 0));
        }
        CHECK(shape->face_normal(0, point).isApprox(normal.normalized()));
        CHECK((shape->project(0, point) - point).norm() < 1e-14);
    }
}

TEST_CASE("Faces that are not planar are cut into triangles of one name") {
    std::vector<Point> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.3}, {0, 1, 0},
                              {0, 0, 1}, {1, 0, 1}, {1, 1, 1},   {0, 1, 1}};
    const std::vector<std::vector<std::uint32_t>> faces{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                        {2, 3, 7, 6}, {0, 4, 7, 3}, {1, 2, 6, 5}};
    const std::vector<std::string> names{"warped", "top", "y-", "y+", "x-", "x+"};
    const auto shape = make_polyhedron(points, faces, names);
    REQUIRE(shape->faces().size() == 7);
    CHECK(shape->faces()[0].name == "warped");
    CHECK(shape->faces()[1].name == "warped");
    CHECK(shape->faces()[2].name == "top");
    for (std::uint32_t face : {0u, 1u})
        CHECK(std::abs(shape->face_implicit(face, points[face == 0 ? 0 : 0])) < 1);
    CHECK(shape->contains({0.5, 0.5, 0.5}));
}

TEST_CASE("Polyhedra that bound no solid are refused with a reason") {
    const std::vector<Point> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::vector<std::string> names{"a", "b", "c", "d"};
    using Faces = std::vector<std::vector<std::uint32_t>>;
    const Faces good{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    CHECK_NOTHROW(make_polyhedron(points, good, names));
    const auto message = [&](const Faces& faces, const std::vector<Point>& at) {
        return message_of([&] { make_polyhedron(at, faces, {names.begin(), names.begin() + faces.size()}); });
    };
    CHECK(message({good[0], good[1], good[2]}, points).find("at least four faces") != std::string::npos);
    Faces turned = good;
    std::ranges::reverse(turned[3]);
    CHECK(make_polyhedron(points, turned, names)->contains({0.2, 0.2, 0.2}));
    CHECK(message({good[0], good[0], good[1], good[2]}, points).find("opposite senses") != std::string::npos);
    Faces wrong = good;
    wrong[2][0] = 9;
    CHECK(message(wrong, points).find("point 9") != std::string::npos);
    CHECK(message(good, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}).find("no volume") != std::string::npos);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(message(good, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, nan}}).find("not finite") !=
          std::string::npos);
}

TEST_CASE("Parameters that make no solid are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 infinite = std::numeric_limits<double>::infinity();
    Eigen::Affine3d flat(Eigen::Scaling(1.0, 1.0, 0.0));
    const Eigen::AlignedBox3d clip(Point(-1, -1, -1), Point(1, 1, 1));
    const std::vector<std::function<void()>> wrong{
        [] {
            make_cube({1, 0, 1}, false);
        },
        [] {
            make_cube({1, -1, 1}, false);
        },
        [&] {
            make_cube({1, nan, 1}, false);
        },
        [&] {
            make_cube({1, 1, 1}, false, flat);
        },
        [] { make_sphere(0); },
        [&] { make_sphere(infinite); },
        [&] { make_sphere(1, flat); },
        [] {
            make_ellipsoid({1, 2, 0});
        },
        [] { make_cylinder(1, 0, 0, false); },
        [] { make_cylinder(1, -1, 1, false); },
        [] { make_cylinder(0, 1, 1, false); },
        [&] { make_cylinder(1, 1, nan, false); },
        [] { make_torus(1, 1); },
        [] { make_torus(1, 2); },
        [] { make_torus(1, 0); },
        [] {
            make_wedge({1, 1, 1}, -1);
        },
        [] { make_prism(2, 1, 1); },
        [] { make_prism(5, 0, 1); },
        [] { make_pyramid(5, 1, 0); },
        [] {
            make_tetrahedron({Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(1, 1, 0)});
        },
        [&] {
            make_halfspace({0, 0, 0}, {0, 0, 0}, clip);
        },
        [&] {
            make_halfspace({0, 0, nan}, {0, 0, 1}, clip);
        },
        [] {
            make_halfspace({0, 0, 0}, {0, 0, 1}, Eigen::AlignedBox3d());
        }};
    for (std::size_t i = 0; i < wrong.size(); ++i) {
        CAPTURE(i);
        CHECK_THROWS_AS(wrong[i](), maille::InputError);
    }
}
