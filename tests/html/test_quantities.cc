#include <cmath>

#include <doctest/doctest.h>

#include "quality/report.hh"
#include "tests/support/kuhn.hh"
#include "tools/html/quantities.hh"

using namespace maille;
using html::Quantity;

namespace {

Quantity quantity(double low, double high, std::size_t bins, double min, double max) {
    return {.name = "q",
            .unit = "",
            .low = low,
            .high = high,
            .best = high,
            .statistics = {.min = min, .mean = 0, .max = max, .histogram = std::vector<std::size_t>(bins)},
            .codes = {}};
}

}  // namespace

TEST_CASE("codes keep a value's bin, its order, and its place in the bin to half a step") {
    for (const Quantity& q : {quantity(0, 1, 20, -0.4, 1), quantity(0, 2, 20, 0.1, 7.5),
                              quantity(0, 180, 36, 0, 180), quantity(0, 6.4, 32, 0.1, 6.283185307179586)}) {
        const std::uint32_t levels = html::levels_of_bin(q);
        std::uint16_t before = 0;
        for (int i = 0; i <= 9973; ++i) {
            const double value = q.statistics.min + (q.statistics.max - q.statistics.min) * i / 9973;
            const std::uint16_t code = html::encode(q, value);
            CHECK(code / levels == quality::bin_of(q.low, q.high, q.n_bins(), value));
            CHECK(code >= before);
            before = code;
            // The outermost bins are stretched to the least and the greatest value.
            const double width = (q.high - q.low) / q.n_bins() +
                                 std::max({0.0, q.low - q.statistics.min, q.statistics.max - q.high});
            CHECK(std::abs(html::decode(q, code) - value) <= 0.51 * width / (levels - 1));
        }
        // What is beyond the range is not cut off.
        if (q.statistics.min < q.low)
            CHECK(html::decode(q, html::encode(q, q.statistics.min)) == q.statistics.min);
        if (q.statistics.max > q.high)
            CHECK(html::decode(q, html::encode(q, q.statistics.max)) == q.statistics.max);
    }
}

TEST_CASE("codes count into the report's histograms") {
    volmesh::TetMesh mesh = test::kuhn_cube(5);
    for (std::uint32_t i = 0; i < mesh.n_vertices(); ++i) {
        const volmesh::Point p = mesh.point(volmesh::VertexHandle(i));
        mesh.set_point(volmesh::VertexHandle(i),
                       p + volmesh::Point(0.2 * p.y() * p.z(), 0.3 * p.x() * p.x(), -0.8 * p.x() * p.z()));
    }
    const quality::WantedSize size = [](const volmesh::Point& p) { return 0.05 + 0.3 * p.x() * p.x(); };
    std::vector<double> errors(mesh.n_cells());
    for (std::size_t i = 0; i < errors.size(); ++i) errors[i] = static_cast<double>(i * i % 101);
    const quality::Report report = quality::assess(mesh, &size, {.errors = errors});
    const auto quantities = html::quantities_of(mesh, report, &size, errors);
    REQUIRE(quantities.size() == quality::measure_infos.size() + 1);
    for (const Quantity& q : quantities) {
        CAPTURE(q.name);
        std::vector<std::size_t> histogram(q.n_bins());
        for (const std::uint16_t code : q.codes) ++histogram[code / html::levels_of_bin(q)];
        CHECK(histogram == q.statistics.histogram);
    }
    CHECK(quantities.back().statistics.max == 100);
    CHECK(html::quantities_of(mesh, quality::assess(mesh), nullptr, {}).size() ==
          quality::measure_infos.size() - 1);
}
