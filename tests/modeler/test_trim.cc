#include <numbers>
#include <random>
#include <string>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "modeler/build.hh"
#include "modeler/shapes.hh"
#include "modeler/trim.hh"
#include "tests/modeler/arrange_checks.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

namespace {

using namespace maille;
using namespace maille::modeler;
using namespace maille::modeler::test;
using Eigen::Vector3d;

Eigen::Affine3d at(const Vector3d& place) {
    return Eigen::Affine3d(Eigen::Translation3d(place));
}

Model model_of(Operation operation, std::vector<std::shared_ptr<const Shape>> shapes) {
    Model model{{}, node(operation, {})};
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
        model.primitives.push_back({shapes[i], "p" + std::to_string(i), "", 0});
        model.tree.children.push_back(leaf(i));
    }
    return model;
}

double extent(const Primitive& primitive) {
    return primitive.shape->bounding_box().diagonal().norm();
}

/// A solid whose length may be anything from that of the others to a thousand times it.
std::shared_ptr<const Shape> far_reaching_shape(std::mt19937& random) {
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const double length = std::pow(10, number(0, 3)), a = number(0.4, 1.5), b = number(0.4, 1.5);
    Eigen::Affine3d frame = at({number(0, 2), number(0, 2), number(0, 2)});
    frame.rotate(Eigen::AngleAxisd(number(0, 3), Vector3d(number(-1, 1), number(-1, 1), 1).normalized()));
    switch (random() % 6) {
        case 0:
            return make_cube({length, length, length}, random() % 2 == 0, frame);
        case 1:
            return make_cylinder(length, a, b, random() % 2 == 0, frame);
        case 2:
            return make_cylinder(length, a, a, true, frame);
        case 3:
            return make_prism(5, a, length, frame);
        case 4:
            return make_wedge({length, a, b}, length / 2, frame);
        default:
            return make_sphere(a, frame);
    }
}

}  // namespace

TEST_CASE("trimmed primitives make the same solid") {
    constexpr unsigned seed = 7;
    CAPTURE(seed);
    std::mt19937 random(seed);
    int n_trimmed = 0;
    for (int round = 0; round < 300; ++round) {
        Model model;
        const auto n = static_cast<std::uint32_t>(2 + random() % 7);
        for (std::uint32_t i = 0; i < n; ++i)
            model.primitives.push_back({far_reaching_shape(random), "p" + std::to_string(i), "", 0});
        model.tree = random_tree(random, 0, n);
        const Model result = trimmed(model);
        for (std::uint32_t i = 0; i < n; ++i) {
            const Shape &before = *model.primitives[i].shape, &after = *result.primitives[i].shape;
            REQUIRE(before.faces().size() == after.faces().size());
            n_trimmed += before.bounding_box().volume() > after.bounding_box().volume();
        }
        const Eigen::AlignedBox3d box = bounding_box(model);
        if (box.isEmpty()) continue;
        for (int i = 0; i < 200; ++i) {
            const Point p = box.sample();
            const auto owner_in = [&](const Model& m) {
                return owner(m.tree, [&](std::uint32_t k) { return m.primitives[k].shape->contains(p); });
            };
            REQUIRE(owner_in(model) == owner_in(result));
        }
        CHECK(bounding_box(result).intersection(box).volume() >= bounding_box(result).volume() * (1 - 1e-9));
    }
    CHECK(n_trimmed > 100);
}

TEST_CASE("trimming again changes nothing, and neither does it where nothing is far") {
    const Model halved = model_of(Operation::difference,
                                  {make_sphere(5), make_cube({2000, 2000, 2000}, true, at({1000, 0, 0}))});
    const Model once = trimmed(halved), twice = trimmed(once);
    CHECK(once.primitives[1].shape != halved.primitives[1].shape);
    CHECK(extent(once.primitives[1]) < 200);
    CHECK(twice.primitives[1].shape == once.primitives[1].shape);

    const Model drilled = model_of(Operation::difference, {make_cube({10, 10, 2}, false),
                                                           make_cylinder(4, 1, 1, false, at({5, 5, -1}))});
    CHECK(trimmed(drilled).primitives[1].shape == drilled.primitives[1].shape);
}

TEST_CASE("a cube of any size cuts a part in two") {
    for (const double length : {1e3, 1e6, 1e10}) {
        CAPTURE(length);
        const Model model = model_of(
            Operation::intersection,
            {make_cube({4, 3, 2}, true), make_cube({length, length, length}, false, at({1, -1, -0.5}))});
        const auto mesh = build(model, {.size = 0.5});
        CHECK(volmesh::validate(mesh).ok());
        CHECK(volmesh::volume(mesh) == doctest::Approx(1 * 2.5 * 1.5).epsilon(1e-12));
        CHECK(volmesh::measure(mesh, mesh.find_set("p1/x-", volmesh::EntityKind::face)) ==
              doctest::Approx(2.5 * 1.5).epsilon(1e-12));
    }
}

TEST_CASE("solids that touch in a point stay solids") {
    const Model model = model_of(Operation::intersection, {make_cube({1, 1, 1}, false),
                                                           make_cube({90, 90, 90}, false, at({1, 1, 1}))});
    for (const Primitive& primitive : trimmed(model).primitives)
        CHECK(primitive.shape->bounding_box().volume() >= 1);
}

TEST_CASE("a drill may be longer than what it drills") {
    const auto drilled = [](double length) {
        return build(
            model_of(Operation::difference, {make_cube({6, 6, 1}, true), make_cylinder(length, 1, 1, true)}),
            {.size = 0.5});
    };
    const auto mesh = drilled(1e5);
    CHECK(volmesh::validate(mesh).ok());
    CHECK(volmesh::volume(mesh) == doctest::Approx(volmesh::volume(drilled(2))).epsilon(1e-3));
    CHECK(volmesh::volume(mesh) == doctest::Approx(36 - std::numbers::pi).epsilon(0.01));
}

TEST_CASE("a slanted cut of a cone stays where it is") {
    Eigen::Affine3d turned = at({0, 0, 1});
    turned.rotate(Eigen::AngleAxisd(0.5, Vector3d::UnitX()));
    const Model model = model_of(Operation::difference,
                                 {make_cylinder(2, 1, 0, false), make_cube({800, 800, 800}, false, turned)});
    const Model result = trimmed(model);
    REQUIRE(extent(result.primitives[1]) < 100);
    for (std::uint32_t f = 0; f < 6; ++f)
        if (model.primitives[1].shape->face_implicit(f, Point(0, 0, 1)) > -1)
            CHECK(std::abs(result.primitives[1].shape->face_implicit(f, Point(0, 0, 1))) < 1e-12);
}

TEST_CASE("an arch beyond what matters is not pressed flat") {
    const std::vector<Point> outline{{0, 0, 0}, {1, 0, 0}, {1, 0, 900},  {4, 0, 900},
                                     {4, 0, 0}, {5, 0, 0}, {5, 0, 1000}, {0, 0, 1000}};
    std::vector<Point> points = outline;
    for (const Point& p : outline) points.push_back(p + Point(0, 1, 0));
    std::vector<std::vector<std::uint32_t>> faces(2);
    for (std::uint32_t i = 0; i < 8; ++i) {
        faces[0].push_back(i);
        faces[1].push_back(15 - i);
        faces.push_back({i, i + 8, (i + 1) % 8 + 8, (i + 1) % 8});
    }
    const Model model =
        model_of(Operation::intersection,
                 {make_cube({9, 9, 9}, true),
                  make_polyhedron(points, faces, std::vector<std::string>(faces.size(), "f"))});
    CHECK(trimmed(model).primitives[1].shape == model.primitives[1].shape);
}
