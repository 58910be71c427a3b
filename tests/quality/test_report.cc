#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include "quality/report.hh"
#include "tests/support/kuhn.hh"
#include "volmesh/error.hh"

using namespace maille::quality;
using namespace maille::volmesh;
using maille::test::kuhn_cube;

namespace {

TetMesh shaken_cube(int n, unsigned seed) {
    TetMesh mesh = kuhn_cube(n);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shift(-0.15 / n, 0.15 / n);
    for (std::uint32_t i = 0; i < mesh.n_vertices(); ++i)
        mesh.set_point(VertexHandle(i),
                       mesh.point(VertexHandle(i)) + Point(shift(random), shift(random), shift(random)));
    return mesh;
}

TetGeometry geometry(const TetMesh& mesh, CellHandle c) {
    const auto p = mesh.cell_points(c);
    return tet_geometry(p[0], p[1], p[2], p[3]);
}

}  // namespace

TEST_CASE("a report's figures are those of a plain loop over the cells") {
    const TetMesh mesh = shaken_cube(10, 5);  // 6000 cells: two chunks
    const WantedSize size = [](const Point& p) { return 0.05 + 0.1 * p.x(); };
    const Report report = assess(mesh, &size);
    CHECK(report.cells == mesh.n_cells());
    CHECK(report.has_size);

    const auto values = [&](auto&& measure) {
        std::vector<double> result;
        for (std::uint32_t i = 0; i < mesh.n_cells(); ++i) result.push_back(measure(CellHandle(i)));
        return result;
    };
    const auto check = [&](Measure m, const std::vector<double>& all) {
        const MeasureInfo& info = measure_infos[static_cast<std::size_t>(m)];
        CAPTURE(std::string(info.name));
        const Statistics& s = report[m];
        CHECK(s.min == *std::min_element(all.begin(), all.end()));
        CHECK(s.max == *std::max_element(all.begin(), all.end()));
        CHECK(s.mean ==
              doctest::Approx(std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size()))
                  .epsilon(1e-12));
        std::vector<std::size_t> counts(info.bins);
        for (double x : all) {
            const double width = (info.high - info.low) / info.bins;
            ++counts[std::clamp(static_cast<int>(std::floor((x - info.low) / width)), 0,
                                static_cast<int>(info.bins) - 1)];
        }
        std::size_t wrong = 0;  // a value on a bin's edge may be rounded to either side
        for (std::size_t k = 0; k < counts.size(); ++k)
            wrong += std::max(counts[k], s.histogram[k]) - std::min(counts[k], s.histogram[k]);
        CHECK(wrong <= 4);
        CHECK(std::accumulate(s.histogram.begin(), s.histogram.end(), std::size_t{0}) == report.cells);
    };
    const std::array<std::pair<Measure, double (*)(const TetGeometry&)>, 9> plain{
        {{Measure::beta, beta},
         {Measure::sigma, sigma},
         {Measure::omega, omega},
         {Measure::tau, tau},
         {Measure::kappa, kappa},
         {Measure::alpha, alpha},
         {Measure::gamma, gamma},
         {Measure::dihedral_min, dihedral_min},
         {Measure::dihedral_max, dihedral_max}}};
    for (const auto& [m, function] : plain)
        check(m, values([&, f = function](CellHandle c) { return f(geometry(mesh, c)); }));
    const auto phis = values([&](CellHandle c) {
        const auto p = mesh.cell_points(c);
        return phi(geometry(mesh, c), size((p[0] + p[1] + p[2] + p[3]) / 4));
    });
    check(Measure::phi, phis);

    const auto sigmas = values([&](CellHandle c) { return sigma(geometry(mesh, c)); });
    const auto taus = values([&](CellHandle c) { return tau(geometry(mesh, c)); });
    const auto percent = [&](auto&& all, auto&& holds) {
        return 100.0 * static_cast<double>(std::count_if(all.begin(), all.end(), holds)) /
               static_cast<double>(all.size());
    };
    REQUIRE(report.criteria.size() == 4);
    CHECK(report.criteria[0].percent == percent(sigmas, [](double x) { return x < 0.4; }));
    CHECK(report.criteria[1].percent == percent(sigmas, [](double x) { return x < 0.2; }));
    CHECK(report.criteria[2].percent == percent(taus, [](double x) { return x < 0.3; }));
    CHECK(report.criteria[3].percent == percent(phis, [](double x) { return x >= 2.0 / 3 && x <= 1.5; }));
    CHECK(report.criteria[0].percent > 0);

    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t i = 0; i < mesh.n_cells(); ++i) order.emplace_back(sigmas[i], i);
    std::sort(order.begin(), order.end());
    REQUIRE(report.worst.size() == 10);
    for (std::size_t k = 0; k < 10; ++k) CHECK(report.worst[k].cell.idx() == order[k].second);
}

TEST_CASE("a report is the same to the last bit for any number of threads") {
    const TetMesh mesh = shaken_cube(14, 6);
    const WantedSize size = [](const Point& p) { return 0.1 + p.norm(); };
    std::vector<std::string> reports;
    for (std::size_t threads : {1, 2, 4}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        reports.push_back(to_json(assess(mesh, &size)).dump());
    }
    CHECK(reports[0] == reports[1]);
    CHECK(reports[0] == reports[2]);
}

TEST_CASE("a cube of Kuhn bricks has the path tetrahedron's figures and no spread") {
    const Report report = assess(kuhn_cube(4));
    const double path = 2 * std::sqrt(6.0) / (2 + 2 * std::sqrt(2.0)) / std::sqrt(3.0);
    CHECK(report.inverted == 0);
    for (double x : {report[Measure::sigma].min, report[Measure::sigma].mean, report[Measure::sigma].max})
        CHECK(x == doctest::Approx(path).epsilon(1e-12));
    CHECK(report[Measure::tau].min == doctest::Approx(1 / std::sqrt(3.0)));
    CHECK(report.criteria.size() == 3);
}

TEST_CASE("inverted and flat cells are counted, and deleted ones are not") {
    TetMesh mesh = kuhn_cube(2);
    const VertexHandle middle(13);
    REQUIRE(mesh.point(middle).isApprox(Point(0.5, 0.5, 0.5)));
    mesh.set_point(middle, Point(0.5, 0.5, 1));  // in the top face
    const Report report = assess(mesh);
    std::size_t bad = 0;
    for (std::uint32_t i = 0; i < mesh.n_cells(); ++i)
        if (!(volume(geometry(mesh, CellHandle(i))) > 0)) ++bad;
    CHECK(bad > 0);
    CHECK(report.inverted == bad);
    CHECK(report[Measure::dihedral_max].max == 180);
    CHECK(std::isfinite(report[Measure::omega].mean));

    mesh.delete_cell(CellHandle(0));
    CHECK(assess(mesh).cells == mesh.n_cells() - 1);
}

TEST_CASE("an empty mesh has a report of zeros") {
    const Report report = assess(TetMesh::from_cells({}, {}));
    CHECK(report.cells == 0);
    CHECK(report[Measure::beta].mean == 0);
    CHECK(report.worst.empty());
    CHECK(to_text(report).find("0 cells") == 0);
    CHECK(to_json(report)["measures"]["beta"]["min"] == 0);
}

TEST_CASE("a wanted size that is not positive is refused with its place") {
    const TetMesh mesh = kuhn_cube(1);
    for (double wrong :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        const WantedSize size = [wrong](const Point&) { return wrong; };
        CHECK_THROWS_WITH_AS(assess(mesh, &size), doctest::Contains("wanted size"), maille::InputError);
    }
}

TEST_CASE("JSON has the names that others rely on") {
    TetMesh mesh = kuhn_cube(1);
    mesh.insert(mesh.add_set("part", EntityKind::cell), CellHandle(0));
    const WantedSize size = [](const Point&) { return 1.0; };
    const auto json = nlohmann::json::parse(to_json(assess(mesh, &size)).dump());
    CHECK(json.at("cells") == 6);
    CHECK(json.at("inverted") == 0);
    for (const char* name :
         {"beta", "sigma", "omega", "tau", "kappa", "alpha", "gamma", "phi", "dihedral_min", "dihedral_max",
          "solid_angle_min", "solid_angle_max", "aspect", "condition", "mean_ratio", "scaled_jacobian"}) {
        const auto& measure = json.at("measures").at(name);
        CHECK(measure.at("min").get<double>() <= measure.at("mean").get<double>() + 1e-12);
        CHECK(measure.at("mean").get<double>() <= measure.at("max").get<double>() + 1e-12);
        const auto counts = measure.at("histogram").get<std::vector<std::size_t>>();
        CHECK(std::accumulate(counts.begin(), counts.end(), std::size_t{0}) == 6);
    }
    CHECK(json["measures"].size() == 16);
    CHECK(json["measures"]["phi"]["max"].get<double>() == doctest::Approx(std::sqrt(3.0)));
    for (const char* name : {"r/Lmax<0.4", "r/Lmax<0.2", "Lmin/Lmax<0.3", "2/3<L/Lbar<3/2"})
        CHECK(json.at("criteria").at(name).is_number());
    CHECK(json["criteria"]["2/3<L/Lbar<3/2"] == 0);
    std::size_t named = 0;
    for (const auto& worst : json.at("worst"))
        if (worst["sets"] == nlohmann::json{"part"}) ++named;
    CHECK(named == 1);
    CHECK(to_json(assess(mesh))["measures"]["phi"].is_null());
}

TEST_CASE("percentages are cut, not rounded, and every measure has its line") {
    Report report = assess(kuhn_cube(1));
    report.criteria = {{"r/Lmax<0.4", 100 * 3 / 3515.0}, {"Lmin/Lmax<0.3", 99.999}};
    const std::string text = to_text(report);
    CHECK(text.find("0.08\n") != std::string::npos);
    CHECK(text.find("99.99\n") != std::string::npos);
    for (const MeasureInfo& info : measure_infos)
        CHECK((text.find(info.name) != std::string::npos) == (info.measure != Measure::phi));
}
