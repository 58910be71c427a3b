#include <bit>
#include <fstream>
#include <iterator>
#include <map>
#include <random>

#include <doctest/doctest.h>

#include "tests/support/kuhn.hh"
#include "tests/support/random_sets.hh"
#include "volmesh/error.hh"
#include "volmesh/io/mesh_io.hh"
#include "volmesh/validate.hh"

using namespace maille;
using namespace maille::volmesh;

namespace {

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::uint64_t bits(double x) {
    return std::bit_cast<std::uint64_t>(x);
}

using Members = std::map<std::pair<EntityKind, std::string>, std::vector<std::uint32_t>>;

/// By kind and name, each member as the indices of vertices or of cell and local number: the same in the same
/// mesh.
Members members_of(const TetMesh& mesh) {
    Members members;
    for (std::uint32_t i = 0; i < mesh.n_sets(); ++i) {
        const SetHandle s(i);
        auto& list = members[{mesh.set_info(s).kind, mesh.set_info(s).name}];
        switch (mesh.set_info(s).kind) {
            case EntityKind::vertex:
                for (auto v : mesh.vertex_members(s)) list.push_back(v.idx());
                break;
            case EntityKind::edge:
                for (auto [c, e] : mesh.edge_members(s)) list.push_back(6 * c.idx() + e);
                break;
            case EntityKind::face:
                for (auto hf : mesh.face_members(s)) list.push_back(hf.idx());
                break;
            case EntityKind::cell:
                for (auto c : mesh.cell_members(s)) list.push_back(c.idx());
                break;
        }
    }
    return members;
}

void require_same(const TetMesh& a, const TetMesh& b) {
    REQUIRE(a.n_vertices() == b.n_vertices());
    REQUIRE(a.n_cells() == b.n_cells());
    std::size_t n_different = 0;
    for (std::uint32_t v = 0; v < a.n_vertices(); ++v)
        for (int k = 0; k < 3; ++k) n_different += bits(a.points()[v][k]) != bits(b.points()[v][k]);
    CHECK(n_different == 0);
    CHECK(std::ranges::equal(a.cell_vertex_indices(), b.cell_vertex_indices()));
    CHECK(members_of(a) == members_of(b));
}

template <class Entity, class T>
void require_same_property(const TetMesh& a, const TetMesh& b, const std::string& name, std::uint32_t n) {
    PropertyHandle<Entity, T> of_a;
    PropertyHandle<Entity, T> of_b;
    REQUIRE(a.get_property_handle(of_a, name));
    REQUIRE(b.get_property_handle(of_b, name));
    for (std::uint32_t i = 0; i < n; ++i) REQUIRE(a.property(of_a, Entity(i)) == b.property(of_b, Entity(i)));
}

template <class Entity>
void add_properties(TetMesh& mesh, std::uint32_t n, std::mt19937& random) {
    std::normal_distribution<double> any;
    PropertyHandle<Entity, double> real;
    PropertyHandle<Entity, float> single;
    PropertyHandle<Entity, std::int32_t> whole;
    PropertyHandle<Entity, Eigen::Vector3d> vector;
    mesh.add_property(real, "real <1>");
    mesh.add_property(single, "single");
    mesh.add_property(whole, "whole");
    mesh.add_property(vector, "vector");
    for (std::uint32_t i = 0; i < n; ++i) {
        mesh.property(real, Entity(i)) = any(random);
        mesh.property(single, Entity(i)) = static_cast<float>(any(random));
        mesh.property(whole, Entity(i)) = static_cast<std::int32_t>(random());
        mesh.property(vector, Entity(i)) = Eigen::Vector3d(any(random), any(random), any(random));
    }
}

template <class Entity>
void require_same_properties(const TetMesh& a, const TetMesh& b, std::uint32_t n) {
    require_same_property<Entity, double>(a, b, "real <1>", n);
    require_same_property<Entity, float>(a, b, "single", n);
    require_same_property<Entity, std::int32_t>(a, b, "whole", n);
    require_same_property<Entity, Eigen::Vector3d>(a, b, "vector", n);
}

TetMesh random_mesh(int n, std::mt19937& random) {
    TetMesh mesh = test::kuhn_cube(n);
    test::shake(mesh, 0.1 / n, random);
    test::add_random_sets(mesh, random);
    return mesh;
}

struct Way {
    const char* file;
    const char* format;
    bool has_properties;
};

constexpr Way ways[] = {{"a.vtu", "", true},   {"a.msh", "", true},   {"a.msh", "msh22", true},
                        {"a.mesh", "", false}, {"a.inp", "", false},  {"a.node", "", false},
                        {"a.ele", "", false},  {"a.mfem", "", false}, {"a.e", "", false}};

}  // namespace

TEST_CASE("every format gives back the same mesh, sets and properties") {
    const test::TemporaryFolder folder;
    for (unsigned seed = 1; seed <= 3; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        TetMesh mesh = random_mesh(static_cast<int>(seed) + 1, random);
        add_properties<VertexHandle>(mesh, mesh.n_vertices(), random);
        add_properties<CellHandle>(mesh, mesh.n_cells(), random);
        for (const Way& way : ways) {
            CAPTURE(way.file);
            CAPTURE(way.format);
            write_mesh(mesh, folder / way.file, {way.format});
            const TetMesh back = read_mesh(folder / way.file);
            CHECK(validate(back).ok());
            require_same(mesh, back);
            if (!way.has_properties) continue;
            require_same_properties<VertexHandle>(mesh, back, mesh.n_vertices());
            require_same_properties<CellHandle>(mesh, back, mesh.n_cells());
        }
    }
}

TEST_CASE("the same mesh gives the same bytes, however its sets came about") {
    const test::TemporaryFolder folder;
    std::mt19937 random(7);
    const TetMesh mesh = random_mesh(2, random);
    for (const Way& way : ways) {
        CAPTURE(way.file);
        const std::string file = way.file;
        write_mesh(mesh, folder / file, {way.format});
        const std::string extension = file.substr(1);
        // What is read has its combinations of sets numbered in another order.
        write_mesh(read_mesh(folder / file), folder / ("b" + extension), {way.format});
        CHECK(bytes_of(folder / file) == bytes_of(folder / ("b" + extension)));
    }
}

TEST_CASE("deleted cells are left out") {
    const test::TemporaryFolder folder;
    std::mt19937 random(11);
    TetMesh mesh = random_mesh(2, random);
    mesh.delete_cell(CellHandle(0));
    mesh.delete_cell(CellHandle(17));
    TetMesh kept = mesh;
    kept.garbage_collection();
    for (const Way& way : ways) {
        write_mesh(mesh, folder / way.file, {way.format});
        require_same(kept, read_mesh(folder / way.file));
    }
}

TEST_CASE("an empty mesh, and vertices without cells, survive") {
    const test::TemporaryFolder folder;
    TetMesh lonely;
    lonely.add_vertex({1, 2, 3});
    for (const TetMesh& mesh : {TetMesh(), lonely}) {
        for (const Way& way : ways) {
            CAPTURE(way.file);
            write_mesh(mesh, folder / way.file, {way.format});
            require_same(mesh, read_mesh(folder / way.file));
        }
    }
}

TEST_CASE("numbers at the limits of double survive") {
    const test::TemporaryFolder folder;
    const double tiny = std::numeric_limits<double>::denorm_min();
    const TetMesh mesh = TetMesh::from_cells(
        {{-0.0, tiny, 0.1}, {1e300, 0, 0.1}, {0, 1.0 / 3, 0.1}, {0, 0, 1e-300 + 1}}, {{0, 1, 2, 3}});
    for (const Way& way : ways) {
        CAPTURE(way.file);
        write_mesh(mesh, folder / way.file, {way.format});
        require_same(mesh, read_mesh(folder / way.file));
    }
}

TEST_CASE("a file is written whole or not at all") {
    const test::TemporaryFolder folder;
    const TetMesh mesh = test::kuhn_cube(1);
    CHECK_THROWS_AS(write_mesh(mesh, folder / "missing/a.vtu"), InputError);
    CHECK_THROWS_AS(write_mesh(mesh, folder / "a.xyz"), InputError);
    CHECK_THROWS_AS(write_mesh(mesh, folder / "a.vtu", {"msh22"}), InputError);
    TetMesh quoted = mesh;
    quoted.add_set("a \"quoted\" name", EntityKind::cell);
    CHECK_THROWS_AS(write_mesh(quoted, folder / "a.msh"), InputError);
    CHECK(std::filesystem::is_empty(folder.path()));
    CHECK_THROWS_AS(read_mesh(folder / "a.vtu"), InputError);
    CHECK_THROWS_AS(read_mesh(folder.path()), InputError);
}

TEST_CASE("an Abaqus file of others keeps its sets") {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "a.inp") << R"(*Heading
 two tetrahedra on a triangle
*Node, nset="All of them"
10, 0., 0., 0.
11, 1., 0., 0.
12, 0., 1., 0.
13, 0., 0., 1.
20, 0., 0., -1.
*Element, type=C3D4, elset=Upper
1, 10, 11,
12, 13
*Element, type=C3D4, elset=lower
2, 10, 12, 11, 20
*Element, type=S3
7, 12, 11, 10
*Element, type=T3D2, elset=bar
8, 10, 13
*Nset, nset=Middle, generate
10, 12, 1
*Nset, nset=more
middle, 13
*Elset, elset=both
UPPER, lower
*Elset, elset=skin
7
*Surface, type=ELEMENT, name=slanted
Upper, S3
2, S2
*Surface, type=NODE, name=tips
13,
20
*Material, name=steel
*Elastic
210000., 0.3
)";
    const TetMesh mesh = read_mesh(folder / "a.inp");
    CHECK(mesh.n_vertices() == 5);
    CHECK(mesh.n_cells() == 2);
    const auto sizes = [&] {
        std::map<std::pair<EntityKind, std::string>, std::size_t> result;
        for (std::uint32_t i = 0; i < mesh.n_sets(); ++i)
            result[{mesh.set_info(SetHandle(i)).kind, mesh.set_info(SetHandle(i)).name}] =
                mesh.set_size(SetHandle(i));
        return result;
    }();
    const decltype(sizes) wanted{
        {{EntityKind::vertex, "All of them"}, 5}, {{EntityKind::vertex, "Middle"}, 3},
        {{EntityKind::vertex, "more"}, 4},        {{EntityKind::vertex, "tips"}, 2},
        {{EntityKind::edge, "bar"}, 1},           {{EntityKind::face, "skin"}, 1},
        {{EntityKind::face, "slanted"}, 2},       {{EntityKind::cell, "Upper"}, 1},
        {{EntityKind::cell, "lower"}, 1},         {{EntityKind::cell, "both"}, 2}};
    CHECK(sizes == wanted);
    const HalffaceHandle slanted = mesh.find_halfface(VertexHandle(1), VertexHandle(2), VertexHandle(3));
    CHECK(std::ranges::count(mesh.sets_of(mesh.combination(slanted)),
                             mesh.find_set("slanted", EntityKind::face)) == 1);
}

TEST_CASE("others' files of MFEM's are read with their groups") {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "a.mfem")
        << "MFEM mesh v1.3\n\n# a comment\ndimension\n3\n\nelements\n2\n10 4 0 1 2 3\n"
           "20 4 1 2 3 4\n\nattribute_sets\n2\n\"Both of it\" 2 10 20\nUpper 1\n20\n"
           "\nboundary\n2\n7 2 0 2 1\n8 2 0 1 3\n\nbdr_attribute_sets\n1\n\"Floor\"\n1\n7\n"
           "\nvertices\n5\n3\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n\nmfem_mesh_end\n";
    const TetMesh mesh = read_mesh(folder / "a.mfem");
    CHECK(validate(mesh).ok());
    const auto size = [&](const char* name, EntityKind kind) {
        return mesh.set_size(mesh.find_set(name, kind));
    };
    CHECK(mesh.n_sets() == 4);
    CHECK(size("Both of it", EntityKind::cell) == 2);
    CHECK(size("Upper", EntityKind::cell) == 1);
    CHECK(size("Floor", EntityKind::face) == 1);
    CHECK(size("group8", EntityKind::face) == 1);
}

TEST_CASE("names that a format cannot hold are refused") {
    const test::TemporaryFolder folder;
    TetMesh mesh = test::kuhn_cube(1);
    mesh.add_set("a \"quote\"", EntityKind::cell);
    CHECK_THROWS_AS(write_mesh(mesh, folder / "a.mfem"), InputError);
    TetMesh with_long_name = test::kuhn_cube(1);
    with_long_name.add_set(std::string(300, 'x'), EntityKind::face);
    CHECK_THROWS_AS(write_mesh(with_long_name, folder / "a.e"), InputError);
    CHECK(std::filesystem::is_empty(folder.path()));
}
