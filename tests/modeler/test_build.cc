#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <numbers>
#include <random>
#include <set>
#include <string>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "modeler/build.hh"
#include "modeler/shapes.hh"
#include "volmesh/error.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

namespace {

using namespace maille;
using namespace maille::modeler;
using Eigen::Vector3d;
using volmesh::EntityKind;
using volmesh::TetMesh;

CsgTree leaf(std::uint32_t i) {
    return {Operation::leaf, i, {}};
}
CsgTree pair_of(Operation operation) {
    return {operation, 0, {leaf(0), leaf(1)}};
}

Primitive box(const std::string& name, const Vector3d& low, const Vector3d& high,
              const std::string& material = "") {
    return {make_cube(high - low, false, Eigen::Affine3d(Eigen::Translation3d(low))), name, material, 0};
}

Primitive ball(const std::string& name, const Vector3d& center, double radius) {
    return {make_sphere(radius, Eigen::Affine3d(Eigen::Translation3d(center))), name, "", 0};
}

/// Builds it and checks what holds for every mesh.
TetMesh built(const Model& model, double size, BuildReport* report = nullptr) {
    BuildReport told;
    TetMesh mesh = build(model, {.size = size}, &told);
    for (const std::string& warning : told.warnings) MESSAGE(warning);
    const auto validation = volmesh::validate(mesh);
    for (const std::string& error : validation.errors) MESSAGE(error);
    CHECK(validation.ok());
    CHECK(told.kept_cells + told.new_cells == mesh.n_cells());
    if (report != nullptr) *report = told;
    return mesh;
}

double measure_of(const TetMesh& mesh, const std::string& name, EntityKind kind) {
    const auto set = mesh.find_set(name, kind);
    return set.is_valid() ? volmesh::measure(mesh, set) : 0;
}
double area_of(const TetMesh& mesh, const std::string& name) {
    return measure_of(mesh, name, EntityKind::face);
}
double volume_of(const TetMesh& mesh, const std::string& name) {
    return measure_of(mesh, name, EntityKind::cell);
}

double volume_or_nothing(const Model& model, double size) {
    try {
        return volmesh::volume(built(model, size));
    } catch (const InputError& error) {
        if (std::string(error.what()).find("empty") == std::string::npos) throw;
        return 0;
    }
}

doctest::Approx exactly(double value) {
    return doctest::Approx(value).epsilon(1e-9);
}

TEST_CASE("one box keeps its mesh, with its sides named") {
    BuildReport report;
    const TetMesh mesh = built({{box("plate", {0, 0, 0}, {1, 2, 3}, "steel")}, leaf(0)}, 0.4, &report);
    CHECK(report.new_cells == 0);
    CHECK(report.warnings.empty());
    CHECK(volmesh::volume(mesh) == exactly(6));
    CHECK(volume_of(mesh, "plate") == exactly(6));
    CHECK(volume_of(mesh, "steel") == exactly(6));
    for (const auto& [side, area] :
         {std::pair{"x-", 6.0}, {"x+", 6.0}, {"y-", 3.0}, {"y+", 3.0}, {"z-", 2.0}, {"z+", 2.0}})
        CHECK(area_of(mesh, std::string("plate/") + side) == exactly(area));
}

TEST_CASE("boxes that overlap") {
    const std::vector<Primitive> boxes{box("a", {0, 0, 0}, {1, 1, 1}),
                                       box("b", {0.35, 0.45, 0.55}, {1.3, 1.4, 1.5})};
    const double both = 0.65 * 0.55 * 0.45, second = 0.95 * 0.95 * 0.95;
    SUBCASE("union") {
        BuildReport report;
        const TetMesh mesh = built({boxes, pair_of(Operation::join)}, 0.1, &report);
        CHECK(volmesh::volume(mesh) == exactly(1 + second - both));
        CHECK(volume_of(mesh, "a") == exactly(1));
        CHECK(area_of(mesh, "a/x+") == exactly(1 - 0.55 * 0.45));
        CHECK(area_of(mesh, "a/x+/inner") == exactly(0.55 * 0.45));
        CHECK(report.kept_cells > report.new_cells);
    }
    SUBCASE("intersection") {
        const TetMesh mesh = built({boxes, pair_of(Operation::intersection)}, 0.1);
        CHECK(volmesh::volume(mesh) == exactly(both));
        CHECK(area_of(mesh, "b/x-") == exactly(0.55 * 0.45));
    }
    SUBCASE("difference") {
        BuildReport report;
        const TetMesh mesh = built({boxes, pair_of(Operation::difference)}, 0.1, &report);
        CHECK(volmesh::volume(mesh) == exactly(1 - both));
        CHECK(area_of(mesh, "b/x-") == exactly(0.55 * 0.45));
        CHECK(area_of(mesh, "a/x-") == exactly(1));
        CHECK(report.kept_cells > report.new_cells);
    }
    SUBCASE("fragment") {
        const TetMesh mesh = built({boxes, pair_of(Operation::fragment)}, 0.1);
        CHECK(volume_of(mesh, "a") == exactly(1));
        CHECK(volume_of(mesh, "b") == exactly(second - both));
    }
}

TEST_CASE("boxes in special positions") {
    const auto volume = [](const Primitive& a, const Primitive& b, Operation operation) {
        return volume_or_nothing({{a, b}, pair_of(operation)}, 0.3);
    };
    const Primitive unit = box("a", {0, 0, 0}, {1, 1, 1});
    SUBCASE("coplanar sides") {
        const Primitive other = box("b", {0.5, 0, 0}, {1.5, 1, 0.5});
        CHECK(volume(unit, other, Operation::join) == exactly(1.25));
        CHECK(volume(unit, other, Operation::intersection) == exactly(0.25));
        CHECK(volume(unit, other, Operation::difference) == exactly(0.75));
    }
    SUBCASE("touching in a side, an edge, a corner") {
        for (const Vector3d& low :
             {Vector3d(1, 0, 0), Vector3d(1, 1, 0), Vector3d(1, 1, 1), Vector3d(1, 0.3, 0.4)}) {
            const Primitive other = box("b", low, low + Vector3d::Ones());
            CHECK(volume(unit, other, Operation::join) == exactly(2));
            CHECK(volume(unit, other, Operation::intersection) == 0);
            CHECK(volume(unit, other, Operation::difference) == exactly(1));
        }
    }
    SUBCASE("nested") {
        const Primitive other = box("b", {0.3, 0.3, 0.3}, {0.6, 0.6, 0.6});
        CHECK(volume(unit, other, Operation::join) == exactly(1));
        CHECK(volume(unit, other, Operation::difference) == exactly(1 - 0.027));
        CHECK(volume(other, unit, Operation::difference) == 0);
        CHECK(volume(other, unit, Operation::fragment) == exactly(1));
    }
    SUBCASE("identical") {
        const Primitive other = box("b", {0, 0, 0}, {1, 1, 1});
        CHECK(volume(unit, other, Operation::join) == exactly(1));
        CHECK(volume(unit, other, Operation::intersection) == exactly(1));
        CHECK(volume(unit, other, Operation::difference) == 0);
    }
    SUBCASE("apart") {
        const Primitive other = box("b", {3, 0, 0}, {4, 1, 1});
        BuildReport report;
        CHECK(volmesh::volume(built({{unit, other}, pair_of(Operation::join)}, 0.3, &report)) == exactly(2));
        CHECK(report.new_cells == 0);
        CHECK(volume(unit, other, Operation::intersection) == 0);
    }
}

TEST_CASE("polyhedra in random positions obey the laws of sets") {
    const unsigned seed = 20;
    MESSAGE("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < 20; ++i) {
        CAPTURE(i);
        Eigen::Affine3d frame(Eigen::Translation3d(unit(random), unit(random), unit(random)));
        frame.rotate(
            Eigen::AngleAxisd(3 * unit(random), Vector3d(unit(random), unit(random), 1).normalized()));
        const Primitive a = box("a", {0, 0, 0}, {1, 1, 1});
        const std::array<std::shared_ptr<const Shape>, 3> shapes{make_cube({0.8, 0.9, 1.1}, true, frame),
                                                                 make_prism(5, 0.6, 1, frame),
                                                                 make_pyramid(6, 0.7, 1, frame)};
        const Primitive b{shapes[static_cast<std::size_t>(i) % 3], "b", "", 0};
        const auto volume = [&](const CsgTree& tree) { return volume_or_nothing({{a, b}, tree}, 0.5); };
        const double both = volume(pair_of(Operation::intersection));
        CHECK(volume(pair_of(Operation::join)) + both == exactly(volume(leaf(0)) + volume(leaf(1))));
        CHECK(volume(pair_of(Operation::difference)) == exactly(volume(leaf(0)) - both));
        const TetMesh fragments = built({{a, b}, pair_of(Operation::fragment)}, 0.5);
        CHECK(volume_of(fragments, "a") == exactly(1));
        CHECK(volume_of(fragments, "b") == exactly(volume(leaf(1)) - both));
    }
}

TEST_CASE("areas of curved and flat faces come near the true ones, at second order") {
    const auto drilled = [](double size) {
        return built(
            {{box("plate", {-1, -1, 0}, {1, 1, 0.6}), {make_cylinder(2, 0.5, 0.5, true), "hole", "", 0}},
             pair_of(Operation::difference)},
            size);
    };
    const double side = std::numbers::pi * 0.6, top = 4 - std::numbers::pi / 4;
    const TetMesh coarse = drilled(0.2), fine = drilled(0.1);
    CHECK(area_of(coarse, "hole/side") == doctest::Approx(side).epsilon(0.03));
    CHECK(area_of(fine, "hole/side") == doctest::Approx(side).epsilon(0.01));
    CHECK(area_of(coarse, "plate/x+") == exactly(1.2));
    CHECK(area_of(fine, "plate/z+") == doctest::Approx(top).epsilon(0.01));
    CHECK(std::abs(area_of(fine, "hole/side") - side) < 0.5 * std::abs(area_of(coarse, "hole/side") - side));
    for (const auto& [face, radius] : {std::pair{"hole/side", 0.5}}) {
        double farthest = 0;
        for (const auto hf : fine.face_members(fine.find_set(face, EntityKind::face)))
            for (const auto v : fine.halfface_vertices(hf))
                farthest = std::max(farthest, std::abs(fine.point(v).head<2>().norm() - radius));
        CHECK(farthest < 1e-9);
    }
}

TEST_CASE("kept cells are the primitive's own, bit by bit") {
    const Primitive a = box("a", {0, 0, 0}, {1, 1, 1});
    const TetMesh alone = built({{a}, leaf(0)}, 0.1);
    BuildReport report;
    const TetMesh mesh =
        built({{a, ball("b", {1, 1, 1}, 0.4)}, pair_of(Operation::difference)}, 0.1, &report);
    CHECK(report.kept_cells > mesh.n_cells() / 2);
    const auto corners = [](const TetMesh& of, volmesh::CellHandle c) {
        std::array<std::array<double, 3>, 4> points{};
        for (int k = 0; k < 4; ++k)
            for (int d = 0; d < 3; ++d) points[k][d] = of.point(of.cell_vertex(c, k))[d];
        return points;
    };
    std::set<std::array<std::array<double, 3>, 4>> before;
    for (const volmesh::CellHandle c : alone.cells()) before.insert(corners(alone, c));
    std::size_t same = 0;
    for (const volmesh::CellHandle c : mesh.cells()) same += before.count(corners(mesh, c));
    CHECK(same >= report.kept_cells);
}

TEST_CASE("solids far larger than the model cost no more than others") {
    constexpr double radius = 1000, size = 0.4, side = 4;
    const Primitive cube = box("cube", {-2, -2, -2}, {2, 2, 2});
    const Primitive left = ball("left", {-radius, 0, 0}, radius),
                    right = ball("right", {radius, 0, 0}, radius);
    // What the ball has of the cube is side / 2 - depth thick, depth = radius - sqrt(radius^2 - y^2 - z^2).
    const auto [depth, n] = [] {
        double sum = 0;
        constexpr int steps = 400;
        for (int i = 0; i < steps; ++i)
            for (int j = 0; j < steps; ++j) {
                const double y = side * (i + 0.5) / steps - side / 2, z = side * (j + 0.5) / steps - side / 2;
                sum += radius - std::sqrt(radius * radius - y * y - z * z);
            }
        return std::pair(sum, steps * steps);
    }();
    const double common = side * side * (side / 2 - depth / n);
    const double chord = std::pow(1.5 * size, 2) / (8 * radius) * side * side;
    REQUIRE(chord < side * side * depth / n);  // it is told from a plane
    const auto check = [&](const std::vector<Primitive>& primitives, const CsgTree& tree, double volume,
                           double tolerance) {
        const TetMesh mesh = built({primitives, tree}, size);
        CHECK(std::abs(volmesh::volume(mesh) - volume) < tolerance);
        CHECK(mesh.n_cells() > 500);
        CHECK(mesh.n_cells() < 30000);
        CHECK(area_of(mesh, "left/surface") == doctest::Approx(side * side).epsilon(1e-4));
    };
    check({left, cube}, pair_of(Operation::intersection), common, chord);
    check({cube, left}, pair_of(Operation::intersection), common, chord);
    check({cube, left}, pair_of(Operation::difference), side * side * side - common, chord);
    // Both balls, one a copy of the other, less a gap between them.
    const CsgTree both{Operation::join, 0, {leaf(0), leaf(1)}};
    check({left, right, cube}, {Operation::intersection, 0, {both, leaf(2)}}, 2 * common, 2 * chord);
}

TEST_CASE("a deep tree") {
    Model model;
    model.tree = leaf(0);
    model.primitives.push_back(box("block", {0, 0, 0}, {10, 1, 1}));
    for (std::uint32_t i = 1; i < 10; ++i) {
        const double x = i;
        model.primitives.push_back(box("cut" + std::to_string(i), {x - 0.2, -1, 0.5}, {x + 0.2, 2, 2}));
        model.tree = {Operation::difference, 0, {model.tree, leaf(i)}};
    }
    const TetMesh mesh = built(model, 0.4);
    CHECK(volmesh::volume(mesh) == exactly(10 - 9 * 0.4 * 0.5));
}

TEST_CASE("where two surfaces touch and their curves cross there is a vertex") {
    const auto pipe = [](const char* name, const Eigen::Vector3d& axis) {
        const Eigen::Affine3d map(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis));
        return Primitive{make_cylinder(3, 1, 1, true, map), name, "", 0};
    };
    const Model model{{pipe("a", {0, 0, 1}), pipe("b", {1, 0, 0})}, pair_of(Operation::intersection)};
    for (const double size : {0.4, 0.25}) {
        CAPTURE(size);
        const TetMesh mesh = build(model, {.size = size});
        for (const Eigen::Vector3d& touch : {Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 0)})
            CHECK(std::ranges::any_of(mesh.points(),
                                      [&](const auto& p) { return (p - touch).norm() < 1e-11; }));
    }
}

TEST_CASE("everything can be meshed anew") {
    BuildReport report;
    const Model model{{box("a", {0, 0, 0}, {1, 1, 1}), ball("b", {1, 1, 1}, 0.5)},
                      pair_of(Operation::fragment)};
    const TetMesh mesh = build(model, {.size = 0.2, .keep_cells = false}, &report);
    CHECK(volmesh::validate(mesh).ok());
    CHECK(report.kept_cells == 0);
    CHECK(volume_of(mesh, "a") == exactly(1));
    CHECK(volume_of(mesh, "a") + volume_of(mesh, "b") == exactly(volmesh::volume(mesh)));
}

TEST_CASE("the mesh does not depend on the number of threads") {
    const Model model{{box("a", {0, 0, 0}, {1, 1, 1}), ball("b", {1, 1, 1}, 0.5), ball("c", {0, 0, 0}, 0.4)},
                      {Operation::join, 0, {leaf(0), leaf(1), leaf(2)}}};
    const TetMesh one = build(model, {.size = 0.2, .threads = 1}),
                  two = build(model, {.size = 0.2, .threads = 2});
    CHECK(std::ranges::equal(one.points(), two.points()));
    CHECK(std::ranges::equal(one.cell_vertex_indices(), two.cell_vertex_indices()));
}

TEST_CASE("what cannot be built is told") {
    const auto message_of = [](const std::function<void()>& action) -> std::string {
        try {
            action();
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    const Model model{{box("cube1", {0, 0, 0}, {1, 1, 1})}, leaf(0)};
    CHECK(message_of([] { build(Model{}); }).find("the model is empty") != std::string::npos);
    CHECK(message_of([&] { build(model, {.size = -1}); }).find("size") != std::string::npos);
    setenv("MAILLE_TETGEN", "/bin/false", 1);
    const std::string told = message_of([&] { build(model, {.size = 0.5}); });
    unsetenv("MAILLE_TETGEN");
    CHECK(told.find("cube1") != std::string::npos);
    CHECK(told.find("status 1") != std::string::npos);
}

}  // namespace

TEST_CASE("a polyhedron that overlaps itself is what it winds around") {
    // A bar of width and height 1 that is bent three times and then leads through its own beginning.
    const std::vector<Eigen::Vector2d> left{{0, 0.5}, {3.5, 0.5}, {3.5, 3.5}, {1.5, 3.5}, {1.5, -3}};
    const std::vector<Eigen::Vector2d> right{{0, -0.5}, {4.5, -0.5}, {4.5, 4.5}, {0.5, 4.5}, {0.5, -3}};
    std::vector<Vector3d> points;
    for (std::size_t i = 0; i < left.size(); ++i)
        for (const auto& p : {left[i], right[i]})
            for (const double z : {0.0, 1.0}) points.emplace_back(p.x(), p.y(), z);
    // Of each place: left below, left above, right below, right above.
    std::vector<std::vector<std::uint32_t>> faces{{0, 2, 3, 1}, {16, 17, 19, 18}};
    for (std::uint32_t i = 0; i < 16; i += 4) {
        faces.push_back({i + 1, i + 3, i + 7, i + 5});
        faces.push_back({i, i + 4, i + 6, i + 2});
        faces.push_back({i, i + 1, i + 5, i + 4});
        faces.push_back({i + 2, i + 6, i + 7, i + 3});
    }
    std::vector<std::string> names;
    for (std::size_t i = 0; i < faces.size(); ++i) names.push_back("face" + std::to_string(i));
    const Primitive bar{make_polyhedron(points, faces, names), "bar", "", 0};
    BuildReport report;
    CHECK(volmesh::volume(built({{bar}, leaf(0)}, 0.5, &report)) == exactly(17));
    CHECK(report.warnings.empty());
    const Primitive block = box("block", {-1, -4, -1}, {6, 5, 2});
    CHECK(volmesh::volume(built({{block, bar}, pair_of(Operation::difference)}, 0.7)) ==
          exactly(7 * 9 * 3 - 17));
    CHECK(volmesh::volume(built({{bar, block}, pair_of(Operation::intersection)}, 0.7)) == exactly(17));
    const TetMesh parts = built({{bar, block}, pair_of(Operation::fragment)}, 0.7);
    CHECK(volume_of(parts, "bar") == exactly(17));
    CHECK(volume_of(parts, "block") == exactly(7 * 9 * 3 - 17));
}

TEST_CASE("faces that coincide do so to the last corner, also where that lies on another face") {
    // The cylinder's end goes through the corner in which three faces of one box lie on three of the other.
    const TetMesh mesh =
        built(parse_model("multmatrix([[0.92388, -0.190155, -0.332096, 0], [0, -0.867809, 0.496898, 0], "
                          "[-0.382683, -0.459074, -0.801751, 0], [0, 0, 0, 1]]) "
                          "cylinder(h = 6, r = 3.3); "
                          "multmatrix([[0.835807, 0.0953368, 0.540682, 0], [0, 0.984808, -0.173648, 0], "
                          "[-0.549023, 0.145136, 0.82311, 0], [0, 0, 0, 1]]) "
                          "{ cube([4, 9, 6]); cube([6, 2, 6]); }",
                          "part.csg", Facets::round),
              0.8);
    double flattest = 1;
    for (const auto c : mesh.cells()) {
        double longest = 0;
        for (const Vector3d& p : mesh.cell_points(c))
            for (const Vector3d& q : mesh.cell_points(c)) longest = std::max(longest, (p - q).norm());
        flattest = std::min(flattest, volmesh::volume(mesh, c) / std::pow(longest, 3));
    }
    CHECK(flattest > 1e-9);
}

TEST_CASE("a polyhedron may touch itself in a point") {
    const auto check = [](const std::string& text, double volume, double area) {
        CAPTURE(text);
        const TetMesh mesh = built(parse_model(text, "part.csg", Facets::keep), 0.5);
        CHECK(volmesh::volume(mesh) == exactly(volume));
        double found = 0;
        for (const auto f : mesh.boundary_faces()) found += volmesh::area(mesh, mesh.halfface_handle(f, 0));
        CHECK(found == exactly(area));
    };
    // Two tetrahedra, tip to tip.
    const std::string hourglass =
        "polyhedron(points = [[0, 0, 0], [1, 0, 1], [0, 1, 1], [0, 0, 1], [1, 0, -1], [0, 1, -1], [0, 0, "
        "-1]], "
        "faces = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2], [0, 5, 4], [0, 6, 5], [0, 4, 6], [4, 5, 6]]);";
    const double sides = 0.5 + 0.5 + 0.5 + std::sqrt(3) / 2;
    check(hourglass, 1.0 / 3, 2 * sides);
    check("difference() { " + hourglass + " translate([-1, -1, 0]) cube(3); }", 1.0 / 6, sides);
    // A disc with a dent that is as deep as it is thick.
    constexpr int n = 12;
    const double flat = n / 2.0 * 4 * std::sin(2 * std::numbers::pi / n);
    const double edge = 4 * std::sin(std::numbers::pi / n), middle = 2 * std::cos(std::numbers::pi / n);
    check("rotate_extrude($fn = 12) polygon([[0, 0], [2, 0], [2, 1]]);", flat * 2 / 3,
          flat + n * edge + n * edge * std::hypot(middle, 1) / 2);
    BuildReport report;
    const TetMesh disc =
        built(parse_model("rotate_extrude() polygon([[1, 0], [2, 0], [0, 1]]);", "part.csg", Facets::round),
              0.2, &report);
    CHECK(report.warnings.empty());
    CHECK(volmesh::volume(disc) == doctest::Approx(std::numbers::pi).epsilon(0.02));
}

TEST_CASE("no edge is much longer than the size, whatever triangles the surfaces come with") {
    const Model model = read_model(MAILLE_SOURCE_DIR "/examples/bracket.csg");
    for (const double size : {4.0, 5.0, 6.0}) {
        CAPTURE(size);
        const TetMesh mesh = built(model, size);
        double longest = 0;
        for (const auto e : mesh.edges()) {
            const auto [a, b] = mesh.edge_vertices(e);
            longest = std::max(longest, (mesh.point(a) - mesh.point(b)).norm());
        }
        CHECK(longest < 2 * size);
    }
}
