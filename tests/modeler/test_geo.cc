#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include "modeler/build.hh"
#include "modeler/outline.hh"
#include "tests/modeler/language_checks.hh"
#include "volmesh/measure.hh"

using namespace maille;
using namespace maille::modeler;
using namespace maille::modeler::test;
using std::numbers::pi;
using volmesh::EntityKind;

namespace {

std::filesystem::path file(const std::string& name) {
    return std::filesystem::path(MAILLE_SOURCE_DIR "/tests/data/geo") / (name + ".geo");
}

double volume_of_set(const volmesh::TetMesh& mesh, const std::string& name) {
    const auto set = mesh.find_set(name, EntityKind::cell);
    REQUIRE(set.is_valid());
    double sum = 0;
    for (const auto c : mesh.cells())
        if (mesh.contains(set, c)) sum += volmesh::volume(mesh, c);
    return sum;
}

double area_of_set(const volmesh::TetMesh& mesh, const std::string& name) {
    const auto set = mesh.find_set(name, EntityKind::face);
    CAPTURE(name);
    REQUIRE(set.is_valid());
    double sum = 0;
    for (const auto f : mesh.faces())
        if (mesh.contains(set, f)) {
            std::vector<Point> p;
            for (const auto v : f.vertices()) p.push_back(mesh.point(v));
            sum += (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2;
        }
    return sum;
}

/// Meshes the model, and compares the volumes of its objects: to rounding where they are polyhedra, else as
/// facets of that height allow.
volmesh::TetMesh check_volumes(const std::string& name, double size, double chord,
                               const std::map<std::string, double>& expected, double tolerance) {
    CAPTURE(name);
    const Model model = read_model(file(name));
    const auto mesh = build(model, {.size = size, .chord_tolerance = chord});
    double all = 0;
    for (const auto& [object, volume] : expected) {
        CAPTURE(object);
        CHECK(volume_of_set(mesh, object) == doctest::Approx(volume).epsilon(tolerance));
        all += volume;
    }
    CHECK(volmesh::volume(mesh) == doctest::Approx(all).epsilon(tolerance));
    return mesh;
}

/// Of a .geo file with that text, without the place.
std::string geo_message(const std::string& text) {
    try {
        parse_geo_model("algebraic3d\n" + text, "part.geo");
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

Model geo_model(const std::string& text) {
    return parse_geo_model("algebraic3d " + text, "part.geo");
}

}  // namespace

TEST_CASE("geo: planes make a cube, its faces are named by bc and bcname") {
    const auto mesh = check_volumes("cube", 0, 0.003, {{"main", 1 - 4 * pi / 3 * 0.027}}, 0.01);
    CHECK(volume_of_set(mesh, "air") == doctest::Approx(volmesh::volume(mesh)).epsilon(1e-12));
    CHECK(area_of_set(mesh, "inlet") == doctest::Approx(1).epsilon(1e-12));
    CHECK(area_of_set(mesh, "bc2") == doctest::Approx(1).epsilon(1e-12));
    CHECK(area_of_set(mesh, "walls") == doctest::Approx(4).epsilon(1e-12));
    CHECK(area_of_set(mesh, "ball/surface") == doctest::Approx(4 * pi * 0.09).epsilon(0.03));
}

TEST_CASE("geo: cylinders without end, between planes") {
    const auto mesh = check_volumes("tube", 0, 0.005, {{"tube", pi * 0.75 * 3 * std::sqrt(2)}}, 0.015);
    CHECK(area_of_set(mesh, "ends.plane1/plane") == doctest::Approx(pi * 0.75).epsilon(0.02));
    CHECK(area_of_set(mesh, "tube.cylinder2/side") == doctest::Approx(pi * 3 * std::sqrt(2)).epsilon(0.03));
}

TEST_CASE("geo: cones, cut or up to their apex") {
    check_volumes("cones", 0.6, 0.01,
                  {{"frustum", pi * 2 / 3 * 7}, {"pointed", pi}, {"hanging", pi * 2 / 3 * 3.25}}, 0.02);
}

TEST_CASE("geo: elliptic cones and cylinders, ellipsoids") {
    check_volumes("elliptic", 1, 0.01,
                  {{"cone", pi * 6 * 4 / 3 * 1.75}, {"cylinder1", pi * 6}, {"egg", pi * 8}}, 0.03);
}

TEST_CASE("geo: bricks and polyhedra, with lists of boundary conditions in Netgen's order") {
    const auto mesh = check_volumes("polyhedra", 1, 0, {{"brick", 6}, {"pyramid", 4}}, 1e-12);
    CHECK(area_of_set(mesh, "floor") == doctest::Approx(6).epsilon(1e-12));
    CHECK(area_of_set(mesh, "front") == doctest::Approx(3).epsilon(1e-12));
    CHECK(area_of_set(mesh, "east") == doctest::Approx(2).epsilon(1e-12));
    CHECK(area_of_set(mesh, "bc1") == doctest::Approx(4).epsilon(1e-12));
    CHECK(area_of_set(mesh, "bc3") == doctest::Approx(std::sqrt(10)).epsilon(1e-12));
    CHECK(volume_of_set(mesh, "glass") == doctest::Approx(4).epsilon(1e-12));
}

TEST_CASE("geo: a ring in two parts that share its surface") {
    check_volumes("ring", 0, 0.02, {{"half", pi * pi * 3}, {"quarter", pi * pi * 3 / 2}}, 0.04);
}

TEST_CASE("geo: extrusions along straight, bent, curved and closed paths") {
    const auto mesh = check_volumes(
        "extrusion", 1, 0, {{"bar", 32}, {"angle", 48}, {"pipe", pi * 3 * pi}, {"hoop", pi * 10 * pi}}, 1e-2);
    CHECK(volume_of_set(mesh, "bar") == doctest::Approx(32).epsilon(1e-12));
    CHECK(volume_of_set(mesh, "angle") == doctest::Approx(48).epsilon(1e-12));
    CHECK(area_of_set(mesh, "pipe/start") == doctest::Approx(pi).epsilon(5e-3));
}

TEST_CASE("geo: solids of revolution from arcs and straight lines") {
    const auto mesh =
        check_volumes("revolution", 0.8, 0.01,
                      {{"hoop", 6 * pi * pi}, {"ball", 4 * pi / 3 * 8}, {"pin", pi * 2 + pi / 3}}, 0.02);
    CHECK(area_of_set(mesh, "butt") == doctest::Approx(pi).epsilon(0.03));
    CHECK(area_of_set(mesh, "shaft") == doctest::Approx(4 * pi).epsilon(0.03));
    CHECK(area_of_set(mesh, "tip") == doctest::Approx(pi * std::sqrt(2)).epsilon(0.03));
}

TEST_CASE("geo: moved, turned and repeated solids") {
    const double peg = pi / 2;
    check_volumes("transforms", 0.5, 0.01,
                  {{"row", 4 * peg}, {"wheel", 4 * peg}, {"lying", 6}, {"ball", 2 * pi / 3}}, 0.03);
    const Model model = read_model(file("transforms"));
    // Clockwise about x: what was up is along y.
    CHECK(contains(model, {20.5, 2.9, -1.9}));
    CHECK_FALSE(contains(model, {20.5, 1.9, 1}));
    for (const Point2& q :
         {Point2(0, 0), Point2(6, 0), Point2(3, 10), Point2(0, 13), Point2(-3, 10), Point2(0, 7)})
        CHECK(contains(model, {q.x(), q.y(), 1}));
    CHECK(contains(model, {29.5, 0.1, 0}));
    CHECK_FALSE(contains(model, {30.5, 0.1, 0}));
}

TEST_CASE("geo: several domains, their materials and boundary conditions") {
    const double seed = 4 * pi / 3 * (std::pow(0.12, 3) + std::pow(0.15, 3)), inner = pi * 0.04;
    const auto mesh = check_volumes("domains", 0.15, 0.002,
                                    {{"seed", seed}, {"inner", inner}, {"matrix", 1 - seed - inner}}, 0.04);
    for (const auto& [object, material] :
         {std::pair("seed", "quartz"), std::pair("inner", "glass"), std::pair("matrix", "resin")})
        CHECK(volume_of_set(mesh, object) == doctest::Approx(volume_of_set(mesh, material)).epsilon(1e-12));
    CHECK(area_of_set(mesh, "bc7") == doctest::Approx(inner).epsilon(0.03));
    CHECK(area_of_set(mesh, "ground") == doctest::Approx(1 - inner).epsilon(0.01));
    CHECK(area_of_set(mesh, "bc1") == doctest::Approx(4 + 1 + 0).epsilon(0.05));
    CHECK(area_of_set(mesh, "fibre/side/inner") == doctest::Approx(0.4 * pi).epsilon(0.03));
}

TEST_CASE("geo: what solids without end make is where it belongs") {
    const auto check = [](const std::string& text, const std::function<bool(const Point&)>& inside) {
        CAPTURE(text);
        check_inside(geo_model(text), inside);
    };
    const std::string block = "solid block = orthobrick (-2, -2, -2; 2, 2, 2); ";
    const auto in_block = [](const Point& p) { return p.cwiseAbs().maxCoeff() <= 2; };
    // What a cylinder leaves, though it has no end and the block is long.
    check(block + "solid s = block and not cylinder (0, 0, 0; 1, 0, 0; 1); tlo s;",
          [&](const Point& p) { return in_block(p) && p.tail<2>().norm() > 1; });
    check(block + "solid s = block and not (plane (0, 0, 0; 1, 0, 0) or plane (0, 0, 0; 0, 1, 0)); tlo s;",
          [&](const Point& p) { return in_block(p) && p.x() > 0 && p.y() > 0; });
    check(block + "solid s = (not plane (0, 0, 0; 1, 0, 0) or sphere (-1, 0, 0; 0.5)) and block; tlo s;",
          [&](const Point& p) { return in_block(p) && (p.x() > 0 || (p - Point(-1, 0, 0)).norm() <= 0.5); });
    // Only one half of a cone counts, that where its radius grows.
    check(block + "solid s = block and cone (0, 0, 0; 0; 0, 0, 1; 1); tlo s;",
          [&](const Point& p) { return in_block(p) && p.head<2>().norm() <= p.z(); });
    // A union that ends only with the rest.
    check(
        "solid s = plane (0, 0, -1; 0, 0, -1) and plane (0, 0, 1; 0, 0, 1) and (plane (1, 0, 0; 1, 0, 0) and "
        "plane (-1, 0, 0; -1, 0, 0) and plane (0, 2, 0; 0, 1, 0) and plane (0, -2, 0; 0, -1, 0) or cylinder "
        "(0, 0, "
        "0; 0, 0, 1; 1.5)); tlo s;",
        [](const Point& p) {
            return std::abs(p.z()) <= 1 &&
                   ((std::abs(p.x()) <= 1 && std::abs(p.y()) <= 2) || p.head<2>().norm() <= 1.5);
        });
    check(
        "solid a = sphere (0, 0, 0; 1); solid b = sphere (0.5, 0, 0; 1); solid s = a and not (not b); tlo s;",
        [](const Point& p) { return p.norm() <= 1 && (p - Point(0.5, 0, 0)).norm() <= 1; });
}

TEST_CASE("geo: names of primitives and surfaces") {
    const Model model = geo_model(
        "solid p = plane (0, 0, 0; 0, 0, -1); solid s = p and orthobrick (0, 0, -1; 1, 1, 1) and sphere (0, "
        "0, 0; 1) "
        "and sphere (1, 0, 0; 1) -bcname=skin; solid t = translate (3, 0, 0; s); tlo s; tlo t;");
    std::set<std::string> names = distinct(surface_names(model));
    CHECK(names.contains("skin"));
    CHECK(names.contains("p/clip1"));
    const Model plain = geo_model(
        "solid s = orthobrick (0, 0, 0; 1, 1, 1) and sphere (0, 0, 0; 1) and sphere (1, 0, 0; 1); tlo s;");
    names = distinct(surface_names(plain));
    CHECK(names.contains("s.orthobrick1/x-"));
    CHECK(names.contains("s.sphere2/surface"));
    CHECK(plain.primitives[0].name == "s");
    // The smallest maxh of a solid, its parts and the object.
    const Model sized = geo_model(
        "solid a = sphere (0, 0, 0; 1) -maxh=0.3; solid s = a or sphere (1, 0, 0; 1) -maxh=0.5; tlo s "
        "-maxh=0.4;");
    REQUIRE(sized.primitives.size() == 3);
    CHECK(sized.primitives[0].size == 0.3);
    CHECK(sized.primitives[1].size == 0.4);
    CHECK(sized.primitives[2].size == 0.4);
    CHECK(sized.primitives[2].name == "s");
}

TEST_CASE("geo: the default size is that of the object, not of the endless solids that it is cut from") {
    const Model bar = geo_model(
        "solid s = cylinder (0, 0, 0; 0, 0, 1; 1) and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 8; 0, 0, "
        "1); "
        "tlo s;");
    const auto box = bounding_box(bar);
    CHECK(box.min().z() == doctest::Approx(0));
    CHECK(box.max().z() == doctest::Approx(8));
    CHECK(box.contains(Eigen::AlignedBox3d(Point(-1, -1, 0), Point(1, 1, 8))));
    CHECK(box.diagonal().norm() < 1.05 * Point(2, 2, 8).norm());
    // What is cut off is not of the solid, though it may be of its box.
    const auto of = [](const std::string& text) { return bounding_box(parse_model(text, "box.csg")); };
    CHECK(
        of("difference() { cube(2); cylinder(h = 99, r = .1); }").isApprox({Point(0, 0, 0), Point(2, 2, 2)}));
    CHECK(of("intersection() { cube(2); translate([1, 1, 1]) cube(9); }")
              .isApprox({Point(1, 1, 1), Point(2, 2, 2)}));
    CHECK(of("union() { cube(1); intersection() { cube(2); translate([3, 0, 0]) cube(1); } }")
              .isApprox({Point(0, 0, 0), Point(1, 1, 1)}));
}

TEST_CASE("geo: errors name line and column") {
    const auto check = [](const std::string& text, const std::string& message) {
        CAPTURE(text);
        CHECK(geo_message(text) == "part.geo:" + message);
    };
    check("solid s = sphere (0, 0, 0, 1);", "2:26: expected ';' but found ','");
    check("solid s = sphere (0, 0, 0; 1;", "2:29: expected ')' but found ';'");
    check("solid s = spher (0, 0, 0; 1);", "2:11: there is no solid 'spher' (did you mean 'sphere'?)");
    check("solid s = sphere (0, 0, 0; 0); tlo s;",
          "2:18: sphere: the radius is 0; it has to be greater than 0");
    check("# comment\n  tlo s;", "3:7: there is no solid 's'");
    check("solod s;", "2:1: unknown statement 'solod' (did you mean 'solid'?)");
    check("solid and = sphere (0, 0, 0; 1);", "2:7: 'and' is a word of the language, not a name");
    check("solid s = sphere (0, 0, 0; 1) -maxx=3;", "2:32: unknown flag 'maxx' (did you mean 'maxh'?)");
    check("solid s = sphere (0, 0, 0; 1) -maxh=a;", "2:32: 'maxh' needs a number greater than 0");
    check("solid s = orthobrick (0,0,0; 1,1,1) -bc=[1,2];",
          "2:38: 'bc' lists 2 surfaces, but the solid has 6");
    check("solid s = cylinder (0, 0, 0; 0, 0, 1; 1);\ntlo s;",
          "3:5: the top-level object 's' has no end: intersect planes, cylinders and cones with what bounds "
          "them");
    check("solid s = plane (0, 0, 0; 0, 0, 1) and plane (0, 0, 1; 0, 0, -1) and sphere (0, 0, 0; 1); tlo s;",
          "2:95: the top-level object 's' is empty");
    check("solid s = revolution (0,0,0; 1,0,0; c); tlo s;", "2:37: there is no curve2d 'c'");
    check("curve2d c = (2; 0,1; 1,1; 1; 2,1,3);", "2:34: expected a whole number from 1 to 2, not 3");
    check("curve2d c = (2; 0,1; 1,1; 1; 2,1,2);\nsolid s = revolution (0,0,0; 1,0,0; c);",
          "3:22: revolution: its curve has to be closed, or to start and end on the axis, where y is 0");
    check("solid s = sphere (0, 0, 0; 1); tlo s; tlo s;", "2:43: 's' is a top-level object already");
    check("solid s = sphere (0, 0, 0; 1);\nidentify periodic s s;", "3:1: 'identify' is not supported");
    check("solid s = sphere (0, 0, 0; 1); tlo s s;", "2:32: a surface as top-level object is not supported");
    check("solid s = sphere (0, 0, 0; 1); boundarycondition s t 3;",
          "2:32: there is no top-level object 't'");
    check("solid s = sphere (0, 0, 0; 1);", " the model is empty: it has no top-level object (tlo)");
    CHECK_THROWS_WITH_AS(parse_geo_model("solid s;", "part.geo"),
                         "part.geo:1:1: expected 'algebraic3d' but found 'solid'", InputError);
    std::string deep;
    for (int i = 0; i < 100000; ++i) deep += "(";
    CHECK(geo_message("solid s = " + deep).ends_with("nested deeper than 200 levels"));
}

TEST_CASE("geo: any cut of a good text is read or refused") {
    const std::string text =
        "solid s = sphere (0,0,0;1) and not plane (0,0,0;1,0,0) -maxh=0.3 -bcname=[a,b];\ntlo s "
        "-col=[1,0,0];";
    for (std::size_t length = 0; length < text.size(); ++length)
        CHECK(geo_message(text.substr(0, length)).starts_with("part.geo:"));
    CHECK(geo_message(text) == "no error");
}
