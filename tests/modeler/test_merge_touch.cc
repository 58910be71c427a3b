#include <algorithm>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include "modeler/arrange.hh"
#include "modeler/closed_surface.hh"
#include "modeler/merge_contact.hh"
#include "modeler/merge_touch.hh"
#include "modeler/solid.hh"
#include "modeler/tessellate.hh"
#include "modeler/tetrahedralize.hh"

namespace {

using namespace maille;
using namespace maille::modeler;
using volmesh::CellHandle;
using volmesh::HalffaceHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

struct Scene {
    std::vector<Operand> operands;
    FacetComplex interface;

    Scene(const Solid& solid, double size) {
        const Model model = solid.model();
        std::vector<ClosedSurface> surfaces;
        std::uint32_t first = 0;
        for (const Primitive& primitive : model.primitives) {
            const volmesh::TriMesh surface = tessellate(primitive, size);
            surfaces.push_back(closed_surface(surface, first));
            operands.push_back({primitive.name, size, surfaces.back(), tetrahedralize(surface, size)});
            first += static_cast<std::uint32_t>(primitive.shape->faces().size());
        }
        interface = arrange(surfaces, model.tree).complex;
    }
};

std::vector<std::uint8_t> touched_by_definition(const Scene& scene, const TetMesh& mesh) {
    const InterfaceTable table(scene.interface);
    std::vector<std::uint8_t> is_touched(mesh.n_cells()), is_own(scene.interface.facets.size());
    for (const HalffaceHandle face : mesh.boundary_halffaces()) {
        const auto facet = table.facet(face_points(mesh, face));
        (facet ? is_own[*facet] : is_touched[TetMesh::incident_cell(face).idx()]) = 1;
    }
    for (const CellHandle c : mesh.cells())
        for (std::uint32_t f = 0; f < is_own.size() && !is_touched[c.idx()]; ++f)
            is_touched[c.idx()] =
                !is_own[f] && may_touch(mesh.cell_points(c), facet_points(scene.interface, f), 1e-8);
    return is_touched;
}

void check(const Solid& solid, double size) {
    const Scene scene(solid, size);
    std::vector<ClosedSurface> surfaces;
    for (const Operand& operand : scene.operands) surfaces.push_back(operand.surface);
    const SolidClassifier classifier(surfaces);
    const InterfaceTable table(scene.interface);
    const TouchFinder finder(scene.operands, classifier, scene.interface, table);
    for (std::uint32_t i = 0; i < scene.operands.size(); ++i) {
        CAPTURE(scene.operands[i].name);
        const TetMesh& mesh = scene.operands[i].mesh;
        const std::vector<std::uint8_t> expected = touched_by_definition(scene, mesh);
        const TouchedCells found = finder.find(i);

        std::vector<std::uint8_t> is_found(mesh.n_cells()), is_near(mesh.n_cells()),
            at_touched(mesh.n_vertices());
        for (const CellHandle c : found.cells) ++is_found[c.idx()];
        for (const CellHandle c : found.near) ++is_near[c.idx()];
        CHECK(is_found == expected);
        for (const CellHandle c : found.cells)
            for (const VertexHandle v : mesh.cell_vertices(c)) at_touched[v.idx()] = 1;
        CHECK(found.vertices == at_touched);
        CHECK(std::ranges::all_of(mesh.cells(), [&](CellHandle c) {
            return is_near[c.idx()] == std::ranges::any_of(mesh.cell_vertices(c), [&](VertexHandle v) {
                       return at_touched[v.idx()] == 1;
                   });
        }));
    }
}

}  // namespace

TEST_CASE("touched cells: where a surface goes through the mesh") {
    check(box({2, 2, 2}) - cylinder(4, .5).at({1, 1, -1}), .35);
    check(sphere(1) | sphere(1).at({1, .2, .1}), .35);
}

TEST_CASE("touched cells: where surfaces lie inside the mesh as a whole, or outside, or in its hole") {
    const Solid small = sphere(.12);
    const Solid row =
        small.at({1, 0, 0}) | small.at({-.7, .7, .1}) | small.at({0, 0, 0}) | small.at({3, 0, 0});
    check(torus(1, .35) | row, .2);
    check((torus(1, .35) - small.at({0, -1, 0})) | small.at({0, 1, 0}), .2);
    // One in another in a third.
    check(sphere(.3).at({.1, 0, 0}) | sphere(.6) | box({2, 2, 2}, true), .3);
}

TEST_CASE("touched cells: where surfaces coincide") {
    check(box({1, 1, 1}) | box({1, 1, 1}).at({1, 0, 0}), .3);
    check(box({1, 1, 1}) | box({1, .5, 1}).at({1, .3, 0}), .3);
    check(box({1, 1, 1}) - box({1, 1, 1}).at({.5, .5, .5}), .3);
}
