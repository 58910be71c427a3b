#include <fstream>
#include <iterator>
#include <random>

#include <doctest/doctest.h>

#include "tests/support/kuhn.hh"
#include "tests/support/messages.hh"
#include "tests/support/random_sets.hh"
#include "volmesh/io/mesh_io.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

using namespace maille;
using namespace maille::volmesh;

namespace {

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Edges and faces numbered in an order that files don't have.
TetMesh split_cube() {
    TetMesh mesh = test::kuhn_cube(2);
    mesh.request_edges();
    mesh.request_faces();
    for (std::uint32_t c : {5U, 20U, 33U}) mesh.split_edge(CellHandle(c), 3);
    return mesh;
}

/// A number that tells an entity by the places of its vertices.
double mark_of(const TetMesh& mesh, const auto& vertices) {
    double sum = 0;
    for (VertexHandle v : vertices)
        sum += mesh.point(v).dot(Point(1, 0.37, 0.11)) * mesh.point(v).dot(Point(0.2, 0.5, 1));
    return sum;
}

std::string with(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("rules of sets are kept, and a refined mesh goes on as if it had never been away") {
    const test::TemporaryFolder folder;
    for (const auto& [extension, format] : {std::pair(".vtu", ""),
                                            {".msh", ""},
                                            {".msh", "msh22"},
                                            {".mesh", ""},
                                            {".node", ""},
                                            {".inp", ""},
                                            {".mfem", ""},
                                            {".e", ""}}) {
        CAPTURE(extension);
        TetMesh mesh = test::kuhn_cube(2);
        const auto late =
            mesh.add_set("late", EntityKind::cell);  // shares its name with a set that has a source
        const auto wall = mesh.add_set("wall x-", EntityKind::face);
        const auto rim = mesh.add_set("rim", EntityKind::edge, SetRule::none());
        const auto fixed = mesh.add_set("late", EntityKind::vertex, SetRule::from_faces(wall));
        mesh.add_set("from rim", EntityKind::vertex, SetRule::from_edges(rim));
        mesh.add_set("both", EntityKind::vertex, SetRule::both_ends());
        mesh.add_set("both in late", EntityKind::vertex, SetRule::both_ends(late));
        const auto long_name = mesh.add_set(std::string(200, 'n') + "  | end", EntityKind::face);
        mesh.add_set("of a long name", EntityKind::vertex, SetRule::from_faces(long_name));
        mesh.add_set("own", EntityKind::cell, SetRule::custom([](auto&&...) { return true; }));
        mesh.add_set("load", EntityKind::vertex);
        for (auto hf : mesh.boundary_halffaces())
            if (std::ranges::all_of(hf.vertices(), [](auto v) { return v.point().x() == 0; }))
                mesh.insert(wall, HalffaceHandle(hf));
        mesh.insert(late, CellHandle(3));
        for (auto v : mesh.vertices())
            if (v.point().x() == 0) mesh.insert(fixed, VertexHandle(v));

        write_mesh(mesh, folder / ("a" + std::string(extension)), {format});
        TetMesh back = read_mesh(folder / ("a" + std::string(extension)));
        REQUIRE(back.n_sets() == mesh.n_sets());
        for (std::uint32_t i = 0; i < mesh.n_sets(); ++i) {
            const SetInfo& was = mesh.set_info(SetHandle(i));
            const SetInfo& is = back.set_info(back.find_set(was.name, was.kind));
            CAPTURE(was.name);
            const bool is_own = was.rule.kind == SetRule::Kind::custom;
            CHECK(is.rule.kind == (is_own ? SetRule::Kind::copy : was.rule.kind));
            REQUIRE(is.rule.source.is_valid() == was.rule.source.is_valid());
            if (was.rule.source.is_valid()) {
                CHECK(back.set_info(is.rule.source).name == mesh.set_info(was.rule.source).name);
                CHECK(back.set_info(is.rule.source).kind == mesh.set_info(was.rule.source).kind);
            }
        }
        write_mesh(back, folder / ("b" + std::string(extension)), {format});
        CHECK(bytes_of(folder / ("a" + std::string(extension))) ==
              bytes_of(folder / ("b" + std::string(extension))));

        // Split all edges of the wall: the same vertices are fixed in both.
        for (TetMesh* m : {&mesh, &back})
            for (int i = 0; i < 20; ++i) {
                const auto walls = m->face_members(m->find_set("wall x-", EntityKind::face));
                const HalffaceHandle hf = walls[i % walls.size()];
                m->split_edge(TetMesh::incident_cell(hf), tet::face_edges[TetMesh::local_face(hf)][i % 3]);
            }
        CHECK(back.vertex_members(back.find_set("late", EntityKind::vertex)) == mesh.vertex_members(fixed));
        std::size_t n_on_wall = 0;
        for (auto v : mesh.vertices()) n_on_wall += v.point().x() == 0;
        CHECK(mesh.set_size(fixed) == n_on_wall);
    }
}

TEST_CASE(".vtu keeps properties of edges, faces and the mesh, with rules and defaults") {
    const test::TemporaryFolder folder;
    TetMesh mesh = split_cube();
    EPropHandleT<double> of_edge;
    FPropHandleT<Eigen::Vector3d> of_face;
    CPropHandleT<double> mass;
    CPropHandleT<std::int32_t> material;
    VPropHandleT<float> heat;
    MPropHandleT<std::string> title;
    mesh.add_property(of_edge, "of edge", PropertyRule::share, 0.25);
    mesh.add_property(of_face, "of face", PropertyRule::none, Eigen::Vector3d(1, 2, 3));
    mesh.add_property(mass, "mass", PropertyRule::share);
    mesh.add_property(material, "material", PropertyRule::none, -7);
    mesh.add_property(heat, "heat", PropertyRule::none, 0.1F);
    mesh.add_property(title, "title", "a \"plate\" <1>\n\xc3\xa9");
    MPropHandleT<double> time;
    MPropHandleT<float> step;
    MPropHandleT<std::int32_t> count;
    MPropHandleT<Eigen::Vector3d> gravity;
    mesh.add_property(time, "time", 0.1);
    mesh.add_property(step, "step", 0.1F);
    mesh.add_property(count, "count", -3);
    mesh.add_property(gravity, "gravity", Eigen::Vector3d(0, 0, -9.81));
    for (auto e : mesh.edges()) mesh.property(of_edge, e) = mark_of(mesh, e.vertices());
    for (auto f : mesh.faces()) mesh.property(of_face, f) = Point::Constant(mark_of(mesh, f.vertices()));
    for (auto c : mesh.cells()) mesh.property(mass, c) = volume(mesh, c);

    write_mesh(mesh, folder / "a.vtu");
    TetMesh back = read_mesh(folder / "a.vtu");
    CHECK(validate(back).ok());
    REQUIRE(back.get_property_handle(of_edge, "of edge"));
    REQUIRE(back.get_property_handle(of_face, "of face"));
    for (auto e : back.edges())
        CHECK(back.property(of_edge, e) == doctest::Approx(mark_of(back, e.vertices())).epsilon(1e-12));
    for (auto f : back.faces())
        CHECK(back.property(of_face, f).x() == doctest::Approx(mark_of(back, f.vertices())).epsilon(1e-12));
    REQUIRE(back.get_property_handle(title, "title"));
    CHECK(back.property(title) == mesh.property(title));
    REQUIRE(back.get_property_handle(time, "time"));
    REQUIRE(back.get_property_handle(step, "step"));
    REQUIRE(back.get_property_handle(count, "count"));
    REQUIRE(back.get_property_handle(gravity, "gravity"));
    CHECK(back.property(time) == 0.1);
    CHECK(back.property(step) == 0.1F);
    CHECK(back.property(count) == -3);
    CHECK(back.property(gravity).z() == -9.81);
    for (const EntityKind kind : {EntityKind::vertex, EntityKind::edge, EntityKind::face, EntityKind::cell})
        for (const auto& property : mesh.properties(kind).all()) {
            const auto& all = back.properties(kind).all();
            const auto same =
                std::ranges::find_if(all, [&](auto& p) { return p->name() == property->name(); });
            CAPTURE(property->name());
            REQUIRE(same != all.end());
            CHECK((*same)->type() == property->type());
            CHECK((*same)->rule() == property->rule());
            CHECK((*same)->default_text() == property->default_text());
        }
    write_mesh(back, folder / "b.vtu");
    CHECK(bytes_of(folder / "a.vtu") == bytes_of(folder / "b.vtu"));

    // The rules go on to act: a mass is shared, its sum stays.
    REQUIRE(back.get_property_handle(mass, "mass"));
    for (std::uint32_t c = 0; c < 30; ++c) back.split_edge(CellHandle(c), static_cast<int>(c % 6));
    double sum = 0;
    for (auto c : back.cells()) {
        CHECK(back.property(mass, c) == doctest::Approx(volume(back, c)).epsilon(1e-12));
        sum += back.property(mass, c);
    }
    CHECK(sum == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("rules of properties are kept in .msh") {
    const test::TemporaryFolder folder;
    TetMesh mesh = test::kuhn_cube(1);
    CPropHandleT<double> mass;
    VPropHandleT<double> heat;
    VPropHandleT<std::int32_t> count;
    VPropHandleT<Eigen::Vector3d> shift;
    mesh.add_property(mass, "mass", PropertyRule::share);
    mesh.add_property(heat, "heat", PropertyRule::none);
    mesh.add_property(count, "count");
    mesh.add_property(shift, "shift", PropertyRule::interpolate);
    for (const char* format : {"msh41", "msh22"}) {
        write_mesh(mesh, folder / "a.msh", {format});
        const TetMesh back = read_mesh(folder / "a.msh");
        for (const EntityKind kind : {EntityKind::vertex, EntityKind::cell})
            for (const auto& property : mesh.properties(kind).all()) {
                if (!property) continue;
                const auto& all = back.properties(kind).all();
                const auto same =
                    std::ranges::find_if(all, [&](auto& p) { return p->name() == property->name(); });
                CAPTURE(property->name());
                REQUIRE(same != all.end());
                CHECK((*same)->rule() == property->rule());
            }
        const std::string good = bytes_of(folder / "a.msh");
        std::ofstream(folder / "b.msh", std::ios::binary) << with(good, "\"mass\" share", "\"mass\" shave");
        CHECK(test::has(test::message([&] { read_mesh(folder / "b.msh"); }),
                        "'shave' is no rule of properties"));
    }
}

TEST_CASE("rules that mean nothing are refused, with the array named") {
    const test::TemporaryFolder folder;
    TetMesh mesh = test::kuhn_cube(1);
    const auto wall = mesh.add_set("wall", EntityKind::face);
    mesh.add_set("fixed", EntityKind::vertex, SetRule::from_faces(wall));
    CPropHandleT<double> mass;
    mesh.add_property(mass, "mass", PropertyRule::share);
    EPropHandleT<double> of_edge;
    mesh.add_property(of_edge, "of edge");
    write_mesh(mesh, folder / "a.vtu");
    const std::string good = bytes_of(folder / "a.vtu");
    const auto message = [&](const std::string& from, const std::string& to) {
        std::ofstream(folder / "b.vtu", std::ios::binary) << with(good, from, to);
        return test::message([&] { read_mesh(folder / "b.vtu"); });
    };
    const std::string rule = "vertex_rule=\"from_faces of face wall\"";
    CHECK(
        test::has(message(rule, "vertex_rule=\"by_magic\""), "array 'fixed': 'by_magic' is no rule of sets"));
    CHECK(test::has(message(rule, "vertex_rule=\"from_faces\""), "does not suit"));
    CHECK(test::has(message(rule, "vertex_rule=\"copy\""), "does not suit"));
    CHECK(test::has(message(rule, "vertex_rule=\"from_faces of face hall\""), "looks at a set 'hall'"));
    CHECK(test::has(message(rule, "vertex_rule=\"from_faces of vertex fixed\""), "looks at a set 'fixed'"));
    CHECK(test::has(message(rule, "vertex_rule=\"from_faces of room wall\""), "'room' is no kind of set"));
    CHECK(test::has(message("rule=\"share\"", "rule=\"shave\""),
                    "array 'mass': 'shave' is no rule of properties"));
    CHECK(test::has(message("rule=\"share\"", "rule=\"interpolate\""), "mass"));
    CHECK(test::has(message("of=\"edge\"", "of=\"face\""), "numbers for 18 entities"));
    CHECK(test::has(message("of=\"edge\"", "of=\"roof\""), "'roof'"));

    for (const auto& [file, mesh_file] : {std::pair("a.inp", "a.inp"), {"a.sets.json", "a.mesh"}}) {
        write_mesh(mesh, folder / mesh_file);
        const std::string damaged = with(bytes_of(folder / file), "from_faces of face wall", "by_magic");
        std::ofstream(folder / file, std::ios::binary) << damaged;
        const std::string got = test::message([&] { read_mesh(folder / mesh_file); });
        CAPTURE(got);
        CHECK(test::has(got, "'by_magic' is no rule of sets"));
        CHECK(test::has(got, file));
    }
}
