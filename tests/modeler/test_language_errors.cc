#include <string>

#include "modeler/parser.hh"
#include "tests/modeler/language_checks.hh"

using namespace maille;
using namespace maille::modeler;
using namespace maille::modeler::test;

namespace {

struct BadInput {
    std::string text;
    std::string message;
};

void check_all(std::initializer_list<BadInput> inputs) {
    for (const auto& [text, message] : inputs) {
        CAPTURE(text);
        CHECK(message_of(text) == "part.csg:" + message);
    }
}

std::string repeated(const std::string& text, int times) {
    std::string result;
    for (int i = 0; i < times; ++i) result += text;
    return result;
}

}  // namespace

TEST_CASE("errors of spelling name the place") {
    check_all({
        {"cube(1);\n  @", "2:3: unexpected character '@'"},
        {"\x01", "1:1: unexpected byte 0x01"},
        {"cube(1); /* for ever", "1:10: this comment is never closed"},
        {"name(\"plate) cube(1);", "1:6: this string is never closed"},
        {"name(\"a\nb\") cube(1);", "1:6: this string is never closed"},
        {"name(\"a\\q\") cube(1);", "1:8: unknown escape '\\q' in a string"},
        {"cube(1.2.3);", "1:6: '1.2.' is not a number"},
        {"cube(2mm);", "1:6: '2m' is not a number"},
        {"cube(1e999);", "1:6: the number 1e999 is out of range"},
        {"name(\"\xC3\xA9\") @", "1:11: unexpected character '@'"},
    });
}

TEST_CASE("errors of grammar name the place and what was expected") {
    check_all({
        {"cube(1)", "1:8: expected ';' but found the end of the file"},
        {"cube 1;", "1:6: expected '(' but found '1'"},
        {"cube(1;", "1:7: expected ',' or ')' but found ';'"},
        {"cube([1, 2);", "1:11: expected ',' or ']' but found ')'"},
        {"cube((1;", "1:8: expected ')' but found ';'"},
        {"cube(size = );", "1:13: expected a value but found ')'"},
        {"union() { cube(1); ", "1:20: expected '}' but found the end of the file"},
        {"union() { cube(1) }", "1:19: expected ';' but found '}'"},
        {"cube(1); }", "1:10: expected a node but found '}'"},
        {"\"cube\"", "1:1: expected a node but found the string \"cube\""},
        {"h = 3; cube(h);",
         "1:1: there are no variables: write the value of 'h' where it is used, or have OpenSCAD write the "
         ".csg file"},
        {"cube(h);", "1:6: unknown value 'h': there are numbers, strings, vectors, true, false and pi"},
        {"cube(1/0);", "1:7: 1 / 0 has no finite value"},
        {"cube(1e300*1e300);", "1:11: 1e+300 * 1e+300 has no finite value"},
        {"cube([1]*2);", "1:6: arithmetic is for numbers only"},
        {"cube(-true);", "1:7: arithmetic is for numbers only"},
    });
}

TEST_CASE("unknown and unsupported nodes are named") {
    check_all({
        {"union() {\n\tcubee(1);\n}", "2:2: unknown node 'cubee' (did you mean 'cube'?)"},
        {"Sphere(1);", "1:1: unknown node 'Sphere' (did you mean 'sphere'?)"},
        {"frobnicate();", "1:1: unknown node 'frobnicate'"},
        {"cube(1); minkowski() { cube(1); sphere(1); }", "1:10: 'minkowski' is not supported"},
        {"polygon(points = [[0, 0]], paths = undef);",
         "1:1: 'polygon' is flat: it stands in a linear_extrude or rotate_extrude only"},
        {"projection(cut = false) cube(1);", "1:1: 'projection' is not supported"},
        {"union() {\n  surface(file = \"a.dat\", center = false, invert = false, convexity = 1);\n}",
         "2:3: 'surface' is not supported"},
        {"linear_extrude(height = 1) cube(1);",
         "1:28: 'cube' has no place in an extrusion: only flat shapes do (circle, square, polygon, offset, "
         "hull), their unions, differences and intersections, and transforms"},
        {"linear_extrude(height = 1) text(\"a\");",
         "1:28: 'text' has no place in an extrusion: only flat shapes do (circle, square, polygon, offset, "
         "hull), their unions, differences and intersections, and transforms"},
        {"text(\"a\");", "1:1: 'text' is not supported"},
        {"for(i = 1) cube(1);",
         "1:1: 'for' is not supported: have OpenSCAD write the .csg file (openscad -o part.csg part.scad)"},
    });
}

TEST_CASE("extrusions that make no solid are refused") {
    check_all({
        {"linear_extrude(height = 0) square(1);",
         "1:25: linear_extrude: 'height' must be greater than 0, not 0"},
        {"linear_extrude() square(1);", "1:1: linear_extrude: 'height' is missing"},
        {"linear_extrude(1, slices = 0) square(1);",
         "1:28: linear_extrude: 'slices' must be a whole number from 1 to 2000, not 0"},
        {"linear_extrude(1, scale = -1) square(1);", "1:27: linear_extrude: a scale must not be negative"},
        {"linear_extrude(1) square(0);", "1:26: square: every side must be longer than 0"},
        {"linear_extrude(1) circle(r = 0);", "1:30: circle: the radius must be greater than 0"},
        {"linear_extrude(1) polygon([[0, 0], [1, 0], [2, 0]]);", "1:27: polygon: the polygon has no area"},
        {"linear_extrude(1) polygon([[0, 0], [1, 0], [2, 1]], [[0, 1, 3]]);",
         "1:61: polygon: there is no point 3: the 3 points count from 0"},
        {"linear_extrude(1) offset() square(1);", "1:19: offset: give either 'r' or 'delta'"},
        {"linear_extrude(1) scale([0, 1, 1]) square(1);",
         "1:19: 'scale' flattens its children or has no inverse"},
        {"linear_extrude(1);", " the model is empty: it has no solid"},
        {"rotate_extrude() translate([-1, 0]) square(2);",
         "1:1: rotate_extrude: the shape reaches across the axis x = 0, round which it is turned"},
        {"rotate_extrude(angle = 0) square(2);", "1:24: rotate_extrude: the angle must not be 0"},
    });
}

TEST_CASE("arguments are checked by name, number and type") {
    check_all({
        {"cube(1, true, 3);", "1:15: cube: at most 2 arguments without a name"},
        {"cube(sise = 1);", "1:6: cube: unknown argument 'sise' (did you mean 'size'?)"},
        {"cube(1, size = 2);", "1:9: cube: 'size' is given twice"},
        {"cube(size = \"big\");", "1:13: cube: 'size' must be a number, not a string"},
        {"cube([1, 2]);", "1:6: cube: 'size' must be a vector of 3 numbers, not 2 elements"},
        {"cube([1, 2, true]);", "1:13: cube: 'size' must be a number, not a boolean"},
        {"cube(1, center = 1);", "1:18: cube: 'center' must be true or false, not a number"},
        {"sphere(r = undef);", "1:12: sphere: 'r' must be a number, not undef"},
        {"torus(2);", "1:1: torus: 'r2' is missing"},
        {"translate(1) cube(1);", "1:11: translate: 'v' must be a vector of 3 numbers, not a number"},
        {"union(1) cube(1);", "1:7: union: at most 0 arguments without a name"},
        {"name(3) cube(1);", "1:6: name: 'value' must be a string, not a number"},
        {"polyhedron(points = 1, faces = []);",
         "1:21: polyhedron: 'points' must be a list in brackets, not a number"},
    });
}

TEST_CASE("solids that cannot be are refused") {
    check_all({
        {"cube(0);", "1:6: cube: every side must be longer than 0"},
        {"cube([1, -2, 1]);", "1:6: cube: every side must be longer than 0"},
        {"sphere(-1);", "1:8: sphere: the radius must be greater than 0"},
        {"sphere(d = 0);", "1:12: sphere: the radius must be greater than 0"},
        {"sphere(1, d = 2);", "1:15: sphere: give 'r' or 'd', not both"},
        {"cylinder(h = 0, r = 1);", "1:14: cylinder: 'h' must be greater than 0, not 0"},
        {"cylinder(h = 1, r = -2);", "1:1: cylinder: a radius must not be negative, not -2"},
        {"cylinder(1, 0, 0);", "1:1: cylinder: the radius must be greater than 0"},
        {"cylinder(1, 2);", "1:1: cylinder: give a radius for each end (r1 and r2), or one for both (r)"},
        {"cylinder(h = 1, r = 2, r1 = 1);", "1:1: cylinder: give one radius, or one for each end, not both"},
        {"torus(1, 2);", "1:10: torus: the minor radius 'r2' must be less than the major radius 'r1'"},
        {"ellipsoid([1, 0, 1]);", "1:11: ellipsoid: every semi-axis must be greater than 0"},
        {"wedge([1, 1, 1], -1);", "1:18: wedge: 'dx' must not be negative, not -1"},
        {"prism(2, 1, 1);", "1:7: prism: 'n' must be a whole number from 3 to 2000, not 2"},
        {"pyramid(4.5, 1, 1);", "1:9: pyramid: 'n' must be a whole number from 3 to 2000, not 4.5"},
        {"tetrahedron([[0,0,0], [1,0,0], [0,1,0]]);", "1:13: tetrahedron: 'points' must be 4 points, not 3"},
        {"polyhedron([[0,0,0]], [[0, 1, 2]]);",
         "1:28: polyhedron: there is no point 1: the 1 points count from 0"},
        {"polyhedron([[0,0,0], [1,0,0]], [[0, 1]]);", "1:33: polyhedron: a face needs at least 3 points"},
        {"cube(1) sphere(1);", "1:9: 'cube' takes no children: is a ';' missing?"},
    });
    // Found by the solid itself, placed by the language.
    CHECK(message_of("\n tetrahedron([[0,0,0], [1,0,0], [0,1,0], [1,1,0]]);")
              .starts_with("part.csg:2:2: tetrahedron: "));
    CHECK(message_of("polyhedron([[0,0,0], [1,0,0], [0,1,0]], [[0, 1, 2]]);")
              .starts_with("part.csg:1:1: polyhedron: "));
}

TEST_CASE("transforms that flatten are refused") {
    check_all({
        {"scale([1, 0, 1]) cube(1);", "1:1: 'scale' flattens its children or has no inverse"},
        {"multmatrix([[1,0,0,0],[1,0,0,0],[0,0,1,0],[0,0,0,1]]) cube(1);",
         "1:1: 'multmatrix' flattens its children or has no inverse"},
        {"multmatrix([[1,0,0,0],[0,1,0,0]]) cube(1);",
         "1:12: multmatrix: the matrix must have 4 rows, not 2"},
        {"multmatrix([[1,0,0],[0,1,0,0],[0,0,1,0]]) cube(1);",
         "1:13: multmatrix: a row of the matrix must have 4 numbers, not 3"},
        {"multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,2]]) cube(1);",
         "1:43: multmatrix: the last row of the matrix must be [0, 0, 0, 1]"},
        {"mirror([0, 0, 0]) cube(1);", "1:8: mirror: the normal of the mirror must not be 0"},
        {"rotate(30, [0, 0, 0]) cube(1);", "1:12: rotate: the axis of rotation must not be 0"},
        {"rotate([1, 2, 3], [0, 0, 1]) cube(1);",
         "1:19: rotate: an axis 'v' goes with one angle 'a', not with three"},
        {repeated("scale(1e-200) ", 2) + "cube(1);", "1:15: 'scale' flattens its children or has no inverse"},
    });
}

TEST_CASE("attributes are checked") {
    check_all({
        {"size(0) cube(1);", "1:6: size: 'value' must be greater than 0, not 0"},
        {"name(\"\") cube(1);", "1:6: name: the name must not be empty"},
        {"material(\"a/b\") cube(1);",
         "1:10: material: a name must have no slash, no quotes and no line break"},
        {"name(\"plate\"); cube(1);", "1:1: 'name' stands before no node: is there a ';' too many?"},
    });
}

TEST_CASE("endless models are refused at the half-space") {
    const std::string what =
        ": this half-space makes the model endless: intersect it with a solid, or subtract it from one";
    check_all({
        {"halfspace([0,0,0], [0,0,1]);", "1:1" + what},
        {"union() { cube(1); halfspace([0,0,0], [0,0,1]); }", "1:20" + what},
        {"difference() { halfspace([0,0,0], [0,0,1]); cube(1); }", "1:16" + what},
        {"intersection() { halfspace([0,0,0], [0,0,1]); halfspace([0,0,0], [0,0,-1]); }", "1:18" + what},
        {"intersection() { cube(1); halfspace([0,0,0], [0,0,0]); }",
         "1:46: halfspace: the normal must not be 0"},
    });
}

TEST_CASE("empty models are refused") {
    const std::string what = " the model is empty: it has no solid";
    check_all({
        {"", what},
        {"// nothing\n", what},
        {"group();", what},
        {"%cube(1);", what},
        {"intersection() { cube(1); group(); }", what},
        {"difference() { group(); cube(1); }", what},
    });
}

TEST_CASE("nesting has a limit, and does not crash") {
    const auto nested = [](const std::string& open, const std::string& inner, const std::string& close,
                           int depth) { return repeated(open, depth) + inner + repeated(close, depth); };
    CHECK(parse_model(nested("union() {", "cube(1);", "}", max_nesting - 2), "part.csg").primitives.size() ==
          1);
    CHECK(message_of(nested("union() {", "cube(1);", "}", 100000)) ==
          "part.csg:1:9001: nested deeper than 1000 levels");
    CHECK(message_of(repeated("translate([0,0,0]) ", 100000) + "cube(1);") ==
          "part.csg:1:18974: nested deeper than 1000 levels");
    CHECK(message_of("cube(" + repeated("(", 100000)) == "part.csg:1:1005: nested deeper than 1000 levels");
    CHECK(message_of("cube(" + repeated("[", 100000)) == "part.csg:1:1005: nested deeper than 1000 levels");
    CHECK(message_of("cube(" + repeated("-", 100000)) == "part.csg:1:1005: nested deeper than 1000 levels");
    CHECK(message_of(nested("intersection() { halfspace([0,0,0],[0,0,1]); ", "halfspace([0,0,0],[0,0,1]);",
                            "}", 900))
              .find("endless") != std::string::npos);
}

TEST_CASE("files that cannot be read are named") {
    CHECK_THROWS_WITH_AS(read_model("no/such/part.csg"), "no/such/part.csg: cannot read this file",
                         InputError);
    CHECK_THROWS_WITH_AS(read_model("."), ".: cannot read this file", InputError);
}

TEST_CASE("any cut of a good text is read or refused") {
    const std::string text =
        "name(\"a\") size(2 * pi) difference() { cube([1, 2, 3], center = true); #translate([1, 0, -1]) "
        "sphere(r = 1); }";
    for (std::size_t length = 0; length < text.size(); ++length)
        CHECK(message_of(text.substr(0, length)).starts_with("part.csg:"));
    CHECK(message_of(text) == "no error");
}
