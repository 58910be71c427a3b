#include <fstream>
#include <random>

#include <doctest/doctest.h>

#include "tests/support/kuhn.hh"
#include "tests/support/random_sets.hh"
#include "volmesh/boundary.hh"
#include "volmesh/error.hh"
#include "volmesh/io/mesh_io.hh"
#include "volmesh/measure.hh"

using namespace maille;
using namespace maille::volmesh;

namespace {

/// Volume inside the surface, by the divergence theorem.
double enclosed_volume(const TriMesh& surface) {
    double six_volumes = 0;
    for (auto face : surface.faces()) {
        auto v = surface.cfv_iter(face);
        const Point a = surface.point(*v++);
        const Point b = surface.point(*v++);
        six_volumes += a.dot(b.cross(surface.point(*v)));
    }
    return six_volumes / 6;
}

void require_boundary_of(const TetMesh& mesh, const ExtractedSurface& boundary) {
    REQUIRE(boundary.surface.n_faces() == mesh.n_boundary_faces());
    REQUIRE(boundary.halffaces.size() == mesh.n_boundary_faces());
    REQUIRE(boundary.vertices.size() == boundary.surface.n_vertices());
    for (auto face : boundary.surface.faces()) {
        const auto expected = mesh.halfface_vertices(boundary.halffaces[face.idx()]);
        std::array<VertexHandle, 3> got;
        int i = 0;
        for (auto v : face.vertices_ccw()) got[i++] = boundary.vertices[v.idx()];
        std::ranges::rotate(got, std::ranges::find(got, expected[0]));
        REQUIRE(got == expected);
    }
    for (auto v : boundary.surface.vertices())
        REQUIRE(boundary.surface.point(v) == mesh.point(boundary.vertices[v.idx()]));
    CHECK(enclosed_volume(boundary.surface) == doctest::Approx(volume(mesh)).epsilon(1e-12));
}

bool is_closed(const TriMesh& surface) {
    return std::ranges::none_of(surface.edges(), [](auto edge) { return edge.is_boundary(); });
}

/// Two cells that share the vertices given and are otherwise on opposite sides.
TetMesh two_cells(int n_shared) {
    std::vector<Point> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    std::array<TetMesh::Index, 4> second{0, 1, 2, 3};
    for (int i = n_shared; i < 4; ++i) {
        second[i] = static_cast<TetMesh::Index>(points.size());
        points.push_back(n_shared == 1 ? Point(-points[i]) : Point(points[1] - points[i]));
    }
    if (n_shared == 1) std::swap(second[2], second[3]);
    return TetMesh::from_cells(points, {{0, 1, 2, 3}, second});
}

}  // namespace

TEST_CASE("the boundary of a cube is a closed surface of it") {
    const TetMesh mesh = test::kuhn_cube(3);
    const ExtractedSurface surface = boundary(mesh);
    require_boundary_of(mesh, surface);
    CHECK(is_closed(surface.surface));
    CHECK(surface.surface.n_vertices() == 56);
    CHECK(surface.surface.n_vertices() + surface.surface.n_faces() - surface.surface.n_edges() == 2);
}

TEST_CASE("cells that touch in a vertex or an edge have sheets of their own") {
    for (int n_shared : {1, 2}) {
        CAPTURE(n_shared);
        const TetMesh mesh = two_cells(n_shared);
        REQUIRE(volume(mesh) == doctest::Approx(1.0 / 3));
        const ExtractedSurface surface = boundary(mesh);
        require_boundary_of(mesh, surface);
        CHECK(is_closed(surface.surface));
        CHECK(surface.surface.n_vertices() == 8);
    }
}

TEST_CASE("every face of a boundary with many pinches is in the surface") {
    for (unsigned seed = 1; seed <= 30; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        TetMesh mesh = test::kuhn_cube(4);
        for (TetMesh::Index c = 0; c < mesh.n_cells(); ++c)
            if (random() % 2 == 0) mesh.delete_cell(CellHandle(c));
        require_boundary_of(mesh, boundary(mesh));
    }
}

TEST_CASE("surface files are written") {
    const test::TemporaryFolder folder;
    const TetMesh mesh = test::kuhn_cube(2);
    for (const char* file : {"a.stl", "a.obj", "a.off", "a.ply", "a.STL"}) {
        write_mesh(mesh, folder / file);
        CHECK(std::filesystem::file_size(folder / file) > 500);
        CHECK_THROWS_AS(read_mesh(folder / file), InputError);
    }
    CHECK(std::filesystem::file_size(folder / "a.stl") == 84 + 50 * mesh.n_boundary_faces());
}

TEST_CASE("a set of faces is a surface that turns one way and knows its vertices") {
    TetMesh mesh = test::kuhn_cube(3);
    const auto middle = mesh.add_set("middle", EntityKind::face);  // a plane inside, and a side
    for (auto hf : mesh.halffaces())
        if (std::ranges::all_of(hf.vertices(),
                                [](auto v) { return std::abs(v.point().z() - 1.0 / 3) < 1e-9; }))
            mesh.insert(middle, HalffaceHandle(hf));
    const ExtractedSurface plane = extract_surface(mesh, middle);
    CHECK(plane.surface.n_faces() == 18);
    CHECK(plane.surface.n_vertices() == 16);
    CHECK(plane.surface.n_vertices() + plane.surface.n_faces() - plane.surface.n_edges() == 1);
    double area = 0;
    for (auto f : plane.surface.faces()) {
        const auto expected = mesh.halfface_vertices(plane.halffaces[f.idx()]);
        std::array<VertexHandle, 3> got;
        int i = 0;
        for (auto v : f.vertices_ccw()) got[i++] = plane.vertices[v.idx()];
        std::ranges::rotate(got, std::ranges::find(got, expected[0]));
        CHECK(got == expected);
        const Point a = mesh.point(got[0]);
        area += (mesh.point(got[1]) - a).cross(mesh.point(got[2]) - a).z() / 2;
    }
    CHECK(std::abs(area) == doctest::Approx(1).epsilon(1e-12));  // all faces look the same way

    // All boundary faces: the boundary itself.
    const auto skin = mesh.add_set("skin", EntityKind::face);
    for (auto hf : mesh.boundary_halffaces()) mesh.insert(skin, HalffaceHandle(hf));
    const ExtractedSurface shell = extract_surface(mesh, skin);
    require_boundary_of(mesh, shell);
    CHECK(is_closed(shell.surface));

    // The plane together with the shell: three or four faces meet along the rim, where all sheets are cut.
    for (auto hf : mesh.face_members(middle)) mesh.insert(skin, hf);
    const ExtractedSurface three = extract_surface(mesh, skin);
    CHECK(three.surface.n_faces() == 108 + 18);
    CHECK(three.surface.n_vertices() == 56 + 16 + 12);  // the rim's 12 are there three times
    CHECK_THROWS_AS(extract_surface(mesh, mesh.add_set("cells", EntityKind::cell)), std::invalid_argument);
}

TEST_CASE("any set of faces is a surface, however its faces meet") {
    TetMesh mesh = test::kuhn_cube(2);
    std::mt19937 random(1);
    for (int i = 0; i < 20; ++i) {
        CAPTURE(i);
        const auto any = mesh.add_set("any " + std::to_string(i), EntityKind::face);
        for (auto f : mesh.faces())
            if (random() % 3 == 0) mesh.insert(any, FaceHandle(f));
        const ExtractedSurface surface = extract_surface(mesh, any);
        CHECK(surface.surface.n_faces() == mesh.set_size(any));
        for (auto f : surface.surface.faces()) {
            const auto hf = surface.halffaces[f.idx()];
            CHECK(mesh.contains(any, hf));
            for (auto v : f.vertices())
                CHECK(surface.surface.point(v) == mesh.point(surface.vertices[v.idx()]));
        }
    }
}
