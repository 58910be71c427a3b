#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <doctest/doctest.h>

#include "modeler/build.hh"
#include "tests/modeler/name_checks.hh"
#include "volmesh/error.hh"

namespace {

using namespace maille;
using namespace maille::modeler;

void check_folder(const std::filesystem::path& folder, Facets facets) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const auto extension = entry.path().extension();
        if (extension != ".csg" && extension != ".geo") continue;
        CAPTURE(entry.path());
        const Model model = read_model(entry.path(), facets);
        const auto mesh = build(model);
        double extent = 0;
        for (const auto v : mesh.vertices()) extent = std::max(extent, mesh.point(v).norm());
        const auto figures = test::check_names(mesh, model);
        CHECK(figures.nameless == 0);
        CHECK(figures.ambiguous == 0);
        CHECK(figures.farthest <= 1e-9 * extent);
    }
}

}  // namespace

TEST_CASE("every boundary face of the examples is in the set of one surface, and lies on it") {
    check_folder(MAILLE_SOURCE_DIR "/examples", Facets::automatic);
}

// MAILLE_MODELS names the folder.
TEST_CASE("the same of the models in a folder of one's own" *
          doctest::skip(std::getenv("MAILLE_MODELS") == nullptr)) {
    for (const Facets facets : {Facets::keep, Facets::round})
        check_folder(std::getenv("MAILLE_MODELS"), facets);
}
