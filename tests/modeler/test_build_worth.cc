#include <vector>

#include <doctest/doctest.h>

#include "modeler/build.hh"
#include "modeler/build_worth.hh"
#include "modeler/solid.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

namespace {

using namespace maille;
using namespace maille::modeler;
using Marks = std::vector<std::uint8_t>;

Marks marks(const Solid& solid, double size) {
    const Model model = solid.model();
    return worth_meshing(model, std::vector<double>(model.primitives.size(), size));
}

TEST_CASE("a large mesh of which hardly anything is kept is not worth making") {
    // Of a ball of radius 1, what is farther than two sizes from a cavity of radius r, about 1 - (r + 2 s)^3.
    // Nothing is kept of what is taken away.
    CHECK(marks(sphere(1) - sphere(.95), .03) == Marks{0, 0});
    CHECK(marks(sphere(1) - sphere(.5), .03) == Marks{1, 0});
    // Small meshes are always made.
    CHECK(marks(sphere(1) - sphere(.95), .2) == Marks{1, 1});
    // A corner of one box stays; of the other, as much.
    CHECK(marks(box({1, 1, 1}) & box({1, 1, 1}).at({.8, .8, .8}), .02) == Marks{0, 0});
    // Of two solids in one place the first has all.
    CHECK(marks(box({1, 1, 1}) + box({1, 1, 1}), .02) == Marks{1, 0});
}

TEST_CASE("what is not worth a mesh of its own is meshed together with the others") {
    BuildReport report;
    const auto shell = (box({1, 1, 1}) - box({.92, .92, .92}).at({.04, .04, .04})).model();
    const volmesh::TetMesh mesh = build(shell, {.size = .04}, &report);
    CHECK(volmesh::validate(mesh).ok());
    CHECK(volmesh::volume(mesh) == doctest::Approx(1 - .92 * .92 * .92).epsilon(1e-12));
    CHECK(report.kept_cells == 0);
    CHECK(report.warnings.empty());
}

}  // namespace
