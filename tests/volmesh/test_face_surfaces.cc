#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/kuhn.hh"
#include "volmesh/face_surfaces.hh"

using namespace maille::volmesh;

namespace {

/// Planes x = 0, y = 0, x = 1 and, the same once more, x = 1: the first and the last two are called "wall".
Projector walls() {
    return {{"wall", "floor", "wall", "wall"},
            [](std::span<const std::uint32_t> surfaces, const Point& p) -> std::optional<Point> {
                Point q = p;
                for (const std::uint32_t s : surfaces) q[s == 1 ? 1 : 0] = s < 2 ? 0 : 1;
                return q;
            },
            2};
}

TetMesh room() {
    TetMesh mesh = maille::test::kuhn_cube(2);
    const auto wall = mesh.add_set("wall", EntityKind::face);
    const auto floor = mesh.add_set("floor", EntityKind::face);
    for (const HalffaceHandle hf : mesh.boundary_halffaces()) {
        Point sum = Point::Zero();
        for (const VertexHandle v : mesh.halfface_vertices(hf)) sum += mesh.point(v);
        if (sum.x() == 0 || sum.x() == 3) mesh.insert(wall, hf);
        if (sum.y() == 0) mesh.insert(floor, hf);
    }
    return mesh;
}

}  // namespace

TEST_CASE("a face lies on the nearest of the surfaces that bear its set's name") {
    const TetMesh mesh = room();
    const Projector projector = walls();
    FaceSurfaces surfaces_of(mesh, &projector);
    for (const HalffaceHandle hf : mesh.boundary_halffaces()) {
        Point sum = Point::Zero();
        for (const VertexHandle v : mesh.halfface_vertices(hf)) sum += mesh.point(v);
        std::vector<std::uint32_t> expected;
        if (sum.x() == 0) expected = {0};
        if (sum.y() == 0) expected = {1};
        if (sum.x() == 3) expected = {2};
        CHECK(std::ranges::equal(surfaces_of(hf), expected));
    }
}

TEST_CASE("without a projector no face lies on a surface") {
    const TetMesh mesh = room();
    FaceSurfaces surfaces_of(mesh, nullptr);
    for (const HalffaceHandle hf : mesh.halffaces()) CHECK(surfaces_of(hf).empty());
}

TEST_CASE("surfaces are added in order, each once") {
    Surfaces surfaces;
    for (const std::uint32_t s : {5U, 2U, 5U, 1U, 3U}) add(surfaces, Surfaces(1, s));
    CHECK(std::ranges::equal(surfaces, std::vector<std::uint32_t>{1, 2, 3, 5}));
}
