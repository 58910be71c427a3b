#include <algorithm>
#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include "modeler/build.hh"
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

/// With half the size, errors that the flat facets make are a quarter as large; some allowance for the
/// meshes' whims.
void check_second_order(const std::string& name, double factor) {
    const Case c = find(name);
    CAPTURE(name);
    const double size = c.size * factor;
    const auto coarse = mesh_of(c, size);
    const auto fine = mesh_of(c, size / 2);
    for (const auto* mesh : {&coarse, &fine}) {
        const auto validation = volmesh::validate(*mesh);
        CHECK_MESSAGE(validation.ok(), (validation.ok() ? "" : validation.errors.front()));
    }
    const Errors before = errors(c, coarse);
    const Errors now = errors(c, fine);
    CAPTURE(now.worst_set_name);
    CHECK(now.volume < before.volume / 2.5);
    CHECK(now.area < before.area / 2.5);
    CHECK(now.worst_set < before.worst_set / 2.5);
    CHECK(now.volume < 0.02);
    CHECK(now.worst_set < 0.03);
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

TEST_CASE("a sphere converges") {
    check_second_order("sphere", 1);
}
TEST_CASE("a cylinder converges") {
    check_second_order("cylinder", 1);
}
TEST_CASE("a torus converges") {
    check_second_order("torus", 1);
}
TEST_CASE("two cylinders' intersection converges") {
    check_second_order("bicylinder", 1);
}
TEST_CASE("a lens converges") {
    check_second_order("lens", 1);
}
TEST_CASE("a napkin ring converges") {
    check_second_order("napkin_ring", 0.5);
}
TEST_CASE("stacked boxes are exact") {
    check_exact("stacked_boxes", 0.8);
}

TEST_CASE("the cases' parts add up to their wholes") {
    for (const char* name : {"cylinder", "cone", "bicylinder", "lens", "napkin_ring", "die", "tee"}) {
        CAPTURE(name);
        const Case c = find(name);
        double sum = 0;
        for (const auto& [set, area] : c.sets) sum += area;
        CHECK(sum == doctest::Approx(c.area).epsilon(1e-12));
    }
    const Case boxes = find("stacked_boxes");
    CHECK(boxes.sets.at("slab") + boxes.sets.at("block") + boxes.sets.at("kerb") == boxes.volume);
}

TEST_CASE("volumes that are integrals agree with counting points") {
    // Random points in the model's box, each asked of the primitives themselves.
    for (const char* name : {"tee", "torus_with_hole", "die", "bicylinder"}) {
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
