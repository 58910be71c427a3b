#include <string>

#include <doctest/doctest.h>

#include "modeler/build.hh"
#include "refine/refine.hh"
#include "volmesh/validate.hh"

using namespace maille;

namespace {

/// The greatest distance of a face set's vertices from the surface that bears its name.
double distance_from_surfaces(const volmesh::TetMesh& mesh, const volmesh::Projector& projector) {
    double greatest = 0;
    for (std::uint32_t surface = 0; surface < projector.surfaces.size(); ++surface) {
        const auto set = mesh.find_set(projector.surfaces[surface], volmesh::EntityKind::face);
        if (!set.is_valid()) continue;
        for (const volmesh::HalffaceHandle hf : mesh.face_members(set))
            for (const volmesh::VertexHandle v : mesh.halfface_vertices(hf)) {
                const auto target = projector.project({&surface, 1}, mesh.point(v));
                REQUIRE(target.has_value());
                greatest = std::max(greatest, (*target - mesh.point(v)).norm());
            }
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
