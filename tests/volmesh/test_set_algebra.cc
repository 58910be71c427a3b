#include <algorithm>
#include <random>
#include <set>

#include <doctest/doctest.h>

#include "tests/support/kuhn.hh"
#include "tests/support/random_sets.hh"
#include "volmesh/measure.hh"
#include "volmesh/set_algebra.hh"

using namespace maille;
using namespace maille::volmesh;

namespace {

/// An entity as the sorted numbers of its vertices, whatever its kind.
using Corners = std::vector<std::uint32_t>;

Corners corners_of(const auto& vertices) {
    Corners corners;
    for (VertexHandle v : vertices) corners.push_back(v.idx());
    std::ranges::sort(corners);
    return corners;
}

/// The members of a set by what the mesh says entity by entity.
std::set<Corners> members(const TetMesh& mesh, SetHandle s) {
    std::set<Corners> all;
    const EntityKind kind = mesh.set_info(s).kind;
    if (kind == EntityKind::vertex)
        for (auto v : mesh.vertices())
            if (mesh.contains(s, VertexHandle(v))) all.insert({v.idx()});
    if (kind == EntityKind::edge)
        for (auto e : mesh.edges())
            if (mesh.contains(s, EdgeHandle(e))) all.insert(corners_of(e.vertices()));
    if (kind == EntityKind::face)
        for (auto f : mesh.faces())
            if (mesh.contains(s, FaceHandle(f))) all.insert(corners_of(f.vertices()));
    if (kind == EntityKind::cell)
        for (auto c : mesh.cells())
            if (mesh.contains(s, CellHandle(c))) all.insert(corners_of(c.vertices()));
    return all;
}

/// All that have so many of the corners of a member.
std::set<Corners> parts(const std::set<Corners>& of, std::size_t n) {
    std::set<Corners> all;
    for (const Corners& corners : of)
        for (unsigned mask = 0; mask < 16; ++mask) {
            Corners part;
            for (std::size_t i = 0; i < corners.size(); ++i)
                if ((mask >> i & 1U) != 0) part.push_back(corners[i]);
            if (part.size() == n) all.insert(part);
        }
    return all;
}

TetMesh mesh_with_sets(unsigned seed) {
    std::mt19937 random(seed);
    TetMesh mesh = test::kuhn_cube(2);
    for (std::uint32_t c : {3U, 17U, 30U}) mesh.delete_cell(CellHandle(c));
    test::add_random_sets(mesh, random);
    return mesh;
}

constexpr EntityKind kinds[] = {EntityKind::vertex, EntityKind::edge, EntityKind::face, EntityKind::cell};
const char* const endings[] = {" vertices", " edges", " faces", " cells"};

}  // namespace

TEST_CASE("union, intersection and difference are those of the members") {
    for (unsigned seed = 1; seed <= 5; ++seed)
        for (const EntityKind kind : kinds) {
            CAPTURE(seed);
            TetMesh mesh = mesh_with_sets(seed);
            const std::string ending = endings[static_cast<int>(kind)];
            const SetHandle a = mesh.find_set("plate/x+" + ending, kind);
            const SetHandle b = mesh.find_set("steel & \xc3\xa9t\xc3\xa9" + ending, kind);
            const SetHandle c = mesh.find_set("same", kind);
            const auto in_a = members(mesh, a);
            const auto in_b = members(mesh, b);
            const auto in_c = members(mesh, c);
            std::set<Corners> any = in_a;
            any.insert(in_b.begin(), in_b.end());
            any.insert(in_c.begin(), in_c.end());
            std::set<Corners> all;
            std::set<Corners> rest;
            for (const Corners& m : in_a) {
                if (in_b.contains(m) && in_c.contains(m)) all.insert(m);
                if (!in_b.contains(m) && !in_c.contains(m)) rest.insert(m);
            }
            CHECK(members(mesh, set_union(mesh, "any", {a, b, c})) == any);
            CHECK(members(mesh, set_intersection(mesh, "all", {a, b, c})) == all);
            CHECK(members(mesh, set_difference(mesh, "rest", a, {b, c})) == rest);
            CHECK(members(mesh, set_difference(mesh, "copy", a, {})) == in_a);
            CHECK(members(mesh, set_difference(mesh, "nothing", a, {a})).empty());
            CHECK(members(mesh, a) == in_a);
        }
}

TEST_CASE("closures are all parts of the members") {
    for (unsigned seed = 1; seed <= 3; ++seed) {
        TetMesh mesh = mesh_with_sets(seed);
        for (const EntityKind kind : kinds)
            for (const EntityKind part : kinds) {
                const SetHandle set = mesh.find_set("same", kind);
                const std::string name = "part " + std::to_string(int(kind)) + std::to_string(int(part));
                if (part >= kind) {
                    CHECK_THROWS_AS(set_closure(mesh, name, set, part), std::invalid_argument);
                    continue;
                }
                const auto wanted = parts(members(mesh, set), static_cast<std::size_t>(part) + 1);
                CHECK(members(mesh, set_closure(mesh, name, set, part)) == wanted);
            }
    }
}

TEST_CASE("the boundary of a set of cells has one member at each face, the skin one of each") {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        CAPTURE(seed);
        TetMesh mesh = mesh_with_sets(seed);
        const SetHandle a = mesh.find_set("plate/x+ cells", EntityKind::cell);
        const SetHandle b = mesh.find_set("same", EntityKind::cell);
        std::set<Corners> boundary;
        std::set<Corners> skin;
        for (auto f : mesh.faces()) {
            int n_in = 0;
            bool in_a_only = false;
            bool in_b_only = false;
            for (CellHandle c : f.cells()) {
                n_in += mesh.contains(a, c);
                in_a_only |= mesh.contains(a, c) && !mesh.contains(b, c);
                in_b_only |= mesh.contains(b, c) && !mesh.contains(a, c);
            }
            if (n_in == 1) boundary.insert(corners_of(f.vertices()));
            if (in_a_only && in_b_only) skin.insert(corners_of(f.vertices()));
        }
        CHECK(members(mesh, set_boundary(mesh, "boundary", a)) == boundary);
        CHECK(members(mesh, set_skin(mesh, "skin", a, b)) == skin);
        CHECK(members(mesh, set_skin(mesh, "the other way", b, a)) == skin);
    }
}

TEST_CASE("two halves of a cube: surfaces and edges have the areas and lengths that geometry gives") {
    TetMesh mesh = test::kuhn_cube(4);
    const auto below = [](double height) {
        return [=](auto c) {
            return std::ranges::all_of(c.vertices(), [=](auto v) { return v.point().z() <= height; });
        };
    };
    const SetHandle lower = set_where<CellHandle>(mesh, "lower", below(0.5));
    const SetHandle low = set_where<CellHandle>(mesh, "low", below(0.25));
    const SetHandle all = set_where<CellHandle>(mesh, "all", [](auto) { return true; });
    const SetHandle upper = set_difference(mesh, "upper", all, {lower});
    CHECK(measure(mesh, upper) == doctest::Approx(0.5).epsilon(1e-13));
    CHECK(measure(mesh, set_boundary(mesh, "around lower", lower)) == doctest::Approx(4).epsilon(1e-13));
    CHECK(measure(mesh, set_boundary(mesh, "around", all)) == doctest::Approx(6).epsilon(1e-13));
    const SetHandle between = set_skin(mesh, "between", lower, upper);
    CHECK(measure(mesh, between) == doctest::Approx(1).epsilon(1e-13));
    CHECK(mesh.set_size(set_skin(mesh, "none", low, upper)) == 0);
    CHECK(mesh.set_size(set_closure(mesh, "corners", between, EntityKind::vertex)) == 25);
    const SetHandle rim = set_where<EdgeHandle>(mesh, "rim", [](auto e) {
        return e.is_boundary() &&
               std::ranges::all_of(e.vertices(), [](auto v) { return v.point().z() == 0.5; });
    });
    CHECK(measure(mesh, rim) == doctest::Approx(4).epsilon(1e-13));
    const SetHandle right = set_where<FaceHandle>(mesh, "right", [](auto f) {
        return std::ranges::all_of(f.vertices(), [](auto v) { return v.point().x() == 1; });
    });
    CHECK(measure(mesh, right) == doctest::Approx(1).epsilon(1e-13));
    const SetHandle near =
        set_where<VertexHandle>(mesh, "near", [](auto v) { return v.point().norm() < 0.3; });
    CHECK(mesh.set_size(near) == 4);
}

TEST_CASE("sets of the wrong kind, or of a name that is taken, are refused") {
    TetMesh mesh = mesh_with_sets(1);
    const SetHandle cells = mesh.find_set("same", EntityKind::cell);
    const SetHandle faces = mesh.find_set("same", EntityKind::face);
    CHECK_THROWS_AS(set_union(mesh, "x", {cells, faces}), std::invalid_argument);
    CHECK_THROWS_AS(set_union(mesh, "x", {}), std::invalid_argument);
    CHECK_THROWS_AS(set_union(mesh, "same", {cells}), std::invalid_argument);
    CHECK_THROWS_AS(set_boundary(mesh, "x", faces), std::invalid_argument);
    CHECK_THROWS_AS(set_skin(mesh, "x", cells, faces), std::invalid_argument);
    CHECK_THROWS_AS(set_union(mesh, "x", {SetHandle(999)}), std::invalid_argument);
}
