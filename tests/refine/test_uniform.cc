#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "meshes.hh"
#include "refine/uniform.hh"
#include "volmesh/error.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

using namespace maille::refine;
using maille::volmesh::EntityKind;

namespace {

void check_valid(const TetMesh& mesh) {
    const auto validation = maille::volmesh::validate(mesh);
    if (!validation.ok()) MESSAGE(validation.errors.front());
    CHECK(validation.ok());
}

}  // namespace

TEST_CASE("levels: eight times the cells each, the lineage by place, the same by any number of threads") {
    const TetMesh start = test::kuhn_cube(2).mesh();
    std::vector<TetMesh> meshes;
    for (const int threads : {1, 2, 4}) {
        TetMesh mesh = start;
        int n_told = 0;
        const RefineResult result =
            refine_uniformly(mesh, {.levels = 3, .threads = threads, .progress = [&](const Progress& at) {
                                        CHECK(at.iterations == ++n_told);
                                        CHECK(at.cells == 8 * at.refined);
                                    }});
        CHECK(n_told == 3);
        CHECK(result.ended);
        CHECK(result.iterations == 3);
        CHECK(result.cells == 512 * start.n_cells());
        check_valid(mesh);
        const Lineage& lineage = result.lineage;
        REQUIRE(lineage.cell_ancestors.size() == mesh.n_cells());
        for (const auto c : mesh.cells()) {
            // The centroid lies in the ancestor: it is on the inner side of each of its faces.
            const auto p = mesh.cell_points(c);
            const auto q = start.cell_points(CellHandle(lineage.cell_ancestors[c.idx()]));
            for (const auto& [i, j, k] : maille::volmesh::tet::face_vertices)
                CHECK((q[j] - q[i]).cross(q[k] - q[i]).dot(0.25 * (p[0] + p[1] + p[2] + p[3]) - q[i]) < 0);
        }
        CHECK(lineage.n_vertices_before == start.n_vertices());
        REQUIRE(lineage.vertex_parents.size() == mesh.n_vertices() - start.n_vertices());
        for (std::uint32_t i = 0; i < lineage.vertex_parents.size(); ++i) {
            const auto [a, b] = lineage.vertex_parents[i];
            CHECK(mesh.point(VertexHandle(start.n_vertices() + i)) ==
                  0.5 * mesh.point(VertexHandle(a)) + 0.5 * mesh.point(VertexHandle(b)));
        }
        meshes.push_back(std::move(mesh));
    }
    for (const TetMesh& other : {meshes[1], meshes[2]}) {
        CHECK(std::ranges::equal(meshes[0].cell_vertex_indices(), other.cell_vertex_indices()));
        CHECK(std::ranges::equal(meshes[0].points(), other.points()));
    }
}

TEST_CASE("a ball's surface is followed, at second order") {
    // [-1,1]^3 drawn into a ball: its nodes lie on cubes that became spheres.
    test::Soup soup = test::kuhn_cube(4);
    for (Point& p : soup.points) {
        p = 2 * p - Point::Ones();
        if (p.norm() > 0) p *= p.cwiseAbs().maxCoeff() / p.norm();
    }
    for (auto& t : soup.tets) test::orient(soup.points, t);
    TetMesh mesh = soup.mesh();
    const auto surface = mesh.add_set("ball/surface", EntityKind::face);
    for (const auto hf : mesh.boundary_halffaces()) mesh.insert(surface, maille::volmesh::HalffaceHandle(hf));
    const maille::volmesh::Projector projector{
        {"ball/surface"}, [](auto, const Point& p) { return Point(p.normalized()); }, 2 * std::sqrt(3.0)};
    const double exact = 4 * std::numbers::pi / 3;
    double error = exact - volume(mesh);
    for (int level = 0; level < 3; ++level) {
        const RefineResult result = refine_uniformly(mesh, {}, &projector);
        CHECK(result.projection.short_of_target.empty());
        CHECK(result.projection.moved > 0);
        check_valid(mesh);
        for (const auto hf : mesh.face_members(surface))
            for (const auto v : mesh.halfface_vertices(hf))
                CHECK(mesh.point(v).norm() == doctest::Approx(1).epsilon(1e-12));
        const double finer = exact - volume(mesh);
        CHECK(std::log2(error / finer) > 1.9);
        error = finer;
    }
    TetMesh flat = soup.mesh();
    const double before = volume(flat);
    refine_uniformly(flat, {.levels = 1, .project = false}, &projector);
    CHECK(volume(flat) == doctest::Approx(before));
}

TEST_CASE("what cannot be refined uniformly is refused before anything is done") {
    TetMesh mesh = test::kuhn_cube(1).mesh();
    CHECK_THROWS_AS(refine_uniformly(mesh, {.levels = -1}), maille::InputError);
    CHECK_THROWS_AS(refine_uniformly(mesh, {.levels = 10}), maille::InputError);
    CHECK_THROWS_AS(refine_uniformly(mesh, {.min_shape = 0}), maille::InputError);
    CHECK(mesh.n_cells() == 6);
}
