#include <cmath>

#include <doctest/doctest.h>

#include "examples/adaptive/estimator.hh"
#include "examples/adaptive/loop.hh"
#include "modeler/build.hh"
#include "volmesh/error.hh"
#include "volmesh/measure.hh"

using namespace adaptive;
namespace modeler = maille::modeler;

namespace {

modeler::Model model_of(const Example& example) {
    return modeler::read_model(std::string(MAILLE_SOURCE_DIR) + "/examples/adaptive/" + example.model);
}

std::vector<Step> run_short(const Example& example, bool is_uniform, Eigen::Index most_unknowns) {
    const auto model = model_of(example);
    const auto projector = modeler::projector(model);
    return run(example, modeler::build(model, {.size = 0.6}), projector,
               {.is_uniform = is_uniform, .most_unknowns = most_unknowns});
}

}  // namespace

TEST_CASE("a linear solution is found to rounding, and has no estimated error") {
    const auto linear = [](const Point& p) { return 1 + 2 * p.x() - p.y() + 3 * p.z(); };
    const auto mesh = modeler::build(model_of(fichera()), {.size = 0.5});
    const Problem problem{[](const Point&) { return 0.0; }, {{"block/", linear}, {"notch/", linear}}};
    const Solution solution = solve(mesh, problem);
    for (const auto v : mesh.vertices())
        CHECK(solution.values[v.idx()] == doctest::Approx(linear(v.point())).epsilon(1e-8));
    CHECK(solution.energy == doctest::Approx(14 * maille::volmesh::volume(mesh)).epsilon(1e-8));
    for (const double error : estimate_errors(mesh, solution.values)) CHECK(error < 1e-7);
    CHECK_THROWS_AS(solve(mesh, {problem.source, {{"no/such", linear}}}), maille::InputError);
}

TEST_CASE("the exact solution of the blind hole solves its equation") {
    const Example hole = blind_hole();
    const auto gradient = hole.exact->gradient;
    constexpr double step = 1e-4;
    for (const Point& p :
         {Point(0.7, 0.1, 0.4), Point(0.2, 0.3, -0.5), Point(-0.6, 0.5, -0.1), Point(0.1, 0, -0.2)}) {
        double divergence = 0;
        for (int i = 0; i < 3; ++i) {
            const Point shift = step * Point::Unit(i);
            divergence += (gradient(p + shift) - gradient(p - shift))[i] / (2 * step);
            const double slope =
                (hole.problem.conditions[0].value(p + shift) - hole.problem.conditions[0].value(p - shift)) /
                (2 * step);
            CHECK(slope == doctest::Approx(gradient(p)[i]).epsilon(1e-5));
        }
        CHECK(-divergence == doctest::Approx(hole.problem.source(p)).epsilon(1e-5));
    }
    CHECK(std::abs(hole.problem.conditions[0].value(Point(0.5, 0, 0.7))) < 1e-12);
    CHECK(std::abs(hole.problem.conditions[0].value(Point(0.2, 0.1, 0))) < 1e-12);
}

TEST_CASE("on the blind hole the adaptive loop's error falls faster than the uniform one's") {
    const Example hole = blind_hole();
    const auto adapted = run_short(hole, false, 14'000), uniform = run_short(hole, true, 30'000);
    CHECK(slope(adapted, 3) < -0.3);
    CHECK(slope(uniform, 2) > -0.28);
    CHECK(*adapted.back().error < *uniform.back().error);
    // The estimate is about the error.
    CHECK(adapted.back().estimate / *adapted.back().error == doctest::Approx(1).epsilon(0.25));
}

TEST_CASE("on the Fichera corner it does too, by the extrapolated energy") {
    auto adapted = run_short(fichera(), false, 14'000), uniform = run_short(fichera(), true, 30'000);
    const double energy = extrapolated_energy(adapted, 4);
    set_errors(adapted, energy);
    set_errors(uniform, energy);
    CHECK(slope(adapted, 3) < -0.31);
    CHECK(slope(uniform, 2) > -0.26);
    CHECK(*adapted.back().error < *uniform.back().error);
}
