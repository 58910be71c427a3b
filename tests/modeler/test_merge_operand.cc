#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "modeler/merge_operand.hh"
#include "modeler/merge_planes.hh"
#include "modeler/merge_regions.hh"
#include "modeler/merge_verify.hh"
#include "tests/support/kuhn.hh"
#include "volmesh/error.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

namespace {

using namespace maille;
using namespace maille::modeler;
using Eigen::Vector3d;
using volmesh::CellHandle;
using volmesh::HalffaceHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

TetMesh block(int n, const Vector3d& low, double size) {
    TetMesh mesh = test::kuhn_cube(n);
    for (const VertexHandle v : mesh.vertices()) mesh.set_point(v, low + size * mesh.point(v));
    return mesh;
}

MeshRegions three_blocks(Operation operation) {
    const std::vector<TetMesh> meshes{block(6, {0, 0, 0}, 1), block(10, {.63, .52, .57}, 1.3),
                                      block(5, {1, 0, 0}, .5)};
    CsgTree tree{operation, 0, {}};
    for (std::uint32_t i = 0; i < meshes.size(); ++i) tree.children.push_back({Operation::leaf, i, {}});
    return take_apart(meshes, tree, 0);
}

RemeshGeometry geometry_of(const MeshRegions& regions) {
    return {.project =
                [&](std::span<const std::uint32_t> surfaces, const Vector3d& p) {
                    std::vector<Plane> planes;
                    for (const std::uint32_t surface : surfaces)
                        planes.push_back(regions.surfaces[surface].plane);
                    return nearest_on_planes(planes, p);
                },
            .normal = [&](std::uint32_t surface,
                          const Vector3d&) { return regions.surfaces[surface].plane.normal; },
            .planar = [](std::uint32_t) { return true; },
            .size = [](const Vector3d&, Region, Region) { return .15; }};
}

Merged merged(MeshRegions& regions, bool may_take_mesh) {
    std::vector<std::string> warnings;
    Merged result = merge_operands(regions.operands, regions.tree, geometry_of(regions),
                                   static_cast<std::uint32_t>(regions.surfaces.size()),
                                   {.may_take_mesh = may_take_mesh}, warnings);
    for (const std::string& warning : warnings) FAIL(warning);
    return result;
}

double volume_of(const Merged& merged, std::uint32_t region) {
    double sum = 0;
    for (const CellHandle c : merged.mesh.cells())
        if (merged.region(c) == region) sum += volmesh::volume(merged.mesh, c);
    return sum;
}

}  // namespace

TEST_CASE("kept cells and vertices are those of the operands, bit by bit, whether a mesh is taken or not") {
    for (const Operation operation : {Operation::join, Operation::difference, Operation::fragment}) {
        const MeshRegions original = three_blocks(operation);
        MeshRegions copied = original, taken = original;
        const Merged result = merged(copied, false), same = merged(taken, true);
        const TetMesh& mesh = result.mesh;
        REQUIRE(volmesh::validate(mesh).ok());
        CHECK(std::ranges::equal(mesh.points(), same.mesh.points()));
        CHECK(std::ranges::equal(mesh.cell_vertex_indices(), same.mesh.cell_vertex_indices()));
        CHECK(result.regions_of_new == same.regions_of_new);

        const std::uint32_t base = result.kept_cells.base;
        CHECK(base == (operation == Operation::difference ? 0U : 1U));
        for (std::uint32_t i = 0; i < 3; ++i) {
            CHECK(copied.operands[i].mesh.n_cells() == original.operands[i].mesh.n_cells());
            CHECK(taken.operands[i].mesh.n_cells() == (i == base ? 0 : original.operands[i].mesh.n_cells()));
        }

        const std::vector<Origin> cells = result.kept_cells.origins(),
                                  vertices = result.kept_vertices.origins();
        REQUIRE(cells.size() == result.kept_cells.size());
        REQUIRE(vertices.size() == result.kept_vertices.size());
        CHECK(cells.size() + result.regions_of_new.size() == mesh.n_cells());
        for (std::uint32_t c = 0; c < cells.size(); ++c) {
            const TetMesh& from = original.operands[cells[c].operand].mesh;
            REQUIRE(mesh.cell_points(CellHandle(c)) == from.cell_points(CellHandle(cells[c].index)));
            REQUIRE(result.region(CellHandle(c)) == cells[c].operand);
        }
        for (std::uint32_t v = 0; v < vertices.size(); ++v)
            REQUIRE(mesh.point(VertexHandle(v)) ==
                    original.operands[vertices[v].operand].mesh.point(VertexHandle(vertices[v].index)));
        const bool keeps_others = operation != Operation::difference;
        CHECK((cells.back().operand != base) == keeps_others);

        // Where blocks overlap, the first has the place.
        const double both = .37 * .48 * .43, cut = operation == Operation::difference ? both : 0;
        CHECK(volume_of(result, 0) == doctest::Approx(1 - cut).epsilon(1e-12));
        if (keeps_others) CHECK(volume_of(result, 1) == doctest::Approx(2.197 - both).epsilon(1e-12));
        if (keeps_others) CHECK(volume_of(result, 2) == doctest::Approx(.125).epsilon(1e-12));
    }
}

TEST_CASE("where nothing is kept, no mesh is taken") {
    MeshRegions regions = three_blocks(Operation::join);
    std::vector<std::string> warnings;
    const Merged all_new = merge_operands(regions.operands, regions.tree, geometry_of(regions),
                                          static_cast<std::uint32_t>(regions.surfaces.size()),
                                          {.keep_cells = false, .may_take_mesh = true}, warnings);
    CHECK(all_new.kept_cells.size() == 0);
    CHECK(all_new.kept_vertices.size() == 0);
    CHECK(all_new.regions_of_new.size() == all_new.mesh.n_cells());
    for (const Operand& operand : regions.operands) CHECK(operand.mesh.n_cells() > 0);
    CHECK(volmesh::validate(all_new.mesh).ok());
}

TEST_CASE("a merged mesh with wrong names or wrong volumes is not accepted") {
    MeshRegions regions = three_blocks(Operation::fragment);
    const Merged good = merged(regions, false);
    std::vector<HalffaceHandle> seams;
    for (std::uint32_t hf = 0; hf < 4 * good.kept_cells.size(); ++hf) {
        const HalffaceHandle beyond = good.mesh.opposite_halfface_handle(HalffaceHandle(hf));
        if (!beyond.is_valid() || TetMesh::incident_cell(beyond).idx() >= good.kept_cells.size() ||
            good.region(TetMesh::incident_cell(beyond)) !=
                good.region(TetMesh::incident_cell(HalffaceHandle(hf))))
            seams.emplace_back(hf);
    }
    CHECK_NOTHROW(verify(good, seams));

    Merged unnamed = good;
    unnamed.faces.erase(unnamed.faces.begin() + 7);
    CHECK_THROWS_AS(verify(unnamed, seams), InputError);

    Merged crossed = good;
    const CellHandle last(good.mesh.n_cells() - 1);
    for (int k = 0; k < 4; ++k) {
        const HalffaceHandle face = TetMesh::halfface(last, k),
                             other = good.mesh.opposite_halfface_handle(face);
        if (other.is_valid() && good.region(TetMesh::incident_cell(other)) == good.region(last)) {
            crossed.faces.push_back({std::min(face, other), 0});
            break;
        }
    }
    REQUIRE(crossed.faces.size() == good.faces.size() + 1);
    std::ranges::sort(crossed.faces, {}, &InterfaceFace::face);
    CHECK_THROWS_AS(verify(crossed, seams), InputError);

    Merged relabelled = good;
    relabelled.regions_of_new.back() = (relabelled.regions_of_new.back() + 1) % 3;
    CHECK_THROWS_AS(verify(relabelled, seams), InputError);

    // Without the seams the surface of what is new is not whole.
    CHECK_THROWS_AS(verify(good, {}), InputError);
}
