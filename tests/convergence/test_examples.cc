#include <cmath>
#include <numbers>
#include <string>

#include <doctest/doctest.h>

#include "modeler/build.hh"
#include "refine/refine.hh"
#include "volmesh/face_surfaces.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

using namespace maille;

namespace {

/// The greatest distance of a face's vertices from the surface that it lies on.
double distance_from_surfaces(const volmesh::TetMesh& mesh, const volmesh::Projector& projector) {
    double greatest = 0;
    volmesh::FaceSurfaces surfaces_of(mesh, &projector);
    for (const volmesh::HalffaceHandle hf : mesh.halffaces())
        for (const std::uint32_t surface : surfaces_of(hf))
            for (const volmesh::VertexHandle v : mesh.halfface_vertices(hf)) {
                const auto target = projector.project({&surface, 1}, mesh.point(v));
                REQUIRE(target.has_value());
                greatest = std::max(greatest, (*target - mesh.point(v)).norm());
            }
    return greatest;
}

}  // namespace

TEST_CASE("Every example, refined, is valid and lies on its surfaces") {
    struct Example {
        const char* name;
        double size;
        const char* refined;
    };
    for (const auto& [name, size, refined] :
         {Example{"bracket", 4, "0.4+3*(1-exp(-r/10))"}, Example{"tee", 0.1, "0.06"},
          Example{"bicylinder", 0.3, "0.15"}, Example{"die", 0.3, "0.15"}, Example{"lens", 0.3, "0.12"},
          Example{"napkin_ring", 0.2, "0.1"}, Example{"stacked_boxes", 0.6, "0.3"},
          Example{"torus_with_hole", 0.3, "0.15"}, Example{"two_materials", 0.3, "0.15"}}) {
        CAPTURE(std::string(name));
        const auto model = modeler::read_model(std::string(MAILLE_SOURCE_DIR) + "/examples/" + name + ".csg");
        volmesh::TetMesh mesh = modeler::build(model, {.size = size});
        const auto projector = modeler::projector(model);
        const auto result = refine::refine(mesh, refine::parse_size(refined), {}, &projector);
        CHECK(result.ended);
        CHECK(result.projection.short_of_target.empty());
        CHECK(volmesh::validate(mesh).errors == std::vector<std::string>{});
        CHECK(distance_from_surfaces(mesh, projector) <= 1e-10 * projector.model_size);
    }
}

TEST_CASE("Where solids of one name meet, the nodes of the curve lie on both") {
    const auto model = modeler::parse_model(
        "union() { name(\"ball\") sphere(1); name(\"ball\") translate([1,0,0]) sphere(1); }", "two balls");
    const double cap = std::numbers::pi * 0.25 * (3 - 0.5) / 3;  // of height 1/2, of each ball, in the other
    const double volume = 2 * (4 * std::numbers::pi / 3 - cap);
    double error_before = 0;
    for (const double size : {0.3, 0.15}) {
        volmesh::TetMesh mesh = modeler::build(model, {.size = 0.5});
        const auto projector = modeler::projector(model);
        const auto result = refine::refine(mesh, refine::SizeField(size), {}, &projector);
        CHECK(result.projection.short_of_target.empty());
        CHECK(volmesh::validate(mesh).ok());
        CHECK(distance_from_surfaces(mesh, projector) < 1e-10);

        volmesh::FaceSurfaces surfaces_of(mesh, &projector);
        std::vector<volmesh::Surfaces> support(mesh.n_vertices());
        for (const volmesh::HalffaceHandle hf : mesh.boundary_halffaces())
            for (const volmesh::VertexHandle v : mesh.halfface_vertices(hf))
                volmesh::add(support[v.idx()], surfaces_of(hf));
        std::size_t n_on_curve = 0;
        for (const volmesh::VertexHandle v : mesh.vertices()) {
            if (support[v.idx()].size() != 2) continue;
            ++n_on_curve;
            CHECK(std::abs(mesh.point(v).x() - 0.5) < 1e-10);
            CHECK(std::abs(mesh.point(v).tail<2>().norm() - std::sqrt(0.75)) < 1e-10);
        }
        CHECK(static_cast<double>(n_on_curve) > 2 * std::numbers::pi * std::sqrt(0.75) / (1.5 * size));
        const double error = volume - volmesh::volume(mesh);
        CHECK(error > 0);
        if (error_before > 0) CHECK(error_before / error > 3);
        error_before = error;
    }
}
