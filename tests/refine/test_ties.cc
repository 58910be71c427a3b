#include <doctest/doctest.h>

#include "meshes.hh"
#include "refine/refine.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

using namespace maille::refine;
using test::Soup;

namespace {

/// An octahedron cut into four cells round its axis, which is inside, and as long as the edges round its
/// equator.
const Soup octahedron{{{1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {0, 0, -1}, {0, 0, 1}},
                      {{0, 1, 4, 5}, {1, 2, 4, 5}, {2, 3, 4, 5}, {3, 0, 4, 5}}};
constexpr std::uint32_t n_cells_before = 4;
constexpr double just_too_long = 1.3;  // 1.5 times it is less than 2

/// One pass.
TetMesh refined_once(const SizeField& size, Ties ties, Method method = Method::rivara) {
    TetMesh mesh = octahedron.mesh();
    const RefineResult result =
        refine(mesh, size, {.method = method, .ties = ties, .max_iterations = 1, .threads = 1});
    CHECK(result.iterations == 1);
    CHECK(maille::volmesh::validate(mesh).ok());
    return mesh;
}

bool has_axis(const TetMesh& mesh) {
    return !mesh.cells_around(VertexHandle(4), VertexHandle(5)).empty();
}

// The cell at x = -1 alone is to be refined. By age alone its axis comes first, as that has the greatest
// midpoint.
const SizeField near_one_cell([](const Point& p) { return p.x() < -0.4 ? just_too_long : 10.0; });

}  // namespace

TEST_CASE("of several longest edges the one that the rule for ties names is split") {
    for (const Method method : {Method::rivara, Method::bisection}) {
        CAPTURE(int(method));
        // Rivara's algorithm first bisects the cells at x = 1 and y = 1, to which edges of the equator come
        // before the axis; plain bisection splits the axis at once.
        const TetMesh by_order = refined_once(near_one_cell, Ties::order, method);
        CHECK_FALSE(has_axis(by_order));
        CHECK(by_order.n_cells() == (method == Method::rivara ? 12 : 8));

        // Round the axis three cells need no refinement, round the equator's edge there is none.
        const TetMesh by_fewest = refined_once(near_one_cell, Ties::fewest, method);
        CHECK(has_axis(by_fewest));
        CHECK(by_fewest.n_cells() == n_cells_before + 1);

        const TetMesh by_boundary = refined_once(near_one_cell, Ties::boundary, method);
        CHECK(has_axis(by_boundary));
        CHECK(by_boundary.n_cells() == n_cells_before + 1);
    }
}

TEST_CASE("where all cells are to be refined, edges on the boundary come first only if asked") {
    const SizeField everywhere(just_too_long);
    CHECK(has_axis(refined_once(everywhere, Ties::boundary)));
    CHECK(refined_once(everywhere, Ties::boundary).n_cells() == 2 * n_cells_before);
    // The edges at x = 1 and y = 1 have a greater midpoint than the axis, the other two cells split that.
    CHECK_FALSE(has_axis(refined_once(everywhere, Ties::order)));
}

TEST_CASE("meshes full of ties conform under every rule, whatever the numbering and the threads") {
    const SizeField graded([](const Point& p) { return 0.05 + 0.3 * (p - Point(0.3, 0, 0.1)).norm(); });
    const Soup soup = test::kuhn_cube(2);
    for (const Ties ties : {Ties::order, Ties::fewest, Ties::boundary}) {
        CAPTURE(int(ties));
        TetMesh one = soup.mesh(), two = soup.mesh();
        CHECK(refine(one, graded, {.ties = ties, .threads = 1}).ended);
        CHECK(refine(two, graded, {.ties = ties, .threads = 2}).ended);
        CHECK(maille::volmesh::validate(one).ok());
        CHECK(maille::volmesh::volume(one) == doctest::Approx(1));
        CHECK(std::ranges::equal(one.cell_vertex_indices(), two.cell_vertex_indices()));

        Soup shuffled = soup;
        std::mt19937 random(7);
        std::ranges::shuffle(shuffled.tets, random);
        TetMesh other = shuffled.mesh();
        CHECK(refine(other, graded, {.ties = ties}).ended);
        CHECK(test::places(one) == test::places(other));
    }
}
