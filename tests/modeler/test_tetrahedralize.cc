#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <thread>

#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <unistd.h>

#include "modeler/tetgen_process.hh"
#include "modeler/tetrahedralize.hh"
#include "volmesh/error.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

namespace {

using namespace maille;
using namespace maille::modeler;
using Eigen::Vector3d;

/// The surface of a box, two triangles a side, normals outwards.
void add_box(FacetComplex& complex, const Vector3d& low, const Vector3d& high, Region front, Region back) {
    const auto base = static_cast<std::uint32_t>(complex.points.size());
    for (int i = 0; i < 8; ++i)
        complex.points.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                                    i & 4 ? high.z() : low.z());
    constexpr std::array<std::array<std::uint32_t, 4>, 6> sides{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (std::uint32_t s = 0; s < 6; ++s) {
        const auto& q = sides[s];
        complex.facets.push_back({{base + q[0], base + q[1], base + q[2]}, s, front, back});
        complex.facets.push_back({{base + q[0], base + q[2], base + q[3]}, s, front, back});
    }
}

/// Each facet cut into four.
FacetComplex quartered(const FacetComplex& coarse) {
    FacetComplex fine{coarse.points, {}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [place, is_new] =
            middles.emplace(std::minmax(a, b), static_cast<std::uint32_t>(fine.points.size()));
        if (is_new) fine.points.emplace_back((coarse.points[a] + coarse.points[b]) / 2);
        return place->second;
    };
    for (const Facet& f : coarse.facets) {
        const auto [a, b, c] = f.vertices;
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        for (const std::array<std::uint32_t, 3>& part :
             {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}}) {
            fine.facets.push_back(f);
            fine.facets.back().vertices = part;
        }
    }
    return fine;
}

double volume_of(const ComplexMesh& mesh, Region region) {
    double sum = 0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        if (mesh.regions[c] != region) continue;
        const auto& [i, j, k, l] = mesh.cells[c];
        sum += volmesh::tet_volume(mesh.points[i], mesh.points[j], mesh.points[k], mesh.points[l]);
    }
    return sum;
}

volmesh::TriMesh surface_of(const FacetComplex& complex) {
    volmesh::TriMesh surface;
    for (const Vector3d& p : complex.points) surface.add_vertex(p);
    for (const Facet& f : complex.facets)
        surface.add_face(surface.vertex_handle(f.vertices[0]), surface.vertex_handle(f.vertices[1]),
                         surface.vertex_handle(f.vertices[2]));
    return surface;
}

/// Sets MAILLE_TETGEN for a while.
class OtherWorker {
  public:
    explicit OtherWorker(const std::string& path) { setenv("MAILLE_TETGEN", path.c_str(), 1); }
    ~OtherWorker() { unsetenv("MAILLE_TETGEN"); }
};

/// An executable script, for a while.
class Script {
  public:
    explicit Script(const std::string& text)
        : path_(std::filesystem::temp_directory_path() / ("maille_test_worker_" + std::to_string(getpid()))) {
        std::ofstream(path_) << "#!/bin/sh\n" << text << "\n";
        std::filesystem::permissions(path_, std::filesystem::perms::owner_all);
    }
    ~Script() { std::filesystem::remove(path_); }
    std::string path() const { return path_.string(); }

  private:
    std::filesystem::path path_;
};

std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST_CASE("the mesh of a surface is valid, fills it and has its triangles as boundary") {
    FacetComplex box;
    add_box(box, {0, 0, 0}, {1, 2, 3}, outside, 0);
    box = quartered(quartered(box));
    const volmesh::TetMesh mesh = tetrahedralize(surface_of(box), 0.5);
    CHECK(volmesh::validate(mesh).ok());
    CHECK(volmesh::volume(mesh) == doctest::Approx(6).epsilon(1e-12));
    CHECK(volmesh::boundary_area(mesh) == doctest::Approx(22).epsilon(1e-12));
    CHECK(mesh.n_boundary_faces() == 192);
    CHECK(mesh.n_cells() > 300);
    for (std::uint32_t v = 0; v < box.points.size(); ++v)
        CHECK(mesh.point(volmesh::VertexHandle(v)) == box.points[v]);
}

TEST_CASE("each region of a complex gets its own size, cavities stay empty") {
    FacetComplex complex;
    add_box(complex, {-2, -2, -2}, {2, 2, 2}, outside, 0);
    add_box(complex, {-1.5, -1.5, -1.5}, {-0.5, -0.5, -0.5}, 0, 1);
    add_box(complex, {0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}, 0, outside);
    std::vector<std::string> warnings;
    complex = quartered(quartered(quartered(complex)));
    const ComplexMesh mesh = tetrahedralize(complex, std::vector{1.0, 0.25}, {}, &warnings);
    CHECK(warnings.empty());
    CHECK(volume_of(mesh, 0) == doctest::Approx(62).epsilon(1e-12));
    CHECK(volume_of(mesh, 1) == doctest::Approx(1).epsilon(1e-12));
    CHECK(mesh.facets.size() == 36 * 64);
    double largest = 0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        const auto& [i, j, k, l] = mesh.cells[c];
        if (mesh.regions[c] == 1)
            largest = std::max(
                largest, volmesh::tet_volume(mesh.points[i], mesh.points[j], mesh.points[k], mesh.points[l]));
    }
    CHECK(largest <= 3 * std::pow(0.25, 3) / (6 * std::sqrt(2)));
}

TEST_CASE("nothing is made in the cavity of a solid of one region") {
    FacetComplex complex;
    add_box(complex, {-2, -2, -2}, {2, 2, 2}, outside, 0);
    add_box(complex, {-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}, 0, outside);
    for (int i = 0; i < 4; ++i) complex = quartered(complex);
    const ComplexMesh mesh = tetrahedralize(complex, std::array{0.15});
    CHECK(volume_of(mesh, 0) == doctest::Approx(37).epsilon(1e-12));
    CHECK(mesh.points.size() > complex.points.size());
    for (const Vector3d& p : mesh.points) CHECK(p.cwiseAbs().maxCoeff() >= 1.5);
}

TEST_CASE("the neighbours that TetGen tells are those that the cells have") {
    FacetComplex complex;
    add_box(complex, {-2, -2, -2}, {2, 2, 2}, outside, 0);
    add_box(complex, {-1.5, -1.5, -1.5}, {-0.5, -0.5, -0.5}, 0, 1);
    add_box(complex, {0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}, 0, outside);
    ComplexMesh mesh = tetrahedralize(quartered(complex), std::vector{1.0, 0.5});
    const auto told = linked_cells(mesh);
    const auto found = volmesh::TetMesh::from_cells(mesh.points, mesh.cells);
    REQUIRE(told.size() == found.n_cells());
    for (std::uint32_t hf = 0; hf < found.n_halffaces(); ++hf)
        CHECK(told[hf / 4].neighbors[hf % 4] ==
              found.opposite_halfface_handle(volmesh::HalffaceHandle(hf)).idx());
    std::swap(mesh.neighbors.front(), mesh.neighbors.back());
    CHECK_THROWS_AS(linked_cells(mesh), InputError);
}

TEST_CASE("a large mesh is numbered along a curve, but for the surface's vertices") {
    FacetComplex box;
    add_box(box, {0, 0, 0}, {1, 1, 1}, outside, 0);
    for (int i = 0; i < 5; ++i) box = quartered(box);
    const ComplexMesh mesh = tetrahedralize(box, std::array{0.05});
    REQUIRE(mesh.cells.size() > 100'000);
    CHECK(std::ranges::equal(box.points, std::span(mesh.points).first(box.points.size())));
    CHECK(volume_of(mesh, 0) == doctest::Approx(1).epsilon(1e-12));
    for (std::size_t f = 0; f < mesh.facets.size(); ++f)
        REQUIRE(std::ranges::is_permutation(mesh.facets[f], box.facets[mesh.parents[f]].vertices));
    const auto told = linked_cells(mesh);
    const auto found = volmesh::TetMesh::from_cells(mesh.points, mesh.cells);
    CHECK(volmesh::validate(found).ok());
    std::size_t wrong = 0;
    double step = 0;
    for (std::uint32_t hf = 0; hf < found.n_halffaces(); ++hf) {
        const auto beyond = found.opposite_halfface_handle(volmesh::HalffaceHandle(hf));
        wrong += told[hf / 4].neighbors[hf % 4] != beyond.idx();
        if (beyond.is_valid()) step += std::abs(double(hf / 4) - beyond.idx() / 4) / found.n_halffaces();
    }
    CHECK(wrong == 0);
    // At random the mean step to a neighbour would be a third of all cells.
    CHECK(step < static_cast<double>(found.n_cells()) / 40);
}

TEST_CASE("a surface that does not close is told") {
    FacetComplex box;
    add_box(box, {0, 0, 0}, {1, 1, 1}, outside, 0);
    box.facets.pop_back();
    const std::string told =
        message_of([&] { tetrahedralize(box, std::array{0.5}, {.name = "the open box"}); });
    MESSAGE(told);
    CHECK(has(told, "the open box"));
}

TEST_CASE("a surface that crosses itself is told, with TetGen's reason") {
    FacetComplex boxes;
    add_box(boxes, {0, 0, 0}, {1, 1, 1}, outside, 0);
    add_box(boxes, {0.3, 0.4, 0.5}, {1.3, 1.4, 1.5}, outside, 1);
    const std::string told = message_of([&] { tetrahedralize(boxes, std::array{0.5, 0.5}); });
    MESSAGE(told);
    CHECK(has(told, "crosses itself"));
}

TEST_CASE("a broken worker is told") {
    FacetComplex box;
    add_box(box, {0, 0, 0}, {1, 1, 1}, outside, 0);
    const auto mesh = [&] { tetrahedralize(box, std::array{0.5}, {.time_limit = 0.05}); };
    SUBCASE("that fails") {
        const OtherWorker worker("/bin/false");
        CHECK(has(message_of(mesh), "status 1"));
    }
    SUBCASE("that does nothing") {
        const OtherWorker worker("/bin/true");
        CHECK(has(message_of(mesh), "incomplete"));
    }
    SUBCASE("that does not exist") {
        const OtherWorker worker("/no/such/program");
        CHECK(has(message_of(mesh), "/no/such/program"));
    }
    SUBCASE("that hangs") {
        const Script script("sleep 1000");
        const OtherWorker worker(script.path());
        const auto start = std::chrono::steady_clock::now();
        CHECK(has(message_of(mesh), "no answer within"));
        CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(20));
    }
    SUBCASE("that closes its output and hangs") {
        const Script script("exec 3>&-; exec sleep 1000");
        const OtherWorker worker(script.path());
        CHECK(has(message_of(mesh), "no answer within"));
    }
    SUBCASE("that crashes") {
        const Script script("kill -SEGV $$");
        const OtherWorker worker(script.path());
        CHECK(has(message_of(mesh), "crashed"));
    }
    SUBCASE("that answers nonsense") {
        const Script script("head -c 1000 /dev/zero >&3");
        const OtherWorker worker(script.path());
        CHECK(has(message_of(mesh), "dropped points"));
    }
}

TEST_CASE("several meshes are made at once") {
    FacetComplex box;
    add_box(box, {0, 0, 0}, {1, 1, 1}, outside, 0);
    box = quartered(quartered(quartered(box)));
    const ComplexMesh alone = tetrahedralize(box, std::array{0.1});
    std::array<ComplexMesh, 4> meshes;
    std::vector<std::jthread> threads;
    for (ComplexMesh& mesh : meshes)
        threads.emplace_back([&] { mesh = tetrahedralize(box, std::array{0.1}); });
    threads.clear();
    for (const ComplexMesh& mesh : meshes) {
        CHECK(mesh.cells == alone.cells);
        CHECK(mesh.points == alone.points);
    }
}

}  // namespace
