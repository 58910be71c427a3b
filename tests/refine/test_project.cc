#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "meshes.hh"
#include "quality/boundary_projection.hh"
#include "quality/relocate.hh"
#include "refine/refine.hh"
#include "volmesh/error.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

using namespace maille::refine;
using maille::quality::ShortOfTarget;
using maille::volmesh::EntityKind;
using maille::volmesh::Projector;
using test::Soup;

namespace {

/// Puts each boundary face into the face set that `name` gives for its centroid; no set for an empty name.
void name_faces(TetMesh& mesh, const std::function<std::string(const Point&)>& name) {
    for (const auto hf : mesh.boundary_halffaces()) {
        Point sum = Point::Zero();
        for (const auto v : hf.vertices()) sum += mesh.point(v);
        const std::string set_name = name(sum / 3);
        if (set_name.empty()) continue;
        auto set = mesh.find_set(set_name, EntityKind::face);
        if (!set.is_valid()) set = mesh.add_set(set_name, EntityKind::face);
        mesh.insert(set, maille::volmesh::HalffaceHandle(hf));
    }
}

void check_valid(const TetMesh& mesh) {
    const auto validation = maille::volmesh::validate(mesh);
    if (!validation.ok()) MESSAGE(validation.errors.front());
    CHECK(validation.ok());
}

/// [-1,1]^3, drawn so that its boundary's nodes lie on the unit sphere.
TetMesh ball(int n) {
    Soup soup = test::kuhn_cube(n);
    for (Point& p : soup.points) {
        p = 2 * p - Point::Ones();
        if (p.norm() > 0) p *= p.cwiseAbs().maxCoeff() / p.norm();
    }
    for (auto& t : soup.tets) test::orient(soup.points, t);
    TetMesh mesh = soup.mesh();
    name_faces(mesh, [](const Point&) { return "ball/surface"; });
    return mesh;
}

Point on_sphere(const Point& p, double radius) {
    return radius * p.normalized();
}

Projector ball_projector() {
    return {{"ball/surface"}, [](auto, const Point& p) { return on_sphere(p, 1); }, 2 * std::sqrt(3.0)};
}

double distance_from_sphere(const TetMesh& mesh, const std::string& set, double radius) {
    double farthest = 0;
    for (const auto hf : mesh.face_members(mesh.find_set(set, EntityKind::face)))
        for (const auto v : mesh.halfface_vertices(hf))
            farthest = std::max(farthest, std::abs(mesh.point(v).norm() - radius));
    return farthest;
}

/// A cylinder of radius 1 and height 2 about the z axis.
TetMesh cylinder(int n) {
    Soup soup = test::kuhn_cube(n);
    for (Point& p : soup.points) {
        p = 2 * p - Point::Ones();
        const double r = std::hypot(p.x(), p.y());
        if (r > 0) p.head<2>() *= p.head<2>().cwiseAbs().maxCoeff() / r;
    }
    for (auto& t : soup.tets) test::orient(soup.points, t);
    TetMesh mesh = soup.mesh();
    name_faces(mesh, [](const Point& p) {
        return p.z() > 0.999 ? "c/top" : p.z() < -0.999 ? "c/bottom" : "c/side";
    });
    return mesh;
}

Projector cylinder_projector() {
    const auto project = [](std::span<const std::uint32_t> surfaces, const Point& p) -> std::optional<Point> {
        Point q = p;
        for (const std::uint32_t s : surfaces) {
            if (s == 0) q.head<2>().normalize();
            if (s == 1) q.z() = 1;
            if (s == 2) q.z() = -1;
        }
        if (std::ranges::count(surfaces, 1U) > 0 && std::ranges::count(surfaces, 2U) > 0) return std::nullopt;
        return q;
    };
    return {{"c/side", "c/top", "c/bottom"}, project, std::sqrt(12.0)};
}

/// The cube [-1,1]^3 less a ball: its cells are those of n^3 bricks outside the inner cube of the bricks, of
/// which one layer is left on each side. The nodes of the cavity are drawn onto the sphere.
TetMesh cube_with_cavity(int n, double radius) {
    Soup soup = test::kuhn_cube(n);
    const double inner = 1 - 2.0 / n;
    const auto box_norm = [](const Point& p) { return p.cwiseAbs().maxCoeff(); };
    for (Point& p : soup.points) p = 2 * p - Point::Ones();
    std::erase_if(soup.tets, [&](const test::Tet& t) {
        Point sum = Point::Zero();
        for (const auto v : t) sum += soup.points[v];
        return box_norm(sum / 4) < inner;
    });
    std::vector<std::uint32_t> index(soup.points.size(), 0);
    Soup cut;
    for (const auto& t : soup.tets)
        for (const auto v : t) index[v] = 1;
    for (std::size_t i = 0; i < index.size(); ++i) {
        if (index[i] == 0) continue;
        index[i] = static_cast<std::uint32_t>(cut.points.size());
        const Point& p = soup.points[i];
        cut.points.push_back(box_norm(p) < inner + 1e-9 ? on_sphere(p, radius) : p);
    }
    for (const auto& t : soup.tets) {
        test::Tet moved{};
        for (int i = 0; i < 4; ++i) moved[i] = index[t[i]];
        cut.tets.push_back(moved);
    }
    TetMesh mesh = cut.mesh();
    name_faces(mesh, [&](const Point& p) { return box_norm(p) > 0.9999 ? "box" : "hole"; });
    return mesh;
}

Projector cavity_projector(double radius) {
    return {{"hole"}, [radius](auto, const Point& p) { return on_sphere(p, radius); }, 2 * std::sqrt(3.0)};
}

}  // namespace

TEST_CASE("refined with its projector, a polyhedron becomes a ball, to second order") {
    const Projector projector = ball_projector();
    double before = 0;
    for (const double h : {0.4, 0.2, 0.1}) {
        TetMesh mesh = ball(2);
        check_valid(mesh);
        const RefineResult result = refine(mesh, SizeField(h), {}, &projector);
        CHECK(result.ended);
        CHECK(result.projection.moved > 0);
        CHECK(result.projection.short_of_target.empty());
        check_valid(mesh);
        CHECK(distance_from_sphere(mesh, "ball/surface", 1) < 1e-10);
        const double error = 4 * std::numbers::pi / 3 - maille::volmesh::volume(mesh);
        CHECK(error > 0);
        if (before > 0) CHECK(before / error == doctest::Approx(4).epsilon(0.3));
        before = error;
    }
}

TEST_CASE("the nodes of a rim lie on both of its surfaces") {
    const Projector projector = cylinder_projector();
    TetMesh mesh = cylinder(2);
    const RefineResult result = refine(mesh, SizeField(0.15), {}, &projector);
    CHECK(result.projection.short_of_target.empty());
    check_valid(mesh);
    std::vector<int> on(mesh.n_vertices());
    for (const char* name : {"c/side", "c/top", "c/bottom"})
        for (const auto hf : mesh.face_members(mesh.find_set(name, EntityKind::face)))
            for (const auto v : mesh.halfface_vertices(hf)) {
                const Point& p = mesh.point(v);
                if (std::string(name) == "c/side") {
                    CHECK(std::abs(std::hypot(p.x(), p.y()) - 1) < 1e-10);
                    on[v.idx()] |= 1;
                } else {
                    CHECK(std::abs(p.z()) == 1);
                    on[v.idx()] |= 2;
                }
            }
    CHECK(std::ranges::count(on, 3) > 2 * 30);
    const double expected = 2 * std::numbers::pi;
    CHECK(maille::volmesh::volume(mesh) == doctest::Approx(expected).epsilon(0.01));
}

TEST_CASE("nodes that move into the material don't invert it") {
    // The walls at the middle of the faces get thinner and thinner.
    for (const double radius : {0.5, 0.8, 0.9, 0.95}) {
        CAPTURE(radius);
        const Projector projector = cavity_projector(radius);
        TetMesh mesh = cube_with_cavity(4, radius);
        check_valid(mesh);
        const RefineResult result = refine(mesh, SizeField(0.2), {}, &projector);
        check_valid(mesh);
        CHECK(result.ended);
        CHECK(result.projection.short_of_target.size() == 0);
        CHECK(distance_from_sphere(mesh, "hole", radius) < 1e-10);
        const double expected = 8 - 4 * std::numbers::pi / 3 * std::pow(radius, 3);
        CHECK(maille::volmesh::volume(mesh) == doctest::Approx(expected).epsilon(0.02));
    }
}

TEST_CASE("where walls are too thin for the start mesh, what falls short is named") {
    const double radius = 0.98;
    const Projector projector = cavity_projector(radius);
    TetMesh mesh = cube_with_cavity(4, radius);
    const RefineResult result = refine(mesh, SizeField(0.2), {}, &projector);
    check_valid(mesh);
    const auto& named = result.projection.short_of_target;
    CHECK(std::ranges::is_sorted(named, {}, &ShortOfTarget::vertex));
    for (const auto hf : mesh.face_members(mesh.find_set("hole", EntityKind::face)))
        for (const auto v : mesh.halfface_vertices(hf))
            if (!std::ranges::binary_search(named, v, {}, &ShortOfTarget::vertex))
                CHECK(std::abs(mesh.point(v).norm() - radius) < 1e-10);
    for (const ShortOfTarget& left : named) {
        CHECK(left.place == mesh.point(left.vertex));
        CHECK(left.surfaces == std::vector<std::string>{"hole"});
        REQUIRE(left.distance.has_value());
        CHECK(*left.distance == doctest::Approx(std::abs(left.place.norm() - radius)));
        CHECK(*left.distance < 0.1);
    }
}

TEST_CASE("a start mesh that is off its surface is brought there, though nothing is refined") {
    const Projector projector = ball_projector();
    TetMesh mesh = ball(4);
    for (const auto v : mesh.vertices())
        if (v.is_boundary()) mesh.set_point(VertexHandle(v), 0.95 * v.point());
    const RefineResult result = refine(mesh, SizeField(10), {}, &projector);
    CHECK(result.iterations == 0);
    CHECK(result.projection.moved == 98);
    CHECK(distance_from_sphere(mesh, "ball/surface", 1) < 1e-12);
    check_valid(mesh);
}

TEST_CASE("without projection nothing moves") {
    const Projector projector = ball_projector();
    TetMesh mesh = ball(2);
    const double volume = maille::volmesh::volume(mesh);
    const RefineResult result = refine(mesh, SizeField(0.3), {.project = false}, &projector);
    CHECK(result.projection.moved == 0);
    CHECK(maille::volmesh::volume(mesh) == doctest::Approx(volume).epsilon(1e-12));
}

TEST_CASE("a vertex that cannot get there is named, and nothing is broken for it") {
    // The target is behind the far side of the cube.
    const Projector absurd{{"low"}, [](auto, const Point& p) { return Point(p.x(), p.y(), 3); }, 1};
    TetMesh mesh = test::kuhn_cube(2).mesh();
    name_faces(mesh, [](const Point& p) { return p.z() < 1e-9 ? "low" : ""; });
    const RefineResult result = refine(mesh, SizeField(0.5), {}, &absurd);
    check_valid(mesh);
    CHECK_FALSE(result.projection.short_of_target.empty());
    for (const ShortOfTarget& left : result.projection.short_of_target) {
        CHECK(left.place.z() < 1);
        CHECK(*left.distance == doctest::Approx(3 - left.place.z()));
        CHECK(left.surfaces == std::vector<std::string>{"low"});
    }

    const Projector silent{{"low"}, [](auto, const Point&) { return std::nullopt; }, 1};
    TetMesh other = test::kuhn_cube(2).mesh();
    name_faces(other, [](const Point& p) { return p.z() < 1e-9 ? "low" : ""; });
    const auto unknown = refine(other, SizeField(10), {}, &silent).projection.short_of_target;
    CHECK(unknown.size() == 9);
    for (const ShortOfTarget& left : unknown) CHECK_FALSE(left.distance.has_value());
}

TEST_CASE("no move onto a surface leaves less shape than allowed") {
    // The wall between box and hole grows so thin that cells have to give way.
    const double radius = 0.9;
    const Projector projector = cavity_projector(radius);
    const auto shape_of = [](const TetMesh& mesh, CellHandle c) {
        const auto p = mesh.cell_points(c);
        return maille::quality::exact_gamma(p[0], p[1], p[2], p[3]);
    };
    std::vector<std::size_t> n_short;
    for (const double min_shape : {0.6, 0.3, 0.0005}) {
        TetMesh mesh = cube_with_cavity(4, 0.6);
        const TetMesh before = mesh;
        std::vector<CellHandle> all;
        for (const auto c : mesh.cells()) all.push_back(c);
        maille::quality::BoundaryProjection projection(mesh, projector, min_shape);
        projection.take_up(0, all);
        projection.run();
        projection.insist();
        double worst = 1;
        for (const CellHandle c : all) worst = std::min(worst, shape_of(before, c));
        for (const CellHandle c : all) CHECK(shape_of(mesh, c) >= std::min(min_shape, worst) * (1 - 1e-12));
        n_short.push_back(projection.n_waiting());
        CHECK(projection.short_of_target().size() == projection.n_waiting());
    }
    CHECK(std::ranges::is_sorted(n_short, std::ranges::greater()));
    CHECK(n_short.front() > 0);
    TetMesh mesh = cube_with_cavity(4, 0.6);
    for (const double bad : {0.0, -1.0, 1.5, std::nan("")})
        CHECK_THROWS_AS(refine(mesh, SizeField(1), {.min_shape = bad}, &projector), maille::InputError);
}

TEST_CASE("smoothing moves nodes, but neither the boundary nor what divides the sets") {
    const Soup soup = test::random_cube(3, 21, 0.4);
    const SizeField size(0.15);
    TetMesh plain = soup.mesh(), smoothed = soup.mesh();
    for (TetMesh* mesh : {&plain, &smoothed}) {
        const auto half = mesh->add_set("half", EntityKind::cell);
        for (const auto c : mesh->cells())
            if (c.idx() % 2 == 0) mesh->insert(half, CellHandle(c));
    }
    refine(plain, size);
    const RefineResult result = refine(smoothed, size, {.smooth = true});
    check_valid(smoothed);
    CHECK(result.ended);
    CHECK_FALSE(std::ranges::equal(plain.points(), smoothed.points()));
    const auto half = [](const TetMesh& mesh) {
        return maille::volmesh::measure(mesh, mesh.find_set("half", EntityKind::cell));
    };
    CHECK(half(smoothed) == doctest::Approx(half(plain)).epsilon(1e-12));
    CHECK(maille::volmesh::volume(smoothed) == doctest::Approx(1).epsilon(1e-12));
}
