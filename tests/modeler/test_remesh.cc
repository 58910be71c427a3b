#include <array>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "modeler/arrange_self_intersection.hh"
#include "modeler/remesh.hh"
#include "modeler/remesh_features.hh"
#include "modeler/remesh_passes.hh"
#include "remesh_samples.hh"

using namespace remesh_samples;
using maille::modeler::remesh;
using maille::modeler::RemeshReport;
namespace remeshing = maille::modeler::remeshing;

namespace {

constexpr double pi = std::numbers::pi;

bool crosses_itself(const Sample& sample) {
    return maille::modeler::find_self_intersection(sample.complex).has_value();
}

/// Remeshes, and checks what must hold of every result.
RemeshReport remesh_well(Sample& sample, double size, std::initializer_list<Region> regions) {
    std::vector<long> euler_before;
    for (const Region r : regions) euler_before.push_back(euler(sample.complex, r));
    const RemeshReport report = remesh(sample.complex, geometry(sample.surfaces, size));
    CHECK_FALSE(report.rolled_back);
    CHECK(report.short_of_surface == 0);
    CHECK(largest_distance(sample) < 1e-12 * size);
    CHECK(report.smallest_angle_after == doctest::Approx(smallest_angle(sample.complex)));
    CHECK_FALSE(crosses_itself(sample));
    std::size_t i = 0;
    for (const Region r : regions) {
        CHECK(is_closed(sample.complex, r));
        CHECK(euler(sample.complex, r) == euler_before[i++]);
    }
    return report;
}

/// How many times smaller the error is at half the size.
double improvement(const std::array<double, 2>& errors) {
    return std::abs(errors[0]) / std::abs(errors[1]);
}

}  // namespace

TEST_CASE("two boxes with terrible triangles come out well, their planes and the interface exact") {
    Sample sample = two_boxes();
    torture(sample, 300, 1);
    CHECK(smallest_angle(sample.complex) < 0.1);
    remesh_well(sample, 0.25, {0, 1});
    CHECK(smallest_angle(sample.complex) > 20);
    CHECK(std::abs(volume(sample.complex, 0) - 1) < 1e-12);
    CHECK(std::abs(volume(sample.complex, 1) - 1) < 1e-12);
    for (const std::uint32_t s : {0U, 1U, 2U, 3U}) CHECK(std::abs(area(sample.complex, s) - 2) < 1e-12);
    for (const std::uint32_t s : {4U, 5U, 6U}) CHECK(std::abs(area(sample.complex, s) - 1) < 1e-12);
    CHECK(std::abs(curve_length(sample.complex, 5, 0) - 1) < 1e-12);
    CHECK(lengths(sample.complex).longest < 0.25 * 1.4 + 1e-12);
}

TEST_CASE("coarse boxes are split to the size") {
    Sample sample = two_boxes();
    const RemeshReport report = remesh_well(sample, 0.1, {0, 1});
    CHECK(report.splits > 1000);
    CHECK(smallest_angle(sample.complex) > 30);
    CHECK(lengths(sample.complex).longest < 0.14 + 1e-12);
    CHECK(lengths(sample.complex).shortest > 0.05);
}

TEST_CASE("a ball with terrible triangles: good ones after, and its volume of second order") {
    std::array<double, 2> errors{};
    for (std::size_t i = 0; i < 2; ++i) {
        Sample sample = ball(8);
        torture(sample, 300, 2);
        CHECK(smallest_angle(sample.complex) < 1);
        const double size = i == 0 ? 0.3 : 0.15;
        remesh_well(sample, size, {0});
        CHECK(smallest_angle(sample.complex) > 29);
        errors[i] = volume(sample.complex, 0) - 4 * pi / 3;
        CHECK(lengths(sample.complex).longest < 1.45 * size);
    }
    CHECK(improvement(errors) > 3);
    CHECK(improvement(errors) < 5.5);
}

TEST_CASE("a drum keeps its rims on both surfaces") {
    std::array<double, 2> volumes{};
    std::array<double, 2> rims{};
    for (std::size_t i = 0; i < 2; ++i) {
        Sample sample = drum(24, 1.5);
        torture(sample, 300, 3);
        remesh_well(sample, i == 0 ? 0.3 : 0.15, {0});
        CHECK(smallest_angle(sample.complex) > 20);
        volumes[i] = volume(sample.complex, 0) - 1.5 * pi;
        rims[i] = curve_length(sample.complex, 0, 1) - 2 * pi;
    }
    CHECK(improvement(volumes) > 2.5);
    CHECK(improvement(rims) > 2.5);
}

TEST_CASE("a ball cut by a plane: slivers vanish and chord points move onto the circle") {
    const double height = 0.3;
    std::array<std::array<double, 2>, 4> errors{};
    for (std::size_t i = 0; i < 2; ++i) {
        Sample sample = cut_ball(12, height, Vec3(1, 2, 3));
        CHECK(smallest_angle(sample.complex) < 1);
        CHECK(largest_distance(sample) > 1e-3);
        const RemeshReport report = remesh_well(sample, i == 0 ? 0.25 : 0.125, {0, 1});
        CHECK(report.smallest_angle_before < 1);
        CHECK(report.projections > 0);
        CHECK(smallest_angle(sample.complex) > 28);
        const double rim = std::sqrt(1 - height * height);
        const double cap = pi * (1 - height) * (1 - height) * (2 + height) / 3;
        errors[0][i] = volume(sample.complex, 0) - cap;
        errors[1][i] = volume(sample.complex, 1) - (4 * pi / 3 - cap);
        errors[2][i] = curve_length(sample.complex, 0, 1) - 2 * pi * rim;
        errors[3][i] = area(sample.complex, 1) - pi * rim * rim;
    }
    for (const auto& error : errors) {
        CHECK(improvement(error) > 2.5);
        CHECK(std::abs(error[1]) < 0.03);
    }
}

TEST_CASE("a plane that hardly touches the ball") {
    Sample sample = cut_ball(24, 0.995, Vec3(3, -2, 1));
    remesh_well(sample, 0.2, {0, 1});
    CHECK(smallest_angle(sample.complex) > 20);
    const double cap = pi * 0.005 * 0.005 * 2.995 / 3;
    CHECK(volume(sample.complex, 0) == doctest::Approx(cap).epsilon(0.2));
}

TEST_CASE("equal cylinders crossing: four curves meet at either pole") {
    Sample sample = crossed_cylinders(12);
    torture(sample, 400, 4);
    remesh_well(sample, 0.2, {0});
    CHECK(smallest_angle(sample.complex) > 20);
    CHECK(volume(sample.complex, 0) == doctest::Approx(16.0 / 3).epsilon(0.02));
    // Two ellipses of half axes 1 and sqrt(2): 4 sqrt(2) E(1/sqrt(2)) each.
    const double ellipse = 4 * std::sqrt(2) * std::comp_ellint_2(std::sqrt(0.5));
    CHECK(curve_length(sample.complex, 0, 1) == doctest::Approx(2 * ellipse).epsilon(0.01));
    for (const double pole : {-1.0, 1.0})
        CHECK(std::ranges::any_of(sample.complex.points,
                                  [&](const Vec3& p) { return (p - Vec3(0, 0, pole)).norm() < 1e-12; }));
}

/// So many vertices are short of their surfaces before it, and none after.
void clear_ways_of(Sample& sample, std::size_t n_short) {
    const RemeshGeometry shape = geometry(sample.surfaces, 0.5);
    const maille::modeler::RemeshOptions options;
    remeshing::Session session{remeshing::make_net(sample.complex, shape), shape, options};
    remeshing::project_vertices(session);
    CHECK(remeshing::count_short_of_surface(session) == n_short);
    remeshing::clear_ways(session);
    CHECK(remeshing::count_short_of_surface(session) == 0);
    sample.complex = remeshing::make_complex(session.net);
}

TEST_CASE("vertices give way to those that have to reach a surface behind them") {
    // A box with a ring of vertices around it, nearer to its end than the plane which that is to lie in.
    const double ring = 0.1, deep = 0.15;
    Builder b;
    for (const auto& [x, y] : {std::pair(0.0, ring), std::pair(ring, 1.0)}) {
        b.quad({x, 0, 0}, {x, 1, 0}, {y, 1, 0}, {y, 0, 0}, 0, outside, 0);
        b.quad({x, 0, 1}, {y, 0, 1}, {y, 1, 1}, {x, 1, 1}, 1, outside, 0);
        b.quad({x, 0, 0}, {y, 0, 0}, {y, 0, 1}, {x, 0, 1}, 2, outside, 0);
        b.quad({x, 1, 0}, {x, 1, 1}, {y, 1, 1}, {y, 1, 0}, 3, outside, 0);
    }
    b.quad({0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}, 4, outside, 0);
    b.quad({1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}, 5, outside, 0);
    Sample sample{b.complex,
                  {plane({0, 0, 0}, -Vec3::UnitZ()), plane({0, 0, 1}, Vec3::UnitZ()),
                   plane({0, 0, 0}, -Vec3::UnitY()), plane({0, 1, 0}, Vec3::UnitY()),
                   plane({deep, 0, 0}, -Vec3::UnitX()), plane({1, 0, 0}, Vec3::UnitX())}};
    clear_ways_of(sample, 4);
    CHECK(largest_distance(sample) < 1e-12);
    CHECK(is_closed(sample.complex, 0));
    CHECK_FALSE(crosses_itself(sample));
    CHECK(std::abs(volume(sample.complex, 0) - (1 - deep)) < 1e-12);
}

TEST_CASE("a strip that true surfaces leave no room for is closed") {
    // Two boxes with tops in one plane, but the middle of the second one's edge is too low.
    const Vec3 a(0, 0, 1), b(1, 0, 1), middle(0.5, 0, 1), low(0.5, 0, 0.9);
    Builder builder;
    builder.quad({0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}, 0, outside, 0);
    builder.triangle(a, middle, {0, 1, 1}, 1, outside, 0);
    builder.triangle(middle, {1, 1, 1}, {0, 1, 1}, 1, outside, 0);
    builder.triangle(middle, b, {1, 1, 1}, 1, outside, 0);
    builder.quad({0, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 1, 0}, 3, outside, 0);
    builder.quad({0, 0, 0}, a, {0, 1, 1}, {0, 1, 0}, 4, outside, 0);
    builder.quad({1, 0, 0}, {1, 1, 0}, {1, 1, 1}, b, 5, outside, 0);
    builder.triangle({0, 0, 0}, {1, 0, 0}, low, 2, 1, 0);
    builder.triangle({1, 0, 0}, b, low, 2, 1, 0);
    builder.triangle({0, 0, 0}, low, a, 2, 1, 0);
    builder.triangle(a, low, middle, 2, outside, 0);
    builder.triangle(low, b, middle, 2, outside, 0);
    builder.quad({0, -1, 0}, {0, 0, 0}, {1, 0, 0}, {1, -1, 0}, 0, outside, 1);
    builder.triangle({0, -1, 1}, {1, -1, 1}, low, 6, outside, 1);
    builder.triangle({1, -1, 1}, b, low, 6, outside, 1);
    builder.triangle({0, -1, 1}, low, a, 6, outside, 1);
    builder.quad({0, -1, 0}, {1, -1, 0}, {1, -1, 1}, {0, -1, 1}, 7, outside, 1);
    builder.quad({0, -1, 0}, {0, -1, 1}, a, {0, 0, 0}, 4, outside, 1);
    builder.quad({1, -1, 0}, {1, 0, 0}, b, {1, -1, 1}, 5, outside, 1);
    Sample sample{
        builder.complex,
        {plane({0, 0, 0}, -Vec3::UnitZ()), plane({0, 0, 1}, Vec3::UnitZ()), plane({0, 0, 0}, -Vec3::UnitY()),
         plane({0, 1, 0}, Vec3::UnitY()), plane({0, 0, 0}, -Vec3::UnitX()), plane({1, 0, 0}, Vec3::UnitX()),
         plane({0, 0, 1}, Vec3::UnitZ()), plane({0, -1, 0}, -Vec3::UnitY())}};
    const std::size_t before = sample.complex.points.size();
    clear_ways_of(sample, 1);
    CHECK(sample.complex.points.size() == before - 1);
    CHECK(largest_distance(sample) < 1e-12);
    for (const Region region : {0, 1}) {
        CHECK(is_closed(sample.complex, region));
        CHECK(volume(sample.complex, region) == doctest::Approx(1).epsilon(1e-12));
    }
    CHECK_FALSE(crosses_itself(sample));
    for (const Facet& facet : sample.complex.facets)
        CHECK((facet.surface != 2 || std::min(facet.front, facet.back) != outside));
}

TEST_CASE("frozen facets stay bit by bit") {
    Sample sample = cut_ball(12, 0.3, Vec3(1, 2, 3));
    for (Facet& f : sample.complex.facets) f.frozen = f.back == 1 && f.surface == 0;
    using Key = std::array<std::array<double, 3>, 3>;
    const auto frozen = [](const FacetComplex& complex) {
        std::vector<Key> keys;
        for (const Facet& f : complex.facets) {
            if (!f.frozen) continue;
            Key key;
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3& p = complex.points[f.vertices[i]];
                key[i] = {p.x(), p.y(), p.z()};
            }
            keys.push_back(key);
        }
        return keys;
    };
    const auto before = frozen(sample.complex);
    const double volume_before = volume(sample.complex, 1);
    REQUIRE(before.size() > 100);
    const RemeshReport report = remesh(sample.complex, geometry(sample.surfaces, 0.25));
    CHECK(report.collapses > 10);
    CHECK(frozen(sample.complex) == before);
    CHECK(is_closed(sample.complex, 0));
    CHECK(is_closed(sample.complex, 1));
    CHECK_FALSE(crosses_itself(sample));
    CHECK(volume(sample.complex, 1) == doctest::Approx(volume_before).epsilon(1e-3));
}

TEST_CASE("the same input gives the same bytes") {
    const auto run = [] {
        Sample sample = drum(16, 1);
        torture(sample, 200, 5);
        remesh(sample.complex, geometry(sample.surfaces, 0.2));
        return sample.complex;
    };
    const FacetComplex one = run();
    const FacetComplex other = run();
    REQUIRE(one.points.size() == other.points.size());
    CHECK(one.points == other.points);
    CHECK(std::ranges::equal(one.facets, other.facets, {}, &Facet::vertices, &Facet::vertices));
}

TEST_CASE("nothing to do, and nothing at all") {
    FacetComplex empty;
    CHECK(remesh(empty, geometry({}, 1)).collapses == 0);
    Sample sample = two_boxes();
    remesh(sample.complex, geometry(sample.surfaces, 0.25));
    const FacetComplex before = sample.complex;
    remesh(sample.complex, geometry(sample.surfaces, 0.25));
    CHECK(before.points == sample.complex.points);
    CHECK(before.facets.size() == sample.complex.facets.size());
}
