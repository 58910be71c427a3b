#include <cmath>
#include <numbers>
#include <random>

#include <doctest/doctest.h>

#include "meshes.hh"
#include "refine/refine.hh"
#include "refine/simplex_tree.hh"
#include "refine/size_field.hh"
#include "tests/support/messages.hh"
#include "volmesh/error.hh"
#include "volmesh/validate.hh"

// Sizes that depend on a mesh's sets, on its model's surfaces and on its vertices.

using maille::InputError;
using namespace maille::refine;
using maille::test::has;
using maille::test::message;
using maille::volmesh::EdgeHandle;
using maille::volmesh::EntityKind;
using maille::volmesh::FaceHandle;
using maille::volmesh::Projector;

namespace {

class RandomPoints {
  public:
    explicit RandomPoints(unsigned seed) : engine_(seed) {}
    Point operator()(double low, double high) {
        std::uniform_real_distribution<double> u(low, high);
        return {u(engine_), u(engine_), u(engine_)};
    }

  private:
    std::mt19937 engine_;
};

/// The unit cube with a face set, an edge set, a vertex set and a cell set whose places are known.
test::TetMesh cube_with_sets() {
    test::TetMesh mesh = test::kuhn_cube(4).mesh();
    const auto wall = mesh.add_set("wall", EntityKind::face);
    for (const auto f : mesh.faces())
        if (std::ranges::all_of(f.vertices(), [&](auto v) { return mesh.point(v).x() == 0; }))
            mesh.insert(wall, FaceHandle(f));
    const auto post = mesh.add_set("post", EntityKind::edge);
    for (const auto e : mesh.edges())
        if (std::ranges::all_of(e.vertices(),
                                [&](VertexHandle v) { return mesh.point(v).head<2>().norm() == 0; }))
            mesh.insert(post, EdgeHandle(e));
    const auto corner = mesh.add_set("corner", EntityKind::vertex);
    for (const auto v : mesh.vertices())
        if (v.point() == Point::Ones()) mesh.insert(corner, VertexHandle(v));
    const auto half = mesh.add_set("half", EntityKind::cell);
    for (const auto c : mesh.cells())
        if (std::ranges::all_of(c.vertices(), [&](auto v) { return mesh.point(v).z() <= 0.5; }))
            mesh.insert(half, CellHandle(c));
    mesh.add_set("nothing", EntityKind::face);
    return mesh;
}

/// A box [-1,1]^2 x [-1,1] whose side faces are pulled onto a cylinder of radius 1.
test::TetMesh cylinder(int n) {
    test::Soup soup = test::kuhn_cube(n);
    for (Point& p : soup.points) {
        p = 2 * p - Point::Ones();
        const double r = std::hypot(p.x(), p.y());
        if (r > 0) p.head<2>() *= p.head<2>().cwiseAbs().maxCoeff() / r;
    }
    for (auto& t : soup.tets) test::orient(soup.points, t);
    test::TetMesh mesh = soup.mesh();
    const auto side = mesh.add_set("c/side", EntityKind::face);
    const auto top = mesh.add_set("c/top", EntityKind::face);
    for (const auto hf : mesh.boundary_halffaces()) {
        double lowest = 1;
        for (const auto v : hf.vertices()) lowest = std::min(lowest, std::abs(mesh.point(v).z()));
        mesh.insert(lowest == 1 ? top : side, maille::volmesh::HalffaceHandle(hf));
    }
    return mesh;
}

Projector cylinder_surfaces() {
    return {{"c/side", "c/top"},
            [](std::span<const std::uint32_t>, const Point& p) { return p; },
            std::sqrt(12.0),
            [](std::uint32_t surface, const Point& p) {
                return surface == 0 ? 1 / std::hypot(p.x(), p.y()) : 0;
            }};
}

double step(const Point& p) {
    return p.x() < 0.3 ? 0.05 : 1;
}

}  // namespace

TEST_CASE("the distance to a set is the geometric one, whatever the set is of") {
    const auto mesh = cube_with_sets();
    const auto wall = set_distance(mesh, "wall"), post = set_distance(mesh, "post"),
               corner = set_distance(mesh, "corner"), half = set_distance(mesh, "half");
    RandomPoints points(3);
    for (int i = 0; i < 2000; ++i) {
        const Point p = points(-1, 2);
        const Point in_cube = p.cwiseMax(Point::Zero()).cwiseMin(Point::Ones());
        const Point on_wall(0, in_cube.y(), in_cube.z()), on_post(0, 0, in_cube.z());
        const Point in_half(in_cube.x(), in_cube.y(), std::min(in_cube.z(), 0.5));
        CHECK(wall(p) == doctest::Approx((p - on_wall).norm()).epsilon(1e-12));
        CHECK(post(p) == doctest::Approx((p - on_post).norm()).epsilon(1e-12));
        CHECK(corner(p) == doctest::Approx((p - Point::Ones()).norm()).epsilon(1e-12));
        CHECK(half(p) == doctest::Approx((p - in_half).norm()).epsilon(1e-12));
    }
}

TEST_CASE("the distance to a scattered set is that to its nearest member") {
    auto mesh = test::random_cube(4, 21, 0.3).mesh();
    const auto faces = mesh.add_set("scattered", EntityKind::face);
    const auto vertices = mesh.add_set("scattered", EntityKind::vertex);
    std::vector<Simplex> members;
    for (const auto f : mesh.faces())
        if (f.idx() % 17 == 0) {
            mesh.insert(faces, FaceHandle(f));
            const auto [a, b, c] = mesh.face_vertices(f);
            members.push_back({{mesh.point(a), mesh.point(b), mesh.point(c)}, 3});
        }
    for (const auto v : mesh.vertices())
        if (v.idx() % 13 == 0) {
            mesh.insert(vertices, VertexHandle(v));
            members.push_back({{v.point()}, 1});
        }
    const auto distance = set_distance(mesh, "scattered");
    RandomPoints points(4);
    for (int i = 0; i < 1000; ++i) {
        const Point p = points(-0.5, 1.5);
        double least = 1e300;
        for (const Simplex& member : members) least = std::min(least, nearest_on(member, p).squared_distance);
        CHECK(distance(p) == std::sqrt(least));
    }
}

TEST_CASE("d('set') in an expression is the distance to the set") {
    const auto mesh = cube_with_sets();
    const SizeContext context{&mesh, nullptr};
    const SizeField size = parse_size("min(1, 0.1+0.3*d('wall')) + 0*d ( \"post\" )", context);
    const SizeField ratio = parse_size("1 + d('post')/d('corner')", context);
    RandomPoints points(5);
    for (int i = 0; i < 200; ++i) {
        const Point p = points(0, 1);
        CHECK(size(p) == doctest::Approx(0.1 + 0.3 * p.x()));
        CHECK(ratio(p) == doctest::Approx(1 + p.head<2>().norm() / (p - Point::Ones()).norm()));
    }
    CHECK_THROWS_AS(parse_size("d('corner')", context)(Point::Ones()), InputError);
}

TEST_CASE("sets that are not there, and calls that can't be read, are said in plain words") {
    const auto mesh = cube_with_sets();
    const SizeContext context{&mesh, nullptr};
    const auto says = [&](const char* expression) {
        return message([&] { parse_size(expression, context); });
    };
    CHECK(has(says("d('wal')"), "no set named \"wal\""));
    CHECK(has(says("d('wal')"), "corner, half, nothing, post, wall"));
    CHECK(has(says("d('nothing')"), "\"nothing\": it is empty"));
    CHECK(has(says("1+d(wall)"), "in quotes, such as d('hole/side') at character 5"));
    CHECK(has(says("1+d('wall'"), "d lacks its \")\" at character 11"));
    CHECK(has(says("1+d('wall)"), "in quotes"));
    CHECK(has(says("2d('wall')"), "unexpected"));
    CHECK(has(says("d('wall')*/2"), "at character 11"));
    CHECK(has(says("curvature(2)"), "at least 3"));
    CHECK(has(says("curvature(x)"), "at least 3"));
    CHECK(has(says("curvature(20)"), "there is no model"));
    CHECK(has(message([] { parse_size("d('wall')"); }), "there is none here yet"));
    CHECK_NOTHROW(check_size("min(d('any'), curvature(20))"));
    CHECK_THROWS_AS(check_size("min(d('any'), curvature(20)"), InputError);
}

TEST_CASE("the curvature gives a circle so many edges, and lets go with the distance") {
    const auto mesh = cylinder(6);
    const Projector surfaces = cylinder_surfaces();
    std::vector<Simplex> side;
    for (const auto hf : mesh.face_members(mesh.find_set("c/side", EntityKind::face))) {
        const auto [a, b, c] = mesh.halfface_vertices(hf);
        side.push_back({{mesh.point(a), mesh.point(b), mesh.point(c)}, 3});
    }
    const auto size = curvature_size(mesh, surfaces, 20);
    const SizeField read = parse_size("curvature(20)", {&mesh, &surfaces});
    for (const Simplex& face : side)
        CHECK(size(face.corners[0]) == doctest::Approx(2 * std::sin(std::numbers::pi / 20)).epsilon(1e-9));
    RandomPoints points(6);
    for (int i = 0; i < 300; ++i) {
        const Point p = points(-1, 1);
        NearestOnSimplex nearest;
        double radius = 0;
        for (const Simplex& face : side)
            if (const auto found = nearest_on(face, p); found.squared_distance < nearest.squared_distance) {
                nearest = found;
                radius = nearest.of(face).head<2>().norm();
            }
        const double expected =
            2 * radius * std::sin(std::numbers::pi / 20) + std::sqrt(nearest.squared_distance);
        CHECK(size(p) == doctest::Approx(expected).epsilon(1e-9));
        CHECK(read(p) == size(p));
    }
    const auto flat = test::kuhn_cube(2).mesh();
    CHECK(curvature_size(flat, surfaces, 20)(Point::Zero()) == surfaces.model_size);
    Projector silent = surfaces;
    silent.curvature = {};
    CHECK_THROWS_AS(curvature_size(mesh, silent, 20), InputError);
}

TEST_CASE("a size of limited growth is the least over all the mesh's vertices") {
    const auto mesh = test::random_cube(8, 31, 0.2).mesh();
    const SizeField size(step);
    for (const double growth : {0.1, 0.5, 2.0}) {
        const SizeField limited = limit_growth(size, mesh, growth);
        RandomPoints points(7);
        for (int i = 0; i < 500; ++i) {
            const Point p = points(0.3, 1);
            double least = step(p);
            for (const auto v : mesh.vertices())
                least = std::min(least, step(v.point()) + growth * (p - v.point()).norm());
            CHECK(limited(p) == doctest::Approx(least).epsilon(1e-12));
        }
        for (const auto e : mesh.edges()) {
            const auto [a, b] = mesh.edge_vertices(e);
            const double allowed = growth * (mesh.point(a) - mesh.point(b)).norm();
            CHECK(std::abs(limited(mesh.point(a)) - limited(mesh.point(b))) <= allowed * (1 + 1e-12));
        }
    }
}

TEST_CASE("what grows slowly enough stays as it is") {
    const auto mesh = test::random_cube(6, 32, 0.2).mesh();
    const SizeField gentle([](const Point& p) { return 0.1 + 0.29 * p.norm(); });
    const SizeField limited = limit_growth(gentle, mesh, 0.3);
    RandomPoints points(8);
    for (int i = 0; i < 500; ++i) {
        const Point p = points(-1, 2);
        CHECK(limited(p) == gentle(p));
    }
    for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL})
        CHECK_THROWS_AS(limit_growth(gentle, mesh, bad), InputError);
}

TEST_CASE("refinement with a gradation makes the transition soft") {
    const auto soup = test::kuhn_cube(3);
    const SizeField size(step);
    auto sharp = soup.mesh(), soft = soup.mesh();
    refine(sharp, size);
    const RefineResult result = refine(soft, size, {.gradation = 0.3});
    CHECK(result.ended);
    CHECK(maille::volmesh::validate(soft).ok());
    CHECK(result.lineage.cell_ancestors.size() == soft.n_cells());
    CHECK(soft.n_cells() > sharp.n_cells());
    // Each part of the fine side has a vertex within an edge of the size wanted there, 1.5 x 0.05.
    for (const auto c : soft.cells()) {
        const auto p = soft.cell_points(c);
        const Point centroid = 0.25 * (p[0] + p[1] + p[2] + p[3]);
        double longest = 0;
        for (const auto& [i, j] : maille::volmesh::tet::edge_vertices)
            longest = std::max(longest, (p[i] - p[j]).norm());
        const double from_fine_side = std::max(centroid.x() - 0.3, 0.0) + 2 * 0.075;
        CHECK(longest <= 1.5 * std::min(1.0, 0.05 + 0.3 * from_fine_side));
    }
    CHECK_THROWS_AS(refine(soft, size, {.gradation = -1}), InputError);
}
