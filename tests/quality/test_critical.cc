#include <algorithm>
#include <random>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "quality/report.hh"
#include "tests/support/kuhn.hh"
#include "volmesh/error.hh"

using namespace maille::quality;
using namespace maille::volmesh;
using maille::test::kuhn_cube;

namespace {

/// Flattened and shaken, so that cells of every quality are there.
TetMesh bad_cube(unsigned seed) {
    TetMesh mesh = kuhn_cube(12);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shift(-0.3 / 12, 0.3 / 12);
    for (std::uint32_t i = 0; i < mesh.n_vertices(); ++i) {
        Point p = mesh.point(VertexHandle(i)) + Point(shift(random), shift(random), shift(random));
        p.z() *= 0.05 + p.x();
        mesh.set_point(VertexHandle(i), p);
    }
    return mesh;
}

std::vector<double> random_errors(const TetMesh& mesh, unsigned seed) {
    std::mt19937 random(seed);
    std::exponential_distribution<double> error(1);
    std::vector<double> errors(mesh.n_cells());
    for (double& e : errors) e = error(random);
    return errors;
}

}  // namespace

TEST_CASE("critical cells are those of bad shape whose error is above the mean") {
    const TetMesh mesh = bad_cube(3);
    const std::vector<double> errors = random_errors(mesh, 4);
    const Report report = assess(mesh, nullptr, {.errors = errors, .n_worst = 25});

    double sum = 0;
    for (double e : errors) sum += e;
    const double mean = sum / static_cast<double>(errors.size());
    std::size_t bad = 0;
    std::vector<std::pair<double, std::uint32_t>> critical;
    for (std::uint32_t i = 0; i < mesh.n_cells(); ++i) {
        const TetGeometry t = cell_geometry(mesh, CellHandle(i));
        const bool is_bad = sigma(t) < 0.2 || (sigma(t) < 0.4 && tau(t) < 0.3);
        if (is_bad) ++bad;
        if (is_bad && errors[i] > mean) critical.emplace_back(-errors[i], i);
    }
    std::sort(critical.begin(), critical.end());
    REQUIRE(critical.size() > 25);
    REQUIRE(bad < mesh.n_cells());

    CHECK(report.badly_shaped == bad);
    REQUIRE(report.critical);
    CHECK(report.critical->cells == critical.size());
    CHECK(report.critical->mean_error == doctest::Approx(mean).epsilon(1e-13));
    REQUIRE(report.critical->worst.size() == 25);
    CHECK(report.worst.size() == 25);
    for (std::size_t k = 0; k < 25; ++k) {
        CHECK(report.critical->worst[k].cell.idx() == critical[k].second);
        CHECK(report.critical->worst[k].error == errors[critical[k].second]);
    }

    const auto json = to_json(report);
    CHECK(json["bad_shape"]["cells"] == bad);
    CHECK(json["critical"]["cells"] == critical.size());
    CHECK(json["critical"]["percent"].get<double>() ==
          doctest::Approx(100.0 * static_cast<double>(critical.size()) / mesh.n_cells()));
    CHECK(json["critical"]["worst"][0]["cell"] == critical[0].second);
    CHECK(json["worst"][0]["error"] == errors[report.worst[0].cell.idx()]);
    CHECK(to_text(report).find(std::to_string(critical.size()) + " of them critical") != std::string::npos);
}

TEST_CASE("equal errors make no cell critical, and without errors nothing is said of them") {
    const TetMesh mesh = bad_cube(5);
    const std::vector<double> errors(mesh.n_cells(), 0.25);
    const Report equal = assess(mesh, nullptr, {.errors = errors});
    CHECK(equal.badly_shaped > 0);
    REQUIRE(equal.critical);
    CHECK(equal.critical->cells == 0);
    const Report none = assess(mesh);
    CHECK(!none.critical);
    CHECK(to_json(none)["critical"].is_null());
    CHECK(to_text(none).find("critical") == std::string::npos);
}

TEST_CASE("errors of deleted cells count for nothing, wrong ones are refused") {
    TetMesh mesh = bad_cube(6);
    std::vector<double> errors = random_errors(mesh, 7);
    errors[11] = 1e9;
    mesh.delete_cell(CellHandle(11));
    CHECK(assess(mesh, nullptr, {.errors = errors}).critical->mean_error < 10);
    errors[12] = -1;
    CHECK_THROWS_WITH_AS(assess(mesh, nullptr, {.errors = errors}), doctest::Contains("cell 12"),
                         maille::InputError);
    errors[12] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(assess(mesh, nullptr, {.errors = errors}), maille::InputError);
    errors.pop_back();
    CHECK_THROWS_AS(assess(mesh, nullptr, {.errors = errors}), std::invalid_argument);
}

TEST_CASE("worst cells are told with the sets that they are in and touch") {
    TetMesh mesh = kuhn_cube(2);
    const SetHandle part = mesh.add_set("part", EntityKind::cell);
    const SetHandle top = mesh.add_set("top", EntityKind::face);
    for (const HalffaceHandle hf : mesh.boundary_halffaces()) {
        const auto v = mesh.halfface_vertices(hf);
        if (std::ranges::all_of(v, [&](VertexHandle x) { return mesh.point(x).z() == 1; }))
            mesh.insert(top, hf);
    }
    for (const CellHandle c : mesh.cells())
        if (centroid(mesh, c).x() < 0.5) mesh.insert(part, c);
    const Report report = assess(mesh, nullptr, {.n_worst = 48});
    REQUIRE(report.worst.size() == 48);
    std::size_t touching = 0;
    for (const WorstCell& w : report.worst) {
        CHECK(w.sets ==
              (w.centroid.x() < 0.5 ? std::vector<std::string>{"part"} : std::vector<std::string>{}));
        if (w.touches == std::vector<std::string>{"top"}) ++touching;
    }
    CHECK(touching == 8);  // two for each of the four squares
}

TEST_CASE("one measure of all cells is what each cell has") {
    const TetMesh mesh = bad_cube(8);
    const WantedSize size = [](const Point& p) { return 0.1 + 0.1 * p.x(); };
    for (const MeasureInfo& info : measure_infos) {
        const std::vector<double> values = measure_cells(mesh, info.measure, &size);
        REQUIRE(values.size() == mesh.n_cells());
        for (std::uint32_t i = 0; i < mesh.n_cells(); i += 97) {
            const CellHandle c(i);
            CHECK(values[i] == value_of(measure_cell(mesh, c, cell_geometry(mesh, c), &size), info.measure));
        }
    }
}

TEST_CASE("the best value of each measure is the regular tetrahedron's") {
    const Point a(1, 1, 1), b(-1, 1, -1), c(1, -1, -1), d(-1, -1, 1);
    const TetMesh mesh = TetMesh::from_cells({a, b, c, d}, {{0, 1, 2, 3}});
    const WantedSize size = [](const Point&) { return std::sqrt(8.0); };
    for (const MeasureInfo& info : measure_infos) {
        CAPTURE(std::string(info.name));
        CHECK(measure_cells(mesh, info.measure, &size)[0] == doctest::Approx(info.best).epsilon(1e-12));
        CHECK(info.low < info.best);
        CHECK(info.best <= info.high);
    }
}
