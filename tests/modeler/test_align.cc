#include <random>
#include <string>

#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "modeler/align.hh"
#include "modeler/build.hh"
#include "modeler/shape_polyhedron.hh"
#include "modeler/shapes.hh"
#include "tests/modeler/surfaces.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

namespace {

using namespace maille;
using namespace maille::modeler;
using namespace maille::modeler::test;
using Eigen::Vector3d;

constexpr double tolerance = 1e-4;

Model union_of(std::vector<std::shared_ptr<const Shape>> shapes) {
    Model model{{}, node(Operation::join, {})};
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
        model.primitives.push_back({shapes[i], "p" + std::to_string(i), "", 0});
        model.tree.children.push_back(leaf(i));
    }
    return model;
}

std::shared_ptr<const Shape> box_at(const Vector3d& place, const Vector3d& size) {
    return make_cube(size, false, Eigen::Affine3d(Eigen::Translation3d(place)));
}

/// A box as OpenSCAD writes it: six digits of its matrix.
std::string written_box(const Eigen::Affine3d& frame, const Vector3d& size) {
    std::string text = "multmatrix([";
    for (int row = 0; row < 4; ++row) {
        const Eigen::RowVector4d r = frame.matrix().row(row);
        text +=
            fmt::format("[{:.6g}, {:.6g}, {:.6g}, {:.6g}]{}", r[0], r[1], r[2], r[3], row < 3 ? ", " : "");
    }
    return text + fmt::format("]) {{ cube(size = [{}, {}, {}]); }}\n", size.x(), size.y(), size.z());
}

double farthest_from(const Shape& of, std::uint32_t face, const Shape& plane_of, std::uint32_t plane) {
    double farthest = 0;
    for (const Point& p : dynamic_cast<const Polyhedron&>(of).points())
        if (std::abs(of.face_implicit(face, p)) < 1e-9)
            farthest = std::max(farthest, std::abs(plane_of.face_implicit(plane, p)));
    return farthest;
}

}  // namespace

TEST_CASE("flush boxes written with six digits are flush, and mesh as well as if they had all digits") {
    constexpr unsigned seed = 3;
    CAPTURE(seed);
    std::mt19937 random(seed);
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int i = 0; i < 5; ++i) {
        Eigen::Affine3d base(Eigen::Translation3d(number(-20, 20), number(-20, 20), number(-20, 20)));
        base.rotate(Eigen::AngleAxisd(number(0, 1.5), Vector3d::UnitZ()));
        base.rotate(Eigen::AngleAxisd(number(0, 1.5), Vector3d::UnitX()));
        const auto placed = [&](double x, double y, double z) {
            return base * Eigen::Translation3d(x, y, z);
        };
        const std::string text =
            "union() {\n" + written_box(base, {10, 10, 10}) + written_box(placed(10, 0, 2), {6, 10, 5}) +
            written_box(placed(0, 10, 3), {16, 3, 4}) + written_box(placed(-3, 0, 0), {3, 3, 10}) + "}\n";
        const auto mesh = build(parse_model(text, "flush.csg"), {.size = 1.5});
        CHECK(volmesh::validate(mesh).ok());
        CHECK(volmesh::volume(mesh) == doctest::Approx(1000 + 300 + 192 + 90).epsilon(1e-5));
        double smallest = 1;
        for (const auto c : mesh.cells()) smallest = std::min(smallest, volmesh::volume(mesh, c));
        CHECK(smallest > 1e-3);
    }
}

TEST_CASE("faces that touch a little askew come into the plane of the largest, or of one that is square") {
    Eigen::Affine3d askew(Eigen::Translation3d(1, 1, 3.00002));
    askew.rotate(Eigen::AngleAxisd(1e-5, Vector3d::UnitX()));
    const Model model = union_of({box_at({0, 0, 0}, {2, 2, 3}), make_cube({4, 4, 1}, false, askew)});
    const Model result = aligned(model, tolerance);
    CHECK(result.primitives[0].shape == model.primitives[0].shape);
    const Shape& moved = *result.primitives[1].shape;
    constexpr std::uint32_t top = 5, bottom = 4;
    REQUIRE(model.primitives[0].shape->faces()[top].name == "z+");
    CHECK(farthest_from(moved, bottom, *result.primitives[0].shape, top) < 1e-15);
    CHECK(farthest_from(*model.primitives[1].shape, bottom, *result.primitives[0].shape, top) > 1e-5);
    // Its other planes are what they were.
    for (std::uint32_t f = 0; f < 6; ++f)
        if (f != bottom) CHECK(farthest_from(moved, f, *model.primitives[1].shape, f) < 1e-14);
}

TEST_CASE("what is flush already, far apart or further off than the tolerance stays to the bit") {
    const auto stays = [](const Model& model) {
        const Model result = aligned(model, tolerance);
        for (std::size_t i = 0; i < model.primitives.size(); ++i)
            if (result.primitives[i].shape != model.primitives[i].shape) return false;
        return true;
    };
    CHECK(stays(union_of({box_at({0, 0, 0}, {1, 1, 1}), box_at({1, 0, 0}, {1, 1, 1})})));
    CHECK(stays(union_of({box_at({0, 0, 0}, {1, 1, 1}), box_at({1, 0.3, 5}, {1, 1, 1.00001})})));
    CHECK(stays(union_of({box_at({0, 0, 0}, {1, 1, 1}), box_at({0.2, 0.2, 1.001}, {2, 2, 2})})));
    CHECK_FALSE(stays(union_of({box_at({0, 0, 0}, {1, 1, 1}), box_at({0.2, 0.2, 1.00001}, {2, 2, 2})})));
}

TEST_CASE("a film thinner than the tolerance is not pressed flat") {
    const Model model = union_of({box_at({0, 0, 0}, {1, 1, 1}), box_at({0, 0, 1}, {1, 1, 1e-5})});
    const Model result = aligned(model, tolerance);
    CHECK(result.primitives[1].shape == model.primitives[1].shape);
}

TEST_CASE("a polyhedron whose corners have more planes than fit stays as it is") {
    const auto pyramid = make_pyramid(5, 1, 1, Eigen::Affine3d(Eigen::Translation3d(0, 0, 1.00001)));
    const auto slab = [&] {
        // A large box behind one side of the pyramid, askew by less than the tolerance.
        const Vector3d normal = pyramid->face_normal(0, {0, 0, 0});
        Eigen::Affine3d frame(Eigen::Translation3d(pyramid->project(0, {0, 0, 1.5}) + 2e-5 * normal));
        frame.rotate(Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), normal));
        frame.translate(Vector3d(-5, -5, 0));
        return make_cube({10, 10, 1}, false, frame);
    }();
    const Model model = union_of({slab, pyramid});
    CHECK(aligned(model, tolerance).primitives[1].shape == pyramid);
    // On its base it can be moved.
    const Model standing = union_of({box_at({-5, -5, 0}, {10, 10, 1}), pyramid});
    CHECK(aligned(standing, tolerance).primitives[1].shape != pyramid);
}
