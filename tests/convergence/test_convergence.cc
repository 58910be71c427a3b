#include <algorithm>
#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include "modeler/build.hh"
#include "refine/refine.hh"
#include "tools/convergence/cases.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

using namespace maille;
using namespace maille::convergence;

namespace {

const std::filesystem::path examples = std::filesystem::path(MAILLE_SOURCE_DIR) / "examples";

Case find(const std::string& name) {
    const auto cases = all_cases();
    const auto found = std::ranges::find(cases, name, &Case::name);
    REQUIRE(found != cases.end());
    return *found;
}

volmesh::TetMesh mesh_of(const Case& c, double size) {
    return modeler::build(model_of(c, examples), {.size = size});
}

/// With half the size, errors that the flat facets make are a quarter as large: of order 2, and no less than
/// this for the meshes' whims.
const double least_gain = std::pow(2, 1.9);

void check_second_order(const Errors& before, const Errors& now) {
    CAPTURE(now.worst_set_name);
    CHECK(now.volume < before.volume / least_gain);
    CHECK(now.area < before.area / least_gain);
    CHECK(now.worst_set < before.worst_set / least_gain);
}

void check_valid(const volmesh::TetMesh& mesh) {
    const auto validation = volmesh::validate(mesh);
    CHECK_MESSAGE(validation.ok(), (validation.ok() ? "" : validation.errors.front()));
}

/// Built at the case's size times the factor and at half that.
void check_second_order(const std::string& name, double factor) {
    const Case c = find(name);
    CAPTURE(name);
    const double size = c.size * factor;
    const auto coarse = mesh_of(c, size);
    const auto fine = mesh_of(c, size / 2);
    check_valid(coarse);
    check_valid(fine);
    check_second_order(errors(c, coarse), errors(c, fine));
    CHECK(errors(c, fine).worst_set < 0.02);
}

/// Refined, with projection, to the case's size times the factor and to half that, from a mesh of twice the
/// size.
void check_refinement(const std::string& name, double factor) {
    const Case c = find(name);
    CAPTURE(name);
    const double size = c.size * factor;
    auto mesh = mesh_of(c, 2 * size);
    const auto projector = modeler::projector(model_of(c, examples));
    const auto errors_at = [&](double wanted) {
        CHECK(refine::refine(mesh, refine::SizeField(wanted), {}, &projector)
                  .projection.short_of_target.empty());
        check_valid(mesh);
        return errors(c, mesh);
    };
    const Errors before = errors_at(size);
    check_second_order(before, errors_at(size / 2));
}

/// All that has a flat boundary is exact at any size.
void check_exact(const std::string& name, double size) {
    const Case c = find(name);
    CAPTURE(name);
    const Errors e = errors(c, mesh_of(c, size));
    CAPTURE(e.worst_set_name);
    CHECK(e.volume < 1e-12);
    CHECK(e.area < 1e-12);
    CHECK(e.worst_set < 1e-12);
}

}  // namespace

TEST_CASE("meshes converge at second order") {
    check_second_order("sphere", 1);
    check_second_order("cylinder", 1);
    check_second_order("cone", 0.5);
    check_second_order("torus", 1);
    check_second_order("bicylinder", 0.5);
    check_second_order("lens", 0.5);
}
TEST_CASE("refined meshes converge at second order") {
    for (const char* name :
         {"sphere", "ellipsoid", "cylinder", "cone", "torus", "bicylinder", "lens", "napkin_ring"})
        check_refinement(name, name == std::string("napkin_ring") ? 0.25 : 0.5);
}
TEST_CASE("stacked boxes are exact") {
    check_exact("stacked_boxes", 0.8);
}

TEST_CASE("the cases' parts add up to their wholes") {
    for (const char* name :
         {"cylinder", "cone", "bicylinder", "lens", "napkin_ring", "die", "tee", "bracket"}) {
        CAPTURE(name);
        const Case c = find(name);
        double sum = 0;
        for (const auto& [set, area] : c.sets)
            if (set.find('/') != std::string::npos && !set.ends_with("/inner")) sum += area;
        CHECK(sum == doctest::Approx(c.area).epsilon(1e-12));
    }
    const Case boxes = find("stacked_boxes");
    CHECK(boxes.sets.at("slab") + boxes.sets.at("block") + boxes.sets.at("kerb") == boxes.volume);
}

TEST_CASE("volumes that are integrals agree with counting points") {
    // Random points in the model's box, each asked of the primitives themselves.
    for (const char* name : {"tee", "torus_with_hole", "die", "bicylinder", "bracket"}) {
        CAPTURE(name);
        const Case c = find(name);
        const modeler::Model model = model_of(c, examples);
        Eigen::AlignedBox3d box;
        for (const auto& primitive : model.primitives) box.extend(primitive.shape->bounding_box());
        constexpr unsigned seed = 7;
        constexpr int n = 1'000'000;
        CAPTURE(seed);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> unit(0, 1);
        int inside = 0;
        for (int i = 0; i < n; ++i) {
            const double x = unit(random), y = unit(random), z = unit(random);
            const modeler::Point p = box.min() + box.sizes().cwiseProduct(Eigen::Vector3d(x, y, z));
            const auto is_inside = [&](std::uint32_t m) { return model.primitives[m].shape->contains(p); };
            inside += modeler::owner(model.tree, is_inside) ? 1 : 0;
        }
        // Five standard deviations of the count.
        const double part = static_cast<double>(inside) / n;
        const double error = 5 * std::sqrt(part * (1 - part) / n) * box.volume();
        CHECK(std::abs(part * box.volume() - c.volume) < error);
    }
}
