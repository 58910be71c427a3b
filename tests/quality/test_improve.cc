#include <algorithm>
#include <cmath>
#include <random>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include "quality/improve.hh"
#include "quality/objective.hh"
#include "quality/report.hh"
#include "tests/support/kuhn.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

using namespace maille::quality;
using namespace maille::volmesh;
using maille::test::kuhn_cube;

namespace {

bool is_on_cube(const Point& p) {
    return p.minCoeff() == 0 || p.maxCoeff() == 1;
}

/// A cube whose free vertices are shaken: the inner ones, and where `sides_too` also those within a side, in
/// its plane.
TetMesh shaken_cube(int n, bool sides_too, unsigned seed) {
    TetMesh mesh = kuhn_cube(n);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shift(-0.3 / n, 0.3 / n);
    for (std::uint32_t i = 0; i < mesh.n_vertices(); ++i) {
        Point p = mesh.point(VertexHandle(i));
        const Point before = p;
        for (double& x : p)
            if (x > 0 && x < 1) x += shift(random);
        if (sides_too || !is_on_cube(before)) mesh.set_point(VertexHandle(i), p);
    }
    return mesh;
}

const std::vector<std::string> side_names{"cube/x-", "cube/x+", "cube/y-", "cube/y+", "cube/z-", "cube/z+"};

void name_sides(TetMesh& mesh) {
    std::vector<SetHandle> sides;
    for (const auto& name : side_names) sides.push_back(mesh.add_set(name, EntityKind::face));
    for (std::uint32_t i = 0; i < mesh.n_halffaces(); ++i) {
        const HalffaceHandle hf(i);
        if (!mesh.is_boundary(hf)) continue;
        const auto v = mesh.halfface_vertices(hf);
        for (int side = 0; side < 6; ++side)
            if (std::ranges::all_of(v, [&](VertexHandle w) { return mesh.point(w)[side / 2] == side % 2; }))
                mesh.insert(sides[side], hf);
    }
}

Projector cube_projector() {
    return {side_names,
            [](std::span<const std::uint32_t> surfaces, const Point& p) -> std::optional<Point> {
                Point q = p;
                for (std::uint32_t s : surfaces) q[s / 2] = s % 2;
                return q;
            },
            std::sqrt(3.0)};
}

double least(const TetMesh& mesh, Measure m) {
    return assess(mesh)[m].min;
}

double worst(const TetMesh& mesh) {
    double least = 1;
    for (CellHandle c : mesh.cells()) {
        const auto p = mesh.cell_points(c);
        least = std::min(least, objective(p[0], p[1], p[2], p[3]));
    }
    return least;
}

/// A cube whose cells are bisected at their longest edges again and again, most near a corner.
TetMesh bisected_cube(unsigned seed) {
    TetMesh mesh = shaken_cube(4, false, seed);
    for (int round = 0; round < 9; ++round)
        for (std::uint32_t i = 0, n = mesh.n_cells(); i < n; ++i) {
            const auto p = mesh.cell_points(CellHandle(i));
            const auto length = [&](int e) {
                const auto [j, k] = tet::edge_vertices[e];
                return (p[j] - p[k]).norm();
            };
            int longest = 0;
            for (int e = 1; e < 6; ++e)
                if (length(e) > length(longest)) longest = e;
            if (length(longest) > 0.1 + 0.2 * p[0].norm()) mesh.split_edge(CellHandle(i), longest);
        }
    return mesh;
}

const ImproveOptions moves_only{
    .max_passes = 20, .good_enough = 0.7, .may_change_cells = false, .mean_sweeps = 0};

}  // namespace

TEST_CASE("smoothing raises the worst cells, the boundary stays where it was") {
    constexpr unsigned seed = 17;
    CAPTURE(seed);
    TetMesh mesh = shaken_cube(6, false, seed);
    const TetMesh before = mesh;
    const ImproveResult result = improve(mesh, moves_only);
    MESSAGE(result.passes << " passes, " << result.moves << " moves: " << result.worst_before << " to "
                          << result.worst_after);
    CHECK(result.worst_before == worst(before));
    CHECK(result.worst_after == worst(mesh));
    CHECK(result.worst_after > result.worst_before + 0.1);
    CHECK(validate(mesh).ok());
    CHECK(volume(mesh) == doctest::Approx(1).epsilon(1e-12));
    CHECK(boundary_area(mesh) == doctest::Approx(6).epsilon(1e-12));
    for (VertexHandle v : mesh.vertices()) {
        const Point& old = before.point(v);
        for (int axis = 0; axis < 3; ++axis)
            if (old[axis] == 0 || old[axis] == 1) CHECK(mesh.point(v)[axis] == old[axis]);
    }
    CHECK(std::ranges::equal(mesh.cell_vertex_indices(), before.cell_vertex_indices()));
}

TEST_CASE("no pass lowers the worst cell") {
    for (const bool may_change_cells : {false, true})
        for (unsigned seed = 1; seed <= 4; ++seed) {
            CAPTURE(seed);
            TetMesh mesh = shaken_cube(4, seed % 2 == 0, seed);
            double so_far = worst(mesh);
            for (int pass = 0; pass < 4; ++pass) {
                improve(mesh, {.max_passes = 1, .good_enough = 1, .may_change_cells = may_change_cells});
                CHECK(worst(mesh) >= so_far);
                so_far = worst(mesh);
            }
            CHECK(validate(mesh).ok());
        }
}

TEST_CASE("a limit of tries is kept to, the worst first") {
    TetMesh mesh = shaken_cube(6, false, 17);
    const TetMesh before = mesh;
    ImproveOptions options = moves_only;
    options.tries_per_cell = 100;
    TetMesh unlimited = mesh;
    const ImproveResult all = improve(unlimited, options);
    CHECK_FALSE(all.is_cut_short);
    options.base_tries = 6;
    options.tries_per_cell = 10.0 / mesh.n_cells();
    const ImproveResult result = improve(mesh, options);
    CHECK(result.is_cut_short);
    // A try moves the four vertices of a cell at most.
    CHECK(result.moves > 0);
    CHECK(result.moves <= 16 * 4);
    CHECK(all.moves > result.moves);
    CHECK(result.worst_after > result.worst_before);
    std::size_t n_moved = 0;
    for (VertexHandle v : mesh.vertices()) n_moved += mesh.point(v) != before.point(v);
    CHECK(n_moved <= 16 * 4);
    CHECK(validate(mesh).ok());
}

TEST_CASE("with a projector the boundary moves on its geometric support only") {
    TetMesh mesh = shaken_cube(5, true, 23);
    name_sides(mesh);
    const TetMesh before = mesh;
    const Projector projector = cube_projector();
    ImproveOptions options = moves_only;
    options.good_enough = 1;
    options.good_mean = 1;
    SUBCASE("to better the worst") {}
    SUBCASE("to raise the mean") {
        options.mean_sweeps = 3;
        options.max_passes = 0;
    }
    improve(mesh, options, &projector);
    CHECK(assess(mesh)[Measure::beta].mean > assess(before)[Measure::beta].mean + 0.05);
    CHECK(validate(mesh).ok());
    CHECK(worst(mesh) > worst(before));
    CHECK(volume(mesh) == doctest::Approx(1).epsilon(1e-12));
    std::size_t slid = 0;
    for (VertexHandle v : mesh.vertices()) {
        const Point& old = before.point(v);
        const Point& now = mesh.point(v);
        for (int axis = 0; axis < 3; ++axis)
            if (old[axis] == 0 || old[axis] == 1) CHECK(now[axis] == old[axis]);
        if (is_on_cube(old) && now != old) ++slid;
    }
    CHECK(slid > 0);
    for (const auto& name : side_names)
        CHECK(measure(mesh, mesh.find_set(name, EntityKind::face)) == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("what a set marks stays in its place") {
    for (const bool may_change_cells : {false, true}) {
        TetMesh mesh = shaken_cube(4, true, 31);
        name_sides(mesh);
        const Projector projector = cube_projector();
        // A material, a point load, a wire, and a patch of a side.
        const SetHandle material = mesh.add_set("copper", EntityKind::cell);
        for (std::uint32_t i = 0; i < mesh.n_cells() / 2; ++i) mesh.insert(material, CellHandle(i));
        const SetHandle load = mesh.add_set("load", EntityKind::vertex);
        mesh.insert(load, VertexHandle(31));
        const SetHandle wire = mesh.add_set("wire", EntityKind::edge);
        mesh.insert(wire, CellHandle(330), 2);
        const SetHandle patch = mesh.add_set("patch", EntityKind::face);
        const auto top = mesh.face_members(mesh.find_set("cube/z+", EntityKind::face));
        for (std::size_t i = 0; i < top.size() / 2; ++i) mesh.insert(patch, top[i]);
        CPropHandleT<double> mass;
        mesh.add_property(mass, "mass", {PropertyRule::share}, 0.0);
        for (CellHandle c : mesh.cells()) mesh.property(mass, c) = mesh.contains(material, c) ? 2 : 1;

        const double copper = measure(mesh, material);
        const double patched = measure(mesh, patch);
        const double length = measure(mesh, wire);
        const Point at_load = mesh.point(VertexHandle(31));
        const auto masses = [&] {
            std::array<double, 2> sum{};
            for (CellHandle c : mesh.cells()) sum[mesh.contains(material, c)] += mesh.property(mass, c);
            return sum;
        };
        const auto mass_before = masses();
        const ImproveResult result =
            improve(mesh, {.good_enough = 1, .may_change_cells = may_change_cells}, &projector);
        CHECK(result.moves > 0);
        CHECK((result.edge_removals + result.face_removals > 0) == may_change_cells);
        CHECK(validate(mesh).ok());
        CHECK(measure(mesh, material) == doctest::Approx(copper).epsilon(1e-12));
        CHECK(measure(mesh, patch) == doctest::Approx(patched).epsilon(1e-12));
        CHECK(measure(mesh, wire) == length);
        CHECK(volume(mesh) == doctest::Approx(1).epsilon(1e-12));
        for (const auto& name : side_names)
            CHECK(measure(mesh, mesh.find_set(name, EntityKind::face)) == doctest::Approx(1).epsilon(1e-12));
        const auto loaded = mesh.vertex_members(load);
        REQUIRE(loaded.size() == 1);
        CHECK(mesh.point(loaded.front()) == at_load);
        for (int side : {0, 1}) CHECK(masses()[side] == doctest::Approx(mass_before[side]).epsilon(1e-12));
    }
}

TEST_CASE("an inverted cell comes right and a good mesh is left as it is") {
    TetMesh mesh = kuhn_cube(3);
    CHECK(improve(mesh, {.good_enough = worst(mesh) - 1e-9, .mean_sweeps = 0}).edits() == 0);

    VertexHandle inner(0);
    while (mesh.is_boundary(inner)) inner = VertexHandle(inner.idx() + 1);
    mesh.set_point(inner, mesh.point(inner) + Point(0.4, 0.1, 0.05));
    REQUIRE(assess(mesh).inverted > 0);
    improve(mesh);
    CHECK(assess(mesh).inverted == 0);
    CHECK(validate(mesh).ok());
}

TEST_CASE("slivers that smoothing cannot cure go by a change of connectivity") {
    // Random points in the shaken cube's cells: flat and needle-like cells galore.
    constexpr unsigned seed = 3;
    CAPTURE(seed);
    TetMesh mesh = kuhn_cube(4);
    std::mt19937 random(seed);
    for (int i = 0; i < 300; ++i)
        mesh.split_edge(CellHandle(static_cast<std::uint32_t>(random() % mesh.n_cells())),
                        static_cast<int>(random() % 6), 0.2 + 0.1 * static_cast<double>(random() % 6));
    const double before = least(mesh, Measure::dihedral_min);
    const ImproveResult result = improve(mesh);
    MESSAGE("least angle " << before << " to " << least(mesh, Measure::dihedral_min) << ", greatest "
                           << assess(mesh)[Measure::dihedral_max].max << ", beta "
                           << least(mesh, Measure::beta) << ", mean " << assess(mesh)[Measure::beta].mean);
    CHECK(result.edge_removals > 0);
    CHECK(result.collapses > 0);
    CHECK(before < 5);
    CHECK(least(mesh, Measure::dihedral_min) >= 15);
    CHECK(assess(mesh)[Measure::dihedral_max].max <= 155);
    CHECK(least(mesh, Measure::beta) >= 0.3);
    CHECK(validate(mesh).ok());
    CHECK(volume(mesh) == doctest::Approx(1).epsilon(1e-12));
    CHECK(boundary_area(mesh) == doctest::Approx(6).epsilon(1e-12));
}

TEST_CASE("the mean of a bisected mesh rises to what is wanted, with any number of threads alike") {
    constexpr unsigned seed = 8;
    CAPTURE(seed);
    TetMesh mesh = bisected_cube(seed);
    name_sides(mesh);
    const SetHandle half = mesh.add_set("half", EntityKind::cell);
    for (CellHandle c : mesh.cells()) {
        const auto p = mesh.cell_points(c);
        if ((p[0] + p[1] + p[2] + p[3]).x() < 2) mesh.insert(half, c);
    }
    const double half_before = measure(mesh, half);
    const Report before = assess(mesh);
    const TetMesh start = mesh;
    const ImproveResult result = improve(mesh);
    const Report after = assess(mesh);
    MESSAGE(before.cells << " cells, mean beta " << before[Measure::beta].mean << " to "
                         << after[Measure::beta].mean << ", " << result.edge_removals << " edges removed, "
                         << result.moves << " moves");
    CHECK(before[Measure::beta].mean < 0.72);
    CHECK(after[Measure::beta].mean > before[Measure::beta].mean + 0.07);
    CHECK(result.worst_after > result.worst_before + 0.1);
    CHECK(result.worst_after == worst(mesh));
    CHECK(validate(mesh).ok());
    CHECK(measure(mesh, half) == doctest::Approx(half_before).epsilon(1e-12));
    for (const auto& name : side_names)
        CHECK(measure(mesh, mesh.find_set(name, EntityKind::face)) == doctest::Approx(1).epsilon(1e-12));
    for (const int threads : {1, 3, 4}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        TetMesh other = start;
        improve(other);
        CHECK(std::ranges::equal(mesh.points(), other.points()));
        CHECK(std::ranges::equal(mesh.cell_vertex_indices(), other.cell_vertex_indices()));
    }
}

TEST_CASE("a large mesh that is far from its aim, too, comes out the same with any number of threads") {
    TetMesh mesh = shaken_cube(22, false, 41);
    name_sides(mesh);
    const SetHandle half = mesh.add_set("half", EntityKind::cell);
    for (std::uint32_t i = 0; i < mesh.n_cells() / 2; ++i) mesh.insert(half, CellHandle(i));
    const double half_before = measure(mesh, half);
    CHECK(assess(mesh)[Measure::beta].mean < 0.7);
    const double worst_before = worst(mesh);
    TetMesh other = mesh;
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 3);
        improve(mesh);
    }
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
        improve(other);
    }
    CHECK(std::ranges::equal(mesh.points(), other.points()));
    CHECK(std::ranges::equal(mesh.cell_vertex_indices(), other.cell_vertex_indices()));
    CHECK(validate(mesh).ok());
    CHECK(assess(mesh)[Measure::beta].mean > 0.75);
    CHECK(worst(mesh) > worst_before);
    CHECK(measure(mesh, half) == doctest::Approx(half_before).epsilon(1e-12));
    for (const auto& name : side_names)
        CHECK(measure(mesh, mesh.find_set(name, EntityKind::face)) == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("raising the mean makes no cell the worst") {
    TetMesh mesh = bisected_cube(12);
    const TetMesh start = mesh;
    improve(mesh, {.max_passes = 0, .good_mean = 1});
    CHECK(assess(mesh)[Measure::beta].mean > assess(start)[Measure::beta].mean + 0.05);
    CHECK(worst(mesh) >= worst(start));
}

TEST_CASE("no cell becomes longer than the size allows") {
    TetMesh mesh = shaken_cube(6, false, 9);
    const WantedSize size = [](const Point& p) { return 0.2 + 0.05 * p.x(); };
    const double before = assess(mesh, &size)[Measure::phi].max;
    improve(mesh, {.good_enough = 0.6, .size = &size, .ratio = 1.5});
    CHECK(assess(mesh, &size)[Measure::phi].max <= std::max(before, 1.5));

    const WantedSize graded = [](const Point& p) { return (0.1 + 0.2 * p.norm()) / 1.3; };
    int n_longer = 0;
    for (unsigned seed = 1; seed <= 8; ++seed) {
        CAPTURE(seed);
        TetMesh bisected = bisected_cube(seed);
        const double phi = assess(bisected, &graded)[Measure::phi].max;
        TetMesh free = bisected;
        improve(free, {.good_mean = 1});
        n_longer += assess(free, &graded)[Measure::phi].max > phi;
        improve(bisected, {.good_mean = 1, .size = &graded, .ratio = phi});
        CHECK(assess(bisected, &graded)[Measure::phi].max <= phi);
    }
    CHECK(n_longer > 0);
}

TEST_CASE("the same mesh is bettered the same way") {
    TetMesh one = shaken_cube(5, true, 4);
    TetMesh two = one;
    improve(one, {.good_enough = 0.5});
    improve(two, {.good_enough = 0.5});
    CHECK(std::ranges::equal(one.points(), two.points()));
    CHECK(std::ranges::equal(one.cell_vertex_indices(), two.cell_vertex_indices()));
}

TEST_CASE("the objective stands for the angles and beta, and its slopes are its derivatives") {
    constexpr unsigned seed = 77;
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    const auto point = [&] { return Point(coordinate(random), coordinate(random), coordinate(random)); };
    int n_positive = 0;
    for (int i = 0; i < 500; ++i) {
        const Point p = point();
        const Base base{point(), point(), point()};
        const double value = objective(p, base);
        const TetGeometry t = tet_geometry(p, base[0], base[1], base[2]);
        if (volume(t) > 0) {
            ++n_positive;
            const bool is_good = dihedral_min(t) >= 15 && dihedral_max(t) <= 155 && beta(t) >= 0.3;
            CHECK((value >= sine_of_15) == is_good);
        } else {
            CHECK(value == doctest::Approx(maille::quality::gamma(t)).epsilon(1e-9));
        }
        Slopes slopes;
        append_slopes(p, base, std::numeric_limits<double>::infinity(), slopes);
        const auto lowest = std::ranges::min_element(slopes, {}, &Slope::value);
        CHECK(lowest->value == doctest::Approx(value).epsilon(1e-9));
        if (value > 0) {
            const Slope slope = beta_slope(p, base);
            CHECK(slope.value == doctest::Approx(beta(t)).epsilon(1e-9));
            for (int axis = 0; axis < 3; ++axis) {
                const auto beta_at = [&](double step) {
                    return beta(tet_geometry(p + step * Point::Unit(axis), base[0], base[1], base[2]));
                };
                CHECK((beta_at(1e-6) - beta_at(-1e-6)) / 2e-6 ==
                      doctest::Approx(slope.gradient[axis]).scale(1 + slope.gradient.norm()).epsilon(1e-4));
            }
        }
        // A small step: along it the lowest function changes as its gradient says.
        constexpr double h = 1e-7;
        for (int axis = 0; axis < 3; ++axis) {
            const double forth = objective(p + h * Point::Unit(axis), base);
            const double back = objective(p - h * Point::Unit(axis), base);
            const double bound = 1e-4 * (1 + lowest->gradient.norm());
            const bool has_kink = std::abs(forth - 2 * value + back) > h * bound;
            if (!has_kink) CHECK(std::abs((forth - back) / (2 * h) - lowest->gradient[axis]) < bound);
        }
    }
    CHECK(n_positive > 100);
}
