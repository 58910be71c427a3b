#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <fmt/format.h>
#include <unistd.h>

#include "tests/modeler/language_checks.hh"

using namespace maille;
using namespace maille::modeler;
using namespace maille::modeler::test;

namespace {

/// A folder for the files of one test.
class Folder {
  public:
    Folder()
        : path_(std::filesystem::temp_directory_path() / fmt::format("maille_test_import_{}", getpid())) {
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_ / "parts");
    }
    ~Folder() { std::filesystem::remove_all(path_); }

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(path_ / name) << text;
        return (path_ / name).string();
    }

    Model import(const std::string& name) const {
        return parse_model("import(file = \"" + name + "\");", (path_ / "model.csg").string());
    }

    std::string message(const std::string& name) const {
        try {
            import(name);
        } catch (const InputError& error) {
            const std::string text = error.what();
            return text.substr(path_.string().size() + 1);
        }
        return "no error";
    }

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

const std::string corners = "v 0 0 0\nv 2 0 0\nv 0 3 0\nv 2 3 0\nv 0 0 1\nv 2 0 1\nv 0 3 1\nv 2 3 1\n";
const std::string lid = "f 5 6 8 7\n";
const std::string box_obj = corners + lid + "f 1 3 4 2\nf 1 2 6 5\nf 2 4 8 6\nf 4 3 7 8\nf 3 1 5 7\n";

/// The same box as OpenSCAD writes STL: each triangle by itself.
std::string box_stl() {
    const double x[] = {0, 2}, y[] = {0, 3}, z[] = {0, 1};
    const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                             {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    std::string text = "solid box\n";
    for (const auto& face : faces)
        for (const int second : {1, 2}) {
            text += "facet normal 0 0 0\nouter loop\n";
            for (const int corner : {face[0], face[second], face[second + 1]})
                text += "vertex " + std::to_string(x[corner & 1]) + " " + std::to_string(y[corner >> 1 & 1]) +
                        " " + std::to_string(z[corner >> 2]) + "\n";
            text += "endloop\nendfacet\n";
        }
    return text + "endsolid box\n";
}

}  // namespace

TEST_CASE("a box comes back from .stl, .obj and .off as six faces") {
    const Folder folder;
    folder.write("box.stl", box_stl());
    folder.write("parts/box.obj", box_obj);
    folder.write(
        "box.OFF",
        "OFF\n8 6 0\n0 0 0\n2 0 0\n0 3 0\n2 3 0\n0 0 1\n2 0 1\n0 3 1\n2 3 1\n4 4 5 7 6\n4 0 2 3 1\n4 0 1 5 "
        "4\n4 1 3 7 5\n4 3 2 6 7\n4 2 0 4 6\n");
    for (const char* name : {"box.stl", "parts/box.obj", "box.OFF"}) {
        CAPTURE(name);
        const Model model = folder.import(name);
        REQUIRE(model.primitives.size() == 1);
        CHECK(model.primitives[0].name == "import1");
        CHECK(figures_of(model.primitives[0]).volume == doctest::Approx(6).epsilon(1e-14));
        CHECK(surfaces(model).size() == 6);
        CHECK(distinct(surface_names(model)).size() == 6);
    }
    const Model placed = parse_model(
        "translate([10, 0, 0]) scale(2) import(file = \"box.stl\", layer = \"\", origin = [0, 0], convexity "
        "= 1, "
        "timestamp = 1700000000);",
        (folder.path() / "model.csg").string());
    CHECK(placed.primitives[0].shape->bounding_box().max() == Point(14, 6, 2));
}

TEST_CASE("a surface that is inside out, hollow or smooth is imported as it is meant") {
    const Folder folder;
    // Turned inside out: all faces, or one of them.
    folder.write("one.obj",
                 corners + "f 7 8 6 5\n" + "f 1 3 4 2\nf 1 2 6 5\nf 2 4 8 6\nf 4 3 7 8\nf 3 1 5 7\n");
    folder.write("all.obj", corners + "f 7 8 6 5\nf 2 4 3 1\nf 5 6 2 1\nf 6 8 4 2\nf 8 7 3 4\nf 7 5 1 3\n");
    CHECK(figures_of(folder.import("all.obj").primitives[0]).volume == doctest::Approx(6).epsilon(1e-14));
    CHECK(folder.message("one.obj").find("the surface is not closed") != std::string::npos);

    // A ball in rings: one patch.
    std::string ball;
    const int n = 24;
    ball += "v 0 0 1\nv 0 0 -1\n";
    for (int i = 1; i < n; ++i)
        for (int j = 0; j < 2 * n; ++j) {
            const double polar = std::numbers::pi * i / n, angle = std::numbers::pi * j / n;
            ball += "v " + std::to_string(std::sin(polar) * std::cos(angle)) + " " +
                    std::to_string(std::sin(polar) * std::sin(angle)) + " " +
                    std::to_string(std::cos(polar)) + "\n";
        }
    const auto at = [&](int i, int j) { return std::to_string(3 + (i - 1) * 2 * n + j % (2 * n)); };
    for (int j = 0; j < 2 * n; ++j) {
        ball += "f 1 " + at(1, j) + " " + at(1, j + 1) + "\n";
        ball += "f 2 " + at(n - 1, j + 1) + " " + at(n - 1, j) + "\n";
        for (int i = 1; i + 1 < n; ++i)
            ball += "f " + at(i, j) + " " + at(i + 1, j) + " " + at(i + 1, j + 1) + " " + at(i, j + 1) + "\n";
    }
    folder.write("ball.obj", ball);
    const Model model = folder.import("ball.obj");
    CHECK(distinct(surface_names(model)) == std::set<std::string>{"import1/patch0"});
    const double sphere = 4 * std::numbers::pi / 3;
    const double volume = figures_of(model.primitives[0]).volume;
    CHECK(volume < sphere);
    CHECK(volume > 0.98 * sphere);
    CHECK(model.primitives[0].shape->contains({0.5, 0.5, 0.5}));
    CHECK_FALSE(model.primitives[0].shape->contains({0.7, 0.7, 0.7}));
}

TEST_CASE("files that hold no solid are refused by name and place") {
    const Folder folder;
    folder.write("open.obj", corners + lid);
    folder.write("empty.stl", "solid nothing\nendsolid nothing\n");
    folder.write("nonsense.off", "this is not a surface");
    folder.write("drawing.dxf", "0\nSECTION\n");
    const std::string folder_path = (folder.path() / "").string();
    CHECK(folder.message("open.obj") ==
          "model.csg:1:15: import: \"" + folder_path +
              "open.obj\": the surface is not closed: 4 edges have not two triangles");
    CHECK(folder.message("empty.stl").ends_with("cannot be read as a surface"));
    CHECK(folder.message("nonsense.off").ends_with("cannot be read as a surface"));
    CHECK(folder.message("drawing.dxf").ends_with("only solids in .stl, .off and .obj files are read"));
    CHECK(folder.message("missing.stl").ends_with("there is no such file"));
    CHECK(message_of("import();") == "part.csg:1:1: import: 'file' is missing");
    CHECK(message_of("import(file = 3);") == "part.csg:1:15: import: 'file' must be a string, not a number");
}

TEST_CASE("polyhedra with reversed faces are mended, those that do not close are refused") {
    const std::string points = "points = [[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0,0,1],[1,0,1],[1,1,1],[0,1,1]]";
    const auto volume = [&](const std::string& faces) {
        const Model model = model_of("polyhedron(" + points + ", faces = [" + faces + "]);");
        return figures_of(model.primitives.front()).volume;
    };
    const auto message = [&](const std::string& faces) {
        return message_of("polyhedron(" + points + ", faces = [" + faces + "]);");
    };
    const std::string good = "[0,1,2,3],[7,6,5,4],[0,4,5,1],[1,5,6,2],[2,6,7,3]";
    CHECK(volume(good + ",[3,7,4,0]") == doctest::Approx(1).epsilon(1e-14));
    CHECK(volume(good + ",[0,4,7,3]") == doctest::Approx(1).epsilon(1e-14));
    CHECK(volume("[3,2,1,0],[4,5,6,7],[0,4,5,1],[1,5,6,2],[3,7,6,2],[3,7,4,0]") ==
          doctest::Approx(1).epsilon(1e-14));
    CHECK(volume("[3,2,1,0],[4,5,6,7],[1,5,4,0],[2,6,5,1],[3,7,6,2],[0,4,7,3]") ==
          doctest::Approx(1).epsilon(1e-14));
    CHECK(message(good).find("not closed") != std::string::npos);
    CHECK(message(good + ",[3,7,4,0],[0,1,2,3]").starts_with("part.csg:1:1: polyhedron: "));
}

TEST_CASE("pieces of a polyhedron are turned outwards one by one, cavities stay") {
    const auto box = [](double low, double high) {
        std::string text;
        for (int i = 0; i < 8; ++i)
            text += fmt::format("[{},{},{}],", i & 1 ? high : low, i & 2 ? high : low, i & 4 ? high : low);
        return text;
    };
    const auto faces = [](int first, bool reversed) {
        const int quads[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                 {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
        std::string text;
        for (const auto& q : quads)
            text +=
                reversed
                    ? fmt::format("[{},{},{},{}],", first + q[3], first + q[2], first + q[1], first + q[0])
                    : fmt::format("[{},{},{},{}],", first + q[0], first + q[1], first + q[2], first + q[3]);
        return text;
    };
    const auto volume = [&](const std::string& points, const std::string& all) {
        const Model model = model_of("polyhedron([" + points + "], [" + all + "]);");
        return figures_of(model.primitives.front()).volume;
    };
    const std::string apart = box(0, 1) + box(2, 4), nested = box(0, 3) + box(1, 2);
    for (const bool first : {false, true})
        for (const bool second : {false, true})
            CHECK(volume(apart, faces(0, first) + faces(8, second)) == doctest::Approx(9).epsilon(1e-14));
    CHECK(volume(nested, faces(0, false) + faces(8, true)) == doctest::Approx(26).epsilon(1e-14));
    CHECK(volume(nested, faces(0, true) + faces(8, false)) == doctest::Approx(26).epsilon(1e-14));
}

TEST_CASE("faces that are not planar are cut into triangles") {
    const Model model = model_of(
        "polyhedron([[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0,0,1],[1,0,1],[1,1,1.5],[0,1,1]], "
        "[[0,1,2,3],[7,6,5,4],[0,4,5,1],[1,5,6,2],[2,6,7,3],[3,7,4,0]]);");
    CHECK(surfaces(model).size() == 7);
    CHECK(distinct(surface_names(model)).size() == 6);
    // Above the unit cube, one triangle of the lid rises, or both do, as the diagonal has it.
    const double above = figures_of(model.primitives.front()).volume - 1;
    CHECK((std::abs(above - 0.5 / 6) < 1e-14 || std::abs(above - 0.5 / 3) < 1e-14));
}
