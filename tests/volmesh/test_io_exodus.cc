// Exodus files that are built on HDF5, as others write them.
#if __has_include(<exodusII.h>)

#include <cmath>
#include <fstream>
#include <iterator>
#include <random>

#include <doctest/doctest.h>

#include "tests/support/random_sets.hh"
#include "volmesh/error.hh"
#include "volmesh/io/exodus_library.hh"
#include "volmesh/io/mesh_io.hh"
#include "volmesh/measure.hh"

using namespace maille;
using namespace maille::volmesh;

namespace {

/// Two tetrahedra over the unit triangle, a block, a side set of the upper sides and a node set.
void write_by_library(const std::filesystem::path& path, int mode) {
    const io::ExodusLibrary& library = io::exodus_library();
    int word = sizeof(double);
    int stored_word = sizeof(double);
    const int file = library.create(path.c_str(), EX_CLOBBER | mode, &word, &stored_word, EX_API_VERS_NODOT);
    REQUIRE(file >= 0);
    ex_init_params sizes{};
    sizes.num_dim = 3;
    sizes.num_nodes = 5;
    sizes.num_elem = 2;
    sizes.num_elem_blk = 1;
    sizes.num_side_sets = 1;
    sizes.num_node_sets = 1;
    REQUIRE(library.put_init(file, &sizes) >= 0);
    const double x[] = {0, 1, 0, 0, 0}, y[] = {0, 0, 1, 0, 0}, z[] = {0, 0, 0, 1, -1};
    REQUIRE(library.put_coord(file, x, y, z) >= 0);
    REQUIRE(library.put_block(file, EX_ELEM_BLOCK, 10, "TETRA", 2, 4, 0, 0, 0) >= 0);
    REQUIRE(library.put_name(file, EX_ELEM_BLOCK, 10, "steel") >= 0);
    const int nodes[] = {1, 2, 3, 4, 1, 3, 2, 5};
    REQUIRE(library.put_conn(file, EX_ELEM_BLOCK, 10, nodes, nullptr, nullptr) >= 0);
    const int elements[] = {1, 1, 1}, sides[] = {1, 2, 3};
    REQUIRE(library.put_set_param(file, EX_SIDE_SET, 1, 3, 0) >= 0);
    REQUIRE(library.put_set(file, EX_SIDE_SET, 1, elements, sides) >= 0);
    REQUIRE(library.put_name(file, EX_SIDE_SET, 1, "upper") >= 0);
    const int tip[] = {4};
    REQUIRE(library.put_set_param(file, EX_NODE_SET, 7, 1, 0) >= 0);
    REQUIRE(library.put_set(file, EX_NODE_SET, 7, tip, nullptr) >= 0);
    REQUIRE(library.close(file) >= 0);
}

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("Exodus files built on HDF5 are read as those built on NetCDF") {
    const test::TemporaryFolder folder;
    for (const int mode : {0, EX_NETCDF4, EX_NETCDF4 | EX_NOCLASSIC}) {
        CAPTURE(mode);
        write_by_library(folder / "a.e", mode);
        CHECK((bytes_of(folder / "a.e").substr(1, 3) == "HDF") == (mode != 0));
        const TetMesh mesh = read_mesh(folder / "a.e");
        CHECK(mesh.n_cells() == 2);
        CHECK(mesh.n_boundary_faces() == 6);
        CHECK(volume(mesh) == doctest::Approx(1.0 / 3));
        CHECK(mesh.set_size(mesh.find_set("steel", EntityKind::cell)) == 2);
        const SetHandle upper = mesh.find_set("upper", EntityKind::face);
        REQUIRE(upper.is_valid());
        // The three sides that meet in the tip.
        CHECK(measure(mesh, upper) == doctest::Approx(0.5 + 0.5 + std::sqrt(3.0) / 2));
        const auto tip = mesh.vertex_members(mesh.find_set("group7", EntityKind::vertex));
        REQUIRE(tip.size() == 1);
        CHECK(mesh.point(tip[0]) == Point(0, 0, 1));
    }
}

TEST_CASE("a damaged file that crashes the library of Exodus is refused") {
    CHECK_THROWS_AS(read_mesh(MAILLE_SOURCE_DIR "/tests/fuzz/corpus/exodus/smashing.e"), InputError);
}

TEST_CASE("damaged Exodus files built on HDF5 are read or refused") {
    const test::TemporaryFolder folder;
    write_by_library(folder / "a.e", EX_NETCDF4);
    const std::string bytes = bytes_of(folder / "a.e");
    for (unsigned seed = 0; seed < 60; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        std::string damaged = bytes;
        if (seed % 3 == 0) {
            damaged.resize(random() % bytes.size());
        } else {
            for (unsigned i = 0; i <= seed % 4; ++i)
                damaged[random() % damaged.size()] = static_cast<char>(random());
        }
        std::ofstream(folder / "b.e", std::ios::binary) << damaged;
        try {
            read_mesh(folder / "b.e");
        } catch (const InputError& error) {
            CHECK(std::string(error.what()).find("b.e") != std::string::npos);
        }
    }
}

#endif
