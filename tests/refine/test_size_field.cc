#include <cmath>
#include <random>
#include <thread>

#include <doctest/doctest.h>

#include "meshes.hh"
#include "refine/size_field.hh"
#include "tests/support/messages.hh"
#include "volmesh/error.hh"

using maille::InputError;
using maille::volmesh::VertexHandle;
using namespace maille::refine;
using maille::test::has;
using maille::test::message;

TEST_CASE("a constant size is positive and finite") {
    CHECK(SizeField(0.25)(Point(1, 2, 3)) == 0.25);
    for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) CHECK_THROWS_AS(SizeField{bad}, InputError);
}

TEST_CASE("an expression is a function of x, y, z and r") {
    CHECK(parse_size("0.5")(Point(9, 9, 9)) == 0.5);
    CHECK(parse_size("1 + x + 10*y + 100*z")(Point(1, 2, 3)) == 322);
    CHECK(parse_size("r")(Point(2, 3, 6)) == 7);
    CHECK(parse_size("0.02+0.2*(1-exp(-r/0.3))")(Point(0, 0, 0.3)) ==
          doctest::Approx(0.02 + 0.2 * (1 - std::exp(-1))));
    CHECK(parse_size("x < 1 ? 0.1 : pi")(Point(2, 0, 0)) == doctest::Approx(3.14159265358979));
    CHECK(parse_size("min(x, 2, y^2)")(Point(5, 1.2, 0)) == doctest::Approx(1.44));
}

TEST_CASE("what cannot be read is said in plain words, with the place") {
    const std::pair<const char*, const char*> cases[] = {
        {"0.02+*3", "unexpected operator \"*\" at character 6"},
        {"0.1m", "unexpected token \"m\" at character 4"},
        {"foo+1", "unexpected token \"foo\" at character 1"},
        {"(1+x", "missing parenthesis"},
        {"", "expression is empty"},
        {"0,5", "separated by commas"},
        {"1+x=3", "unexpected \"=\" at character 4"},
        {"exp(1,2)", "too many parameters for function \"exp\""},
        {"2x", "unexpected variable \"x\" at character 2"},
    };
    for (const auto& [expression, words] : cases) {
        const std::string text = message([e = expression] { parse_size(e); });
        CAPTURE(text);
        CHECK(has(text, words));
        CHECK(has(text, std::string("\"") + expression + "\""));
    }
    CHECK_NOTHROW(parse_size("x<=1 ? 1 : (y==2 ? 3 : (z>=1 ? 4 : (x!=2 ? 5 : 6)))"));
}

TEST_CASE("a size that is not positive names the place") {
    const SizeField size = parse_size("x-1");
    CHECK(size(Point(3, 0, 0)) == 2);
    const std::string text = message([&] { size(Point(0.5, 7, 8)); });
    CHECK(has(text, "(0.5, 7, 8)"));
    CHECK(has(text, "-0.5"));
    CHECK_THROWS_AS(parse_size("1/x")(Point(0, 0, 0)), InputError);
    CHECK_THROWS_AS(parse_size("sqrt(x)")(Point(-1, 0, 0)), InputError);
}

TEST_CASE("the smallest of several sizes") {
    const SizeField size =
        minimum({SizeField(0.5), parse_size("x"), SizeField([](const Point& p) { return p.y(); })});
    CHECK(size(Point(1, 1, 0)) == 0.5);
    CHECK(size(Point(0.2, 1, 0)) == 0.2);
    CHECK(size(Point(0.2, 0.1, 0)) == 0.1);
    CHECK_THROWS_AS(size(Point(1, -1, 0)), InputError);
}

TEST_CASE("an expression may be asked from many threads at once") {
    const SizeField size = parse_size("1+x*y+z^2+r");
    std::vector<int> wrong(8);
    {
        std::vector<std::jthread> threads;
        for (int t = 0; t < 8; ++t)
            threads.emplace_back([&, t] {
                std::mt19937 random(t);
                std::uniform_real_distribution<double> u(0, 1);
                for (int i = 0; i < 20000; ++i) {
                    const Point p(u(random), u(random), u(random));
                    const double expected = 1 + p.x() * p.y() + p.z() * p.z() + p.norm();
                    wrong[t] += std::abs(size(p) - expected) > 1e-12;
                }
            });
    }
    for (const int n : wrong) CHECK(n == 0);
}

TEST_CASE("a vertex field of a mesh is linear in each cell") {
    auto mesh = test::random_cube(4, 7, 0.2).mesh();
    maille::volmesh::VPropHandleT<double> h;
    mesh.add_property(h, "h");
    const auto linear = [](const Point& p) { return 1 + 2 * p.x() + 3 * p.y() + 4 * p.z(); };
    for (const auto v : mesh.vertices()) mesh.property(h, VertexHandle(v)) = linear(v.point());
    const SizeField size = mesh_size(mesh, "h");
    std::mt19937 random(11);
    std::uniform_real_distribution<double> u(-0.5, 1.5);
    for (int i = 0; i < 2000; ++i) {
        const Point p(u(random), u(random), u(random));
        // Outside the cube the nearest point of it counts.
        const Point nearest = p.cwiseMax(Point::Zero()).cwiseMin(Point::Ones());
        CHECK(size(p) == doctest::Approx(linear(nearest)).epsilon(1e-10));
    }
}

TEST_CASE("a cell field of a mesh is constant in each cell") {
    auto mesh = test::random_cube(4, 8, 0.2).mesh();
    maille::volmesh::CPropHandleT<double> h;
    mesh.add_property(h, "h");
    for (const auto c : mesh.cells()) mesh.property(h, maille::volmesh::CellHandle(c)) = 1.0 + c.idx();
    const SizeField size = mesh_size(mesh, "h");
    for (const auto c : mesh.cells()) {
        const auto p = mesh.cell_points(c);
        CHECK(size(0.1 * p[0] + 0.2 * p[1] + 0.3 * p[2] + 0.4 * p[3]) == 1.0 + c.idx());
    }
}

TEST_CASE("a field that is not there, or no size, is refused") {
    auto mesh = test::kuhn_cube(1).mesh();
    CHECK(has(message([&] { mesh_size(mesh, "h"); }), "\"h\""));
    maille::volmesh::VPropHandleT<double> h;
    mesh.add_property(h, "h", {}, 1.0);
    CHECK_NOTHROW(mesh_size(mesh, "h"));
    mesh.property(h, VertexHandle(5)) = 0;
    const std::string text = message([&] { mesh_size(mesh, "h"); });
    CHECK(has(text, "vertex 5"));
    CHECK(has(text, "(1, 0, 1)"));
}

TEST_CASE("sizes of cells may be averaged at the vertices by volume") {
    auto mesh = test::random_cube(3, 9, 0.2).mesh();
    maille::volmesh::CPropHandleT<double> h;
    mesh.add_property(h, "h");
    for (const auto c : mesh.cells()) mesh.property(h, maille::volmesh::CellHandle(c)) = 1.0 + c.idx() % 7;
    const SizeField size = mesh_size(mesh, "h", CellValues::averaged);
    std::vector<double> at_vertex;
    for (const auto v : mesh.vertices()) {
        double sum = 0, total = 0;
        for (const auto c : v.cells()) {
            const auto p = mesh.cell_points(c);
            const double volume = (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
            sum += volume * mesh.property(h, c);
            total += volume;
        }
        at_vertex.push_back(sum / total);
        CHECK(size(v.point()) == doctest::Approx(sum / total).epsilon(1e-10));
    }
    for (const auto c : mesh.cells()) {
        double mean = 0;
        Point centroid = Point::Zero();
        for (const auto v : c.vertices()) {
            mean += at_vertex[v.idx()] / 4;
            centroid += mesh.point(v) / 4;
        }
        CHECK(size(centroid) == doctest::Approx(mean).epsilon(1e-10));
    }
    for (const auto c : mesh.cells()) mesh.property(h, maille::volmesh::CellHandle(c)) = 0.5;
    CHECK(mesh_size(mesh, "h", CellValues::averaged)(Point(0.3, 0.4, 0.5)) == doctest::Approx(0.5));
}
