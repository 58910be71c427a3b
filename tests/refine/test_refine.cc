#include <cmath>
#include <map>
#include <optional>

#include <doctest/doctest.h>

#include "meshes.hh"
#include "quality/measures.hh"
#include "refine/refine.hh"
#include "volmesh/error.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

using namespace maille::refine;
using maille::InputError;
using test::Soup;
using test::Tet;

namespace {

double longest(const TetMesh& mesh, CellHandle c) {
    const auto p = mesh.cell_points(c);
    double length = 0;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < i; ++j) length = std::max(length, (p[i] - p[j]).norm());
    return length;
}

bool is_fine(const TetMesh& mesh, const SizeField& size, double ratio) {
    for (const auto c : mesh.cells()) {
        const auto p = mesh.cell_points(c);
        if (longest(mesh, c) > ratio * size(0.25 * (p[0] + p[1] + p[2] + p[3]))) return false;
    }
    return true;
}

void check_valid(const TetMesh& mesh, double volume) {
    const auto validation = maille::volmesh::validate(mesh);
    CAPTURE(validation.errors.size());
    if (!validation.ok()) CAPTURE(validation.errors.front());
    CHECK(validation.ok());
    CHECK(maille::volmesh::volume(mesh) == doctest::Approx(volume).epsilon(1e-12));
}

const SizeField graded([](const Point& p) { return 0.06 + 0.4 * p.norm(); });

/// Rivara's algorithm as the paper words it, on bare tetrahedra that need not conform until a pass is over:
/// step 3 bisects each element of E_t alone, step 4 any element that has a split edge, at its own longest
/// edge.
class NaiveRivara {
  public:
    explicit NaiveRivara(const Soup& soup) : soup_(soup) {}

    void pass(const SizeField& size, double ratio) {
        const std::vector<Tet> before = soup_.tets;
        soup_.tets.clear();
        for (const Tet& t : before) {
            const Point at = 0.25 * (at_(t[0]) + at_(t[1]) + at_(t[2]) + at_(t[3]));
            const auto [a, b] = longest_edge(t);
            if ((at_(a) - at_(b)).norm() > ratio * size(at))
                bisect(t);
            else
                soup_.tets.push_back(t);
        }
        while (conform_once()) {
        }
    }

    const Soup& soup() const { return soup_; }

  private:
    using Edge = std::pair<std::uint32_t, std::uint32_t>;

    const Point& at_(std::uint32_t v) const { return soup_.points[v]; }

    Edge longest_edge(const Tet& t) const {
        const auto key = [&](const Edge& e) {
            const Point d = at_(e.first) - at_(e.second), s = at_(e.first) + at_(e.second);
            return std::tuple(d.x() * d.x() + d.y() * d.y() + d.z() * d.z(), s.x(), s.y(), s.z(), e.first,
                              e.second);
        };
        Edge best{std::min(t[0], t[1]), std::max(t[0], t[1])};
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < i; ++j) {
                const Edge e{std::min(t[i], t[j]), std::max(t[i], t[j])};
                if (key(e) > key(best)) best = e;
            }
        return best;
    }

    void bisect(const Tet& t) {
        const Edge e = longest_edge(t);
        const auto [place, is_new] =
            midpoints_.try_emplace(e, static_cast<std::uint32_t>(soup_.points.size()));
        if (is_new) soup_.points.push_back(0.5 * (at_(e.first) + at_(e.second)));
        for (const std::uint32_t end : {e.first, e.second}) {
            Tet child = t;
            std::ranges::replace(child, end, place->second);
            soup_.tets.push_back(child);
        }
    }

    bool conform_once() {
        const std::vector<Tet> before = std::exchange(soup_.tets, {});
        bool has_split = false;
        for (const Tet& t : before) {
            bool is_hanging = false;
            for (int i = 0; i < 4; ++i)
                for (int j = 0; j < i; ++j)
                    is_hanging |= midpoints_.contains({std::min(t[i], t[j]), std::max(t[i], t[j])});
            has_split |= is_hanging;
            if (is_hanging)
                bisect(t);
            else
                soup_.tets.push_back(t);
        }
        return has_split;
    }

    Soup soup_;
    std::map<Edge, std::uint32_t> midpoints_;
};

}  // namespace

TEST_CASE("every algorithm gives a valid mesh as fine as wanted") {
    for (const Method method : {Method::rivara, Method::bisection})
        for (const Order order : {Order::longest, Order::shape, Order::none})
            for (const unsigned seed : {1U, 2U}) {
                CAPTURE(int(method));
                CAPTURE(int(order));
                CAPTURE(seed);
                TetMesh mesh = test::random_cube(3, seed, 0.3).mesh();
                const RefineResult result =
                    refine(mesh, graded,
                           {.method = method, .order = order, .max_iterations = 60, .max_cells = 40000});
                check_valid(mesh, 1);
                CHECK(result.cells == mesh.n_cells());
                CHECK(result.vertices == mesh.n_vertices());
                if (method == Method::rivara) CHECK(result.ended);
                CHECK(result.ended == is_fine(mesh, graded, 1.5));
            }
}

TEST_CASE("the closure of a Rivara pass is the only one there is") {
    for (const unsigned seed : {0U, 3U, 4U}) {
        CAPTURE(seed);
        const Soup soup = seed == 0 ? test::kuhn_cube(3) : test::random_cube(3, seed, 0.3);
        NaiveRivara naive(soup);
        for (int passes = 1; passes <= 6; ++passes) {
            naive.pass(graded, 1.5);
            const auto expected = test::places(naive.soup().mesh());
            for (const Order order : {Order::none, Order::longest, Order::shape}) {
                TetMesh mesh = soup.mesh();
                const auto result = refine(mesh, graded, {.order = order, .max_iterations = passes});
                CHECK(result.iterations <= passes);
                CHECK(test::places(mesh) == expected);
            }
        }
    }
}

TEST_CASE("the Kuhn cube of 20^3 bricks refines to 842,664 tetrahedra") {
    TetMesh mesh = test::kuhn_cube(20).mesh();
    const SizeField size([](const Point& p) { return 0.0008 + 0.05 * (1 - std::exp(-p.norm())); });
    const RefineResult result = refine(mesh, size);
    CHECK(result.ended);
    CHECK(result.cells == 842'664);
    double worst = 1;
    for (const auto c : mesh.cells()) {
        const auto p = mesh.cell_points(c);
        worst = std::min(worst, maille::quality::beta(maille::quality::tet_geometry(p[0], p[1], p[2], p[3])));
    }
    CHECK(worst == doctest::Approx(0.641).epsilon(0.001));
    MESSAGE("seconds: mark ", result.seconds.mark, " split ", result.seconds.split);
}

TEST_CASE("a mesh that is fine enough stays as it is") {
    const Soup soup = test::kuhn_cube(2);
    TetMesh mesh = soup.mesh();
    const RefineResult result = refine(mesh, SizeField(10));
    CHECK(result.iterations == 0);
    CHECK(result.ended);
    CHECK(mesh.n_cells() == soup.tets.size());
    CHECK(result.lineage.vertex_parents.empty());
}

TEST_CASE("refining twice is refining once") {
    TetMesh mesh = test::random_cube(3, 5, 0.3).mesh();
    refine(mesh, graded);
    const auto before = mesh.n_cells();
    CHECK(refine(mesh, graded).iterations == 0);
    CHECK(mesh.n_cells() == before);
}

TEST_CASE("the ratio sets how long an edge may be") {
    for (const double ratio : {1.0, 1.5, 3.0}) {
        TetMesh mesh = test::kuhn_cube(2).mesh();
        refine(mesh, SizeField(0.2), {.ratio = ratio});
        CHECK(is_fine(mesh, SizeField(0.2), ratio));
        CHECK_FALSE(is_fine(mesh, SizeField(0.2), 0.45 * ratio));
    }
}

TEST_CASE("caps are kept and told") {
    TetMesh mesh = test::kuhn_cube(2).mesh();
    const RefineResult result = refine(mesh, SizeField(0.02), {.max_iterations = 4});
    CHECK(result.iterations == 4);
    CHECK_FALSE(result.ended);
    check_valid(mesh, 1);

    TetMesh other = test::kuhn_cube(2).mesh();
    const RefineResult few = refine(other, SizeField(0.02), {.max_cells = 500});
    CHECK_FALSE(few.ended);
    CHECK(few.cells > 500);
    CHECK(few.cells < 5000);
    check_valid(other, 1);

    // Just as many passes as it takes: that is no cap hit.
    TetMesh whole = test::kuhn_cube(2).mesh();
    const int needed = refine(whole, SizeField(0.1)).iterations;
    TetMesh again = test::kuhn_cube(2).mesh();
    CHECK(refine(again, SizeField(0.1), {.max_iterations = needed}).ended);
    TetMesh less = test::kuhn_cube(2).mesh();
    CHECK_FALSE(refine(less, SizeField(0.1), {.max_iterations = needed - 1}).ended);
}

TEST_CASE("plain bisection that doesn't end is capped") {
    int n_capped = 0;
    for (unsigned seed = 1; seed <= 12; ++seed) {
        TetMesh mesh = test::random_cube(2, seed, 0.3).mesh();
        const RefineResult result =
            refine(mesh, SizeField(0.12), {.method = Method::bisection, .max_iterations = 40});
        n_capped += !result.ended;
        CHECK(result.ended == is_fine(mesh, SizeField(0.12), 1.5));
        check_valid(mesh, 1);
    }
    CHECK(n_capped > 0);
}

TEST_CASE("each cell knows its ancestor, each new vertex its parents") {
    for (const Method method : {Method::rivara, Method::bisection}) {
        const Soup soup = test::random_cube(2, 6, 0.3);
        TetMesh mesh = soup.mesh();
        const TetMesh before = mesh;
        const RefineResult result = refine(mesh, graded, {.method = method, .max_iterations = 8});
        REQUIRE(result.lineage.cell_ancestors.size() == mesh.n_cells());
        REQUIRE(result.lineage.n_vertices_before == before.n_vertices());
        REQUIRE(result.lineage.vertex_parents.size() == mesh.n_vertices() - before.n_vertices());
        std::vector<double> volume(before.n_cells());
        for (const auto c : mesh.cells()) {
            const std::uint32_t ancestor = result.lineage.cell_ancestors[c.idx()];
            const auto p = mesh.cell_points(c);
            const auto t = before.cell_points(CellHandle(ancestor));
            const Point inside = 0.25 * (p[0] + p[1] + p[2] + p[3]);
            for (const auto& f : maille::volmesh::tet::face_vertices)
                CHECK(maille::volmesh::tet_volume(t[f[0]], t[f[2]], t[f[1]], inside) > 0);
            volume[ancestor] += maille::volmesh::volume(mesh, c);
        }
        for (const auto c : before.cells())
            CHECK(volume[c.idx()] == doctest::Approx(maille::volmesh::volume(before, c)));
        for (std::uint32_t i = 0; i < result.lineage.vertex_parents.size(); ++i) {
            const auto [a, b] = result.lineage.vertex_parents[i];
            const std::uint32_t v = before.n_vertices() + i;
            CHECK(std::max(a, b) < v);
            const Point middle = 0.5 * (mesh.point(VertexHandle(a)) + mesh.point(VertexHandle(b)));
            CHECK((mesh.point(VertexHandle(v)) - middle).norm() < 1e-15);
        }
    }
}

TEST_CASE("the result depends on the input alone") {
    const Soup soup = test::random_cube(3, 9, 0.3);
    for (const bool smooth : {false, true}) {
        TetMesh first = soup.mesh();
        refine(first, graded, {.smooth = smooth, .threads = 1});
        for (const int threads : {2, 4}) {
            TetMesh other = soup.mesh();
            refine(other, graded, {.smooth = smooth, .threads = threads});
            CHECK(std::ranges::equal(first.cell_vertex_indices(), other.cell_vertex_indices()));
            CHECK(std::ranges::equal(first.points(), other.points()));
        }
    }
}

TEST_CASE("the result depends on the input alone where there is work for many threads") {
    const SizeField fine([](const Point& p) { return 0.008 + 0.08 * p.norm(); });
    std::optional<TetMesh> first;
    for (const int threads : {1, 2, 4}) {
        TetMesh mesh = test::random_cube(8, 10, 0.12).mesh();
        CHECK(refine(mesh, fine, {.threads = threads}).ended);
        if (!first) {
            first = mesh;
            check_valid(mesh, 1);
            CHECK(mesh.n_cells() > 20'000);
        }
        CHECK(std::ranges::equal(first->cell_vertex_indices(), mesh.cell_vertex_indices()));
        CHECK(std::ranges::equal(first->points(), mesh.points()));
    }
}

TEST_CASE("sizes and options that make no sense are refused") {
    TetMesh mesh = test::kuhn_cube(2).mesh();
    CHECK_THROWS_AS(refine(mesh, SizeField([](const Point& p) { return p.x() - 0.5; })), InputError);
    check_valid(mesh, 1);
    CHECK_THROWS_AS(refine(mesh, SizeField(1), {.ratio = 0}), InputError);
    CHECK_THROWS_AS(refine(mesh, SizeField(1), {.ratio = std::nan("")}), InputError);
    CHECK_THROWS_AS(refine(mesh, SizeField(1), {.max_iterations = -1}), InputError);
    // A size that goes to nothing at an inner point would refine for ever.
    const SizeField vanishing([](const Point& p) { return 1e-18 + 0.5 * (p - Point(0.4, 0.4, 0.4)).norm(); });
    CHECK_THROWS_AS(refine(mesh, vanishing, {.max_iterations = 1000}), InputError);
    check_valid(mesh, 1);
}
