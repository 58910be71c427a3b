#include <algorithm>
#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include "quality/improve.hh"
#include "quality/report.hh"
#include "tests/support/kuhn.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

using namespace maille::quality;
using namespace maille::volmesh;
using maille::test::kuhn_cube;

namespace {

bool is_on_cube(const Point& p) {
    return p.minCoeff() == 0 || p.maxCoeff() == 1;
}

/// A cube whose free vertices are shaken: the inner ones, and where `sides_too` also those within a side, in
/// its plane.
TetMesh shaken_cube(int n, bool sides_too, unsigned seed) {
    TetMesh mesh = kuhn_cube(n);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shift(-0.3 / n, 0.3 / n);
    for (std::uint32_t i = 0; i < mesh.n_vertices(); ++i) {
        Point p = mesh.point(VertexHandle(i));
        const Point before = p;
        for (double& x : p)
            if (x > 0 && x < 1) x += shift(random);
        if (sides_too || !is_on_cube(before)) mesh.set_point(VertexHandle(i), p);
    }
    return mesh;
}

const std::vector<std::string> side_names{"cube/x-", "cube/x+", "cube/y-", "cube/y+", "cube/z-", "cube/z+"};

void name_sides(TetMesh& mesh) {
    std::vector<SetHandle> sides;
    for (const auto& name : side_names) sides.push_back(mesh.add_set(name, EntityKind::face));
    for (std::uint32_t i = 0; i < mesh.n_halffaces(); ++i) {
        const HalffaceHandle hf(i);
        if (!mesh.is_boundary(hf)) continue;
        const auto v = mesh.halfface_vertices(hf);
        for (int side = 0; side < 6; ++side)
            if (std::ranges::all_of(v, [&](VertexHandle w) { return mesh.point(w)[side / 2] == side % 2; }))
                mesh.insert(sides[side], hf);
    }
}

Projector cube_projector() {
    return {side_names,
            [](std::span<const std::uint32_t> surfaces, const Point& p) -> std::optional<Point> {
                Point q = p;
                for (std::uint32_t s : surfaces) q[s / 2] = s % 2;
                return q;
            },
            std::sqrt(3.0)};
}

double least(const TetMesh& mesh, Measure m) {
    return assess(mesh)[m].min;
}

}  // namespace

TEST_CASE("improvement raises the worst cells and leaves the boundary alone") {
    constexpr unsigned seed = 17;
    CAPTURE(seed);
    TetMesh mesh = shaken_cube(6, false, seed);
    const TetMesh before = mesh;
    const ImproveResult result = improve(mesh, {.max_passes = 20, .good_enough = 0.7});
    MESSAGE(result.passes << " passes, " << result.moves << " moves: " << result.worst_before << " to "
                          << result.worst_after);
    CHECK(result.worst_before == least(before, Measure::gamma));
    CHECK(result.worst_after == least(mesh, Measure::gamma));
    CHECK(result.worst_after > result.worst_before + 0.1);
    CHECK(least(mesh, Measure::sigma) >= least(before, Measure::sigma));
    CHECK(validate(mesh).ok());
    CHECK(volume(mesh) == doctest::Approx(1).epsilon(1e-12));
    for (std::uint32_t i = 0; i < mesh.n_vertices(); ++i)
        if (is_on_cube(before.point(VertexHandle(i))))
            CHECK(mesh.point(VertexHandle(i)) == before.point(VertexHandle(i)));
    CHECK(std::ranges::equal(mesh.cell_vertex_indices(), before.cell_vertex_indices()));
}

TEST_CASE("one pass never lowers the worst cell round any vertex that it moves") {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        CAPTURE(seed);
        TetMesh mesh = shaken_cube(4, false, seed);
        double gamma_so_far = least(mesh, Measure::gamma);
        double sigma_so_far = least(mesh, Measure::sigma);
        for (int pass = 0; pass < 5; ++pass) {
            improve(mesh, {.max_passes = 1, .good_enough = 1});
            const double gamma_now = least(mesh, Measure::gamma);
            const double sigma_now = least(mesh, Measure::sigma);
            CHECK(gamma_now >= gamma_so_far);
            CHECK(sigma_now >= sigma_so_far);
            gamma_so_far = gamma_now;
            sigma_so_far = sigma_now;
        }
    }
}

TEST_CASE("with a projector the boundary moves on its geometric support only") {
    TetMesh mesh = shaken_cube(5, true, 23);
    name_sides(mesh);
    TetMesh fixed = mesh;
    const TetMesh before = mesh;
    const Projector projector = cube_projector();
    improve(mesh, {.max_passes = 20, .good_enough = 0.8}, &projector);
    improve(fixed, {.max_passes = 20, .good_enough = 0.8});
    CHECK(validate(mesh).ok());
    CHECK(least(mesh, Measure::gamma) > least(before, Measure::gamma));
    CHECK(least(mesh, Measure::gamma) > least(fixed, Measure::gamma));
    CHECK(volume(mesh) == doctest::Approx(1).epsilon(1e-12));
    std::size_t slid = 0;
    for (std::uint32_t i = 0; i < mesh.n_vertices(); ++i) {
        const Point& old = before.point(VertexHandle(i));
        const Point& now = mesh.point(VertexHandle(i));
        for (int axis = 0; axis < 3; ++axis)
            if (old[axis] == 0 || old[axis] == 1) CHECK(now[axis] == old[axis]);
        if (is_on_cube(old) && now != old) ++slid;
    }
    CHECK(slid > 0);
    for (const auto& name : side_names)
        CHECK(measure(mesh, mesh.find_set(name, EntityKind::face)) == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("what a set marks stays in its place") {
    TetMesh mesh = shaken_cube(4, true, 31);
    name_sides(mesh);
    const Projector projector = cube_projector();
    // A material, a point load, a wire, and a patch of a side.
    const SetHandle material = mesh.add_set("copper", EntityKind::cell);
    for (std::uint32_t i = 0; i < mesh.n_cells() / 2; ++i) mesh.insert(material, CellHandle(i));
    const SetHandle load = mesh.add_set("load", EntityKind::vertex);
    mesh.insert(load, VertexHandle(31));
    const SetHandle wire = mesh.add_set("wire", EntityKind::edge);
    mesh.insert(wire, CellHandle(330), 2);
    const SetHandle patch = mesh.add_set("patch", EntityKind::face);
    const auto top = mesh.face_members(mesh.find_set("cube/z+", EntityKind::face));
    for (std::size_t i = 0; i < top.size() / 2; ++i) mesh.insert(patch, top[i]);

    const double copper = measure(mesh, material);
    const double patched = measure(mesh, patch);
    const double length = measure(mesh, wire);
    const Point at_load = mesh.point(VertexHandle(31));
    const ImproveResult result = improve(mesh, {.max_passes = 20, .good_enough = 1}, &projector);
    CHECK(result.moves > 0);
    CHECK(measure(mesh, material) == doctest::Approx(copper).epsilon(1e-12));
    CHECK(measure(mesh, patch) == doctest::Approx(patched).epsilon(1e-12));
    CHECK(measure(mesh, wire) == length);
    CHECK(mesh.point(VertexHandle(31)) == at_load);
    CHECK(mesh.set_size(material) == mesh.n_cells() / 2);
}

TEST_CASE("an inverted cell comes right and a good mesh is left as it is") {
    TetMesh mesh = kuhn_cube(3);
    const auto is_good = assess(mesh)[Measure::gamma].min;
    CHECK(improve(mesh, {.max_passes = 20, .good_enough = is_good - 1e-9}).moves == 0);

    VertexHandle inner(0);
    while (mesh.is_boundary(inner)) inner = VertexHandle(inner.idx() + 1);
    mesh.set_point(inner, mesh.point(inner) + Point(0.4, 0.1, 0.05));
    REQUIRE(assess(mesh).inverted > 0);
    improve(mesh);
    CHECK(assess(mesh).inverted == 0);
    CHECK(validate(mesh).ok());
}
