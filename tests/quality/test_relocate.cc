#include <random>

#include <doctest/doctest.h>

#include "quality/measures.hh"
#include "quality/relocate.hh"
#include "tests/refine/meshes.hh"
#include "volmesh/validate.hh"

using namespace maille::quality;

TEST_CASE("the shape is gamma, and 0 where the tetrahedron is flat or inverted") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(-1, 1);
    for (int i = 0; i < 1000; ++i) {
        std::array<Point, 4> p;
        for (Point& q : p) q = Point(u(random), u(random), u(random));
        const double gamma = maille::quality::gamma(tet_geometry(p[0], p[1], p[2], p[3]));
        CHECK(exact_gamma(p[0], p[1], p[2], p[3]) == doctest::Approx(std::max(gamma, 0.0)).epsilon(1e-9));
    }
    CHECK(exact_gamma({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}) == 0);
}

TEST_CASE("relaxing never makes the worst cell worse") {
    int n_moved = 0;
    for (const unsigned seed : {1U, 2U, 3U}) {
        TetMesh mesh = test::random_cube(4, seed, 0.4).mesh();
        for (std::uint32_t i = 0; i < mesh.n_vertices(); ++i) {
            const VertexHandle v(i);
            const CellList cells = mesh.vc_range(v);
            if (!is_free(mesh, v, cells)) continue;
            const double before = worst_shape(mesh, cells, v, mesh.point(v));
            const bool has_moved = relax(mesh, v, cells);
            const double after = worst_shape(mesh, cells, v, mesh.point(v));
            CHECK(has_moved == (after > before));
            CHECK(after >= before);
            n_moved += has_moved;
        }
    }
    CHECK(n_moved > 20);
}

TEST_CASE("a vertex on the boundary, on an interface or in a set is not free") {
    TetMesh mesh = test::kuhn_cube(4).mesh();
    using maille::volmesh::EntityKind;
    const auto free_count = [&] {
        int n = 0;
        for (const auto v : mesh.vertices()) n += is_free(mesh, VertexHandle(v), v.cells());
        return n;
    };
    CHECK(free_count() == 27);
    const auto left = mesh.add_set("left", EntityKind::cell);
    for (const auto c : mesh.cells()) {
        const auto p = mesh.cell_points(c);
        if ((p[0] + p[1] + p[2] + p[3]).x() < 2) mesh.insert(left, CellHandle(c));
    }
    CHECK(free_count() == 18);
    const auto probe = mesh.add_set("probe", EntityKind::vertex);
    for (const auto v : mesh.vertices())
        if (v.point() == Point(0.25, 0.25, 0.25)) mesh.insert(probe, VertexHandle(v));
    CHECK(free_count() == 17);
    const auto wire = mesh.add_set("wire", EntityKind::edge);
    for (const auto c : mesh.cells())
        for (int e = 0; e < 6; ++e) {
            const auto [i, j] = maille::volmesh::tet::edge_vertices[e];
            const auto p = mesh.cell_points(c);
            if (p[i].y() == 0.75 && p[j].y() == 0.75 && p[i].z() == 0.75 && p[j].z() == 0.75)
                mesh.insert(wire, CellHandle(c), e);
        }
    CHECK(free_count() == 15);
}
