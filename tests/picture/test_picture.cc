#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include <doctest/doctest.h>
#include <png.h>
#include <tbb/global_control.h>

#include "tests/support/kuhn.hh"
#include "tools/picture/picture.hh"
#include "volmesh/error.hh"

using namespace maille::picture;
using namespace maille::volmesh;
using maille::test::kuhn_cube;
namespace fs = std::filesystem;

namespace {

struct Pixels {
    unsigned width = 0, height = 0;
    std::vector<png_byte> rgb;

    std::array<int, 3> at(unsigned x, unsigned y) const {
        const png_byte* p = rgb.data() + 3 * (static_cast<std::size_t>(y) * width + x);
        return {p[0], p[1], p[2]};
    }
    std::set<std::array<int, 3>> colors() const {
        std::set<std::array<int, 3>> result;
        for (unsigned y = 0; y < height; ++y)
            for (unsigned x = 0; x < width; ++x) result.insert(at(x, y));
        return result;
    }
    template <class Predicate>
    double part(const Predicate& holds) const {
        std::size_t n = 0;
        for (unsigned y = 0; y < height; ++y)
            for (unsigned x = 0; x < width; ++x)
                if (holds(at(x, y))) ++n;
        return static_cast<double>(n) / (static_cast<double>(width) * height);
    }
};

Pixels read_png(const fs::path& path) {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_file(&header, path.c_str()));
    header.format = PNG_FORMAT_RGB;
    Pixels pixels{header.width, header.height, std::vector<png_byte>(PNG_IMAGE_SIZE(header))};
    REQUIRE(png_image_finish_read(&header, nullptr, pixels.rgb.data(), 0, nullptr));
    return pixels;
}

std::string bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// A folder for one test, gone at its end.
struct Folder {
    Folder() {
        std::string name = (fs::temp_directory_path() / "maille-picture-XXXXXX").string();
        REQUIRE(mkdtemp(name.data()) != nullptr);
        path = name;
    }
    ~Folder() { fs::remove_all(path); }
    fs::path path;
};

/// A cube of a material with a core of another one in its middle, and named sides x- and x+.
TetMesh two_materials() {
    TetMesh mesh = kuhn_cube(6);
    const SetHandle shell = mesh.add_set("shell", EntityKind::cell);
    const SetHandle core = mesh.add_set("core", EntityKind::cell);
    for (std::uint32_t i = 0; i < mesh.n_cells(); ++i) {
        const auto p = mesh.cell_points(CellHandle(i));
        const Point c = (p[0] + p[1] + p[2] + p[3]) / 4;
        mesh.insert((c - Point(0.5, 0.5, 0.5)).cwiseAbs().maxCoeff() < 1.0 / 3 ? core : shell, CellHandle(i));
    }
    const SetHandle low = mesh.add_set("x-", EntityKind::face);
    const SetHandle high = mesh.add_set("x+", EntityKind::face);
    for (std::uint32_t i = 0; i < mesh.n_halffaces(); ++i) {
        const HalffaceHandle hf(i);
        if (!mesh.is_boundary(hf)) continue;
        const auto v = mesh.halfface_vertices(hf);
        const auto all_at = [&](double x) {
            return std::ranges::all_of(v, [&](VertexHandle w) { return mesh.point(w).x() == x; });
        };
        if (all_at(0)) mesh.insert(low, hf);
        if (all_at(1)) mesh.insert(high, hf);
    }
    return mesh;
}

PictureOptions small() {
    PictureOptions options;
    options.width = 240;
    options.height = 180;
    return options;
}

bool is_white(const std::array<int, 3>& c) {
    return c == std::array{255, 255, 255};
}
/// The second colour of cell sets is orange, and nothing else is.
bool is_orange(const std::array<int, 3>& c) {
    return c[0] > 100 && c[0] > 2 * c[2] && c[0] > c[1] + 20;
}

}  // namespace

TEST_CASE("a picture is a PNG of the size asked for, on white, with shades") {
    const Folder folder;
    const fs::path file = folder.path / "cube.png";
    write_picture(two_materials(), file, small());
    const Pixels pixels = read_png(file);
    CHECK(pixels.width == 240);
    CHECK(pixels.height == 180);
    CHECK(pixels.colors().size() > 300);
    for (unsigned x : {0U, 239U})
        for (unsigned y : {0U, 179U}) CHECK(std::ranges::min(pixels.at(x, y)) >= 250);
    CHECK(pixels.part(is_white) > 0.2);
    CHECK(pixels.part(is_white) < 0.8);
    CHECK(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()) == 1);
}

TEST_CASE("the same picture has the same bytes, for any number of threads") {
    const Folder folder;
    const TetMesh mesh = two_materials();
    std::vector<std::string> files;
    for (std::size_t threads : {1, 2, 4, 4}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        write_picture(mesh, folder.path / "cube.png", small());
        files.push_back(bytes_of(folder.path / "cube.png"));
    }
    CHECK(files[0].size() > 1000);
    for (const auto& file : files) CHECK((file == files[0]));
}

TEST_CASE("a cut shows what is inside, and without one nothing of it shows") {
    const Folder folder;
    const TetMesh mesh = two_materials();
    PictureOptions options = small();
    options.legend = false;
    write_picture(mesh, folder.path / "cut.png", options);
    options.cut.emplace();
    write_picture(mesh, folder.path / "whole.png", options);
    CHECK(read_png(folder.path / "cut.png").part(is_orange) > 0.02);
    CHECK(read_png(folder.path / "whole.png").part(is_orange) == 0);
}

TEST_CASE("a cut takes whole cells, those beyond all of its planes") {
    const Folder folder;
    const TetMesh mesh = kuhn_cube(4);
    PictureOptions options = small();
    options.view = {0, -1, 0.01};
    options.legend = false;
    options.cut = {Plane(Point(1, 0, 0), Point(0.5, 0, 0))};
    write_picture(mesh, folder.path / "half.png", options);
    // The half that is left is twice as high as wide, and the picture is filled with it.
    const Pixels pixels = read_png(folder.path / "half.png");
    unsigned left = 240;
    unsigned right = 0;
    for (unsigned x = 0; x < 240; ++x)
        if (std::ranges::max(pixels.at(x, 90)) < 240) {
            left = std::min(left, x);
            right = std::max(right, x);
        }
    CHECK(right - left > 60);
    CHECK(right - left < 110);
}

TEST_CASE("the legend is beside the mesh") {
    const Folder folder;
    PictureOptions options = small();
    write_picture(two_materials(), folder.path / "with.png", options);
    options.legend = false;
    write_picture(two_materials(), folder.path / "without.png", options);
    CHECK(bytes_of(folder.path / "with.png") != bytes_of(folder.path / "without.png"));
    // Both materials have a swatch.
    CHECK(read_png(folder.path / "with.png").part(is_orange) > 0);
}

TEST_CASE("what can't be drawn is refused") {
    const Folder folder;
    const TetMesh mesh = kuhn_cube(1);
    PictureOptions options = small();
    CHECK_THROWS_AS(write_picture(TetMesh::from_cells({}, {}), folder.path / "a.png", options),
                    maille::InputError);
    CHECK_THROWS_AS(write_picture(mesh, folder.path / "no/such/folder/a.png", options), maille::InputError);
    options.cut = {Plane(Point(1, 0, 0), Point(-1, 0, 0))};
    CHECK_THROWS_AS(write_picture(mesh, folder.path / "a.png", options), maille::InputError);
    options = small();
    options.width = 0;
    CHECK_THROWS_AS(write_picture(mesh, folder.path / "a.png", options), maille::InputError);
    options = small();
    options.view.setZero();
    CHECK_THROWS_AS(write_picture(mesh, folder.path / "a.png", options), maille::InputError);
    CHECK(fs::is_empty(folder.path));
}
