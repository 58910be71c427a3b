#include <fstream>
#include <iterator>
#include <random>

#include <doctest/doctest.h>

#include "tests/support/kuhn.hh"
#include "tests/support/random_sets.hh"
#include "volmesh/error.hh"
#include "volmesh/io/mesh_io.hh"

using namespace maille;
using namespace maille::volmesh;

namespace {

using Path = std::filesystem::path;

std::string bytes_of(const Path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void put(const Path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

/// Whatever the file holds, it is a mesh or an InputError that names it.
void require_mesh_or_error(const Path& path) {
    try {
        read_mesh(path);
    } catch (const InputError& error) {
        REQUIRE(std::string(error.what()).find(path.stem().string()) != std::string::npos);
    }
}

struct Way {
    std::string read;     ///< what is read
    std::string damaged;  ///< what is damaged
    std::string format;
};

const std::vector<Way>& ways() {
    static const std::vector<Way> all{
        {"a.vtu", "a.vtu", ""},   {"b.msh", "b.msh", ""},        {"c.msh", "c.msh", "msh22"},
        {"d.mesh", "d.mesh", ""}, {"d.mesh", "d.sets.json", ""}, {"e.node", "e.node", ""},
        {"e.node", "e.ele", ""},  {"e.node", "e.face", ""},      {"e.node", "e.edge", ""},
        {"f.inp", "f.inp", ""},   {"g.mfem", "g.mfem", ""},      {"h.e", "h.e", ""}};
    return all;
}

TetMesh small_mesh() {
    std::mt19937 random(5);
    TetMesh mesh = test::kuhn_cube(1);
    test::add_random_sets(mesh, random);
    CPropHandleT<double> property;
    mesh.add_property(property, "density");
    return mesh;
}

void require_error(const Path& path, const std::string& bytes, const std::string& message) {
    put(path, bytes);
    std::string got;
    try {
        read_mesh(path);
    } catch (const InputError& error) {
        got = error.what();
    }
    CAPTURE(got);
    CHECK(got.find(message) != std::string::npos);
}

}  // namespace

TEST_CASE("files cut short are read or refused") {
    const test::TemporaryFolder folder;
    for (const Way& way : ways()) {
        CAPTURE(way.damaged);
        write_mesh(small_mesh(), folder / way.read, {way.format});
        const std::string bytes = bytes_of(folder / way.damaged);
        const std::size_t step = std::max<std::size_t>(1, bytes.size() / 400);
        for (std::size_t n = 0; n < bytes.size(); n += step) {
            CAPTURE(n);
            put(folder / way.damaged, bytes.substr(0, n));
            require_mesh_or_error(folder / way.read);
        }
    }
}

TEST_CASE("files with damaged bytes are read or refused") {
    const test::TemporaryFolder folder;
    for (const Way& way : ways()) {
        CAPTURE(way.damaged);
        write_mesh(small_mesh(), folder / way.read, {way.format});
        const std::string bytes = bytes_of(folder / way.damaged);
        for (unsigned seed = 0; seed < 400; ++seed) {
            CAPTURE(seed);
            std::mt19937 random(seed);
            std::string damaged = bytes;
            const unsigned n_changes = 1 + seed % 4;
            for (unsigned i = 0; i < n_changes; ++i)
                damaged[random() % damaged.size()] = static_cast<char>(random());
            put(folder / way.damaged, damaged);
            require_mesh_or_error(folder / way.read);
        }
    }
}

TEST_CASE("damaged numbers in text are read or refused") {
    const test::TemporaryFolder folder;
    const std::string words[] = {
        "-1", "nan", "1e999", "99999999999999999999", "4294967295", "18446744073709551615", "x", ""};
    for (const Way& way : ways()) {
        if (way.damaged == "a.vtu" || way.damaged == "b.msh" || way.damaged == "h.e") continue;
        CAPTURE(way.damaged);
        write_mesh(small_mesh(), folder / way.read, {way.format});
        const std::string bytes = bytes_of(folder / way.damaged);
        for (unsigned seed = 0; seed < 400; ++seed) {
            CAPTURE(seed);
            std::mt19937 random(seed);
            std::size_t begin = bytes.find_first_of("0123456789", random() % bytes.size());
            if (begin == std::string::npos) continue;
            const std::size_t end = std::min(bytes.find_first_not_of("0123456789.-e", begin), bytes.size());
            put(folder / way.damaged,
                bytes.substr(0, begin) + words[random() % std::size(words)] + bytes.substr(end));
            require_mesh_or_error(folder / way.read);
        }
    }
}

TEST_CASE("what is wrong is named with its place") {
    const test::TemporaryFolder folder;
    const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    const std::string nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
    const Path msh = folder / "a.msh";
    require_error(msh, head + "$Nodes\n1000000000000\n1 0 0 0\n$EndNodes\n",
                  "a.msh:5: the number of nodes is said to be");
    require_error(msh, head + "$Nodes\n1\n1 0 nan 0\n$EndNodes\n",
                  "a.msh:6: a coordinate is not a finite number");
    require_error(msh, head + "$Nodes\n1\n1 0 zero 0\n$EndNodes\n",
                  "'zero' stands where a coordinate should be");
    require_error(msh, head + "$Nodes\n2\n1 0 0 0\n1 0 0 0\n$EndNodes\n", "node 1 is there twice");
    require_error(msh, head + nodes + "$Elements\n1\n1 4 2 0 1 1 2 3 9\n$EndElements\n",
                  "element 1 has node 9");
    require_error(msh, head + nodes + "$Elements\n1\n1 5 2 0 1 1 2 3 4 1 2 3 4\n$EndElements\n",
                  "hexahedron");
    require_error(msh, head + nodes + "$Elements\n1\n1 11 2 0 1 1 2 3 4 1 2 3 4 1 2\n$EndElements\n",
                  "second-order tetrahedron");
    require_error(msh, head + nodes + "$Elements\n1\n1 2 2 7 1 1 2 3\n$EndElements\n",
                  "group 'group7' has the triangle of vertices 0, 1, 2 (from 0), which is no face");
    require_error(msh, "$MeshFormat\n4 0 8\n$EndMeshFormat\n", "version 4 ");
    const Path mesh = folder / "a.mesh";
    const std::string medit = "MeshVersionFormatted 2\nDimension 3\n";
    require_error(mesh, medit + "Vertices\n1\n0 0 0 0\nTetrahedra\n1\n1 1 1 2 0\nEnd\n",
                  "a.mesh:8: an element has a vertex");
    require_error(mesh, medit + "Hexahedra\n1\n", "Hexahedra cannot be read");
    put(folder / "a.ele", "0 10 0\n");
    require_error(folder / "a.node", "0 3 0 0\n", "quadratic tetrahedra");
    const Path mfem = folder / "a.mfem";
    require_error(mfem, "mesh v1.0\n", "a.mfem:1: a file of MFEM's begins with");
    require_error(mfem, "MFEM mesh v1.0\ndimension\n2\n", "a.mfem:3: the dimension should be 3");
    require_error(mfem, "MFEM mesh v1.0\nelements\n1\n1 5 0 1 2 3 4 5 6 7\n",
                  "a.mfem:4: only tetrahedra (type 4)");
    require_error(mfem, "MFEM mesh v1.0\nelements\n99999\n1 4 0 1 2 3\n",
                  "a.mfem:3: the number of elements is said");
    require_error(mfem, "MFEM mesh v1.0\nelements\n1\n1 4 0 1 2 3\nvertices\n1\n3\n0 0 0\n",
                  "tetrahedron 0 has vertex 1");
    require_error(mfem, "MFEM mesh v1.0\nvertices\n2\nnodes\nFiniteElementSpace\n", "vertices should have 3");
    require_error(mfem, "MFEM mesh v1.3\nattribute_sets\n1\n\"East\n1 1\n", "has no closing quote");
    require_error(mfem, "MFEM mesh v1.3\nmfem_mesh_end\nset_rules\n1\ncell \"East\" sometimes\n",
                  "'sometimes' is no rule of sets");
    require_error(mfem, "MFEM mesh v1.3\nmfem_mesh_end\nset_rules\n1\nthing \"East\" none\n",
                  "'thing' is no kind of set");
    put(folder / "a.sets.json",
        "{\"vertices\": 0, \"cells\": 0, \"sets\": [{\"name\": \"East\", \"kind\": "
        "\"cell\", \"references\": [4.4e109]}]}");
    require_error(mesh, medit + "Vertices\n0\nEnd\n", "set 'East' has a reference that is no whole number");
    std::filesystem::remove(folder / "a.sets.json");
    require_error(folder / "a.e", "an Exodus file", "a.e: is no Exodus file");
    require_error(folder / "a.e", std::string("CDF\x01\0\0\0\0\0\0\0\x0A\xff\xff\xff\xff", 16),
                  "a.e: byte 16: a list is said to have 4294967295 entries");
    const Path inp = folder / "a.inp";
    require_error(inp, "*NODE\n1, 0, 0\n", "a.inp:2: a node has a number and three coordinates");
    require_error(inp, "*NODE\n1, 0, 0, inf\n", "a.inp:2: a coordinate is not a finite number");
    require_error(inp, "** a comment\n*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n",
                  "a.inp:5: there is no node 2");
    require_error(inp, "*ELEMENT, TYPE=C3D10\n", "a.inp:1: elements of type C3D10 cannot be read");
    require_error(inp, "*ELEMENT\n", "a.inp:1: *ELEMENT needs TYPE=");
    require_error(inp, "*INCLUDE, INPUT=b.inp\n", "only files in one piece");
    require_error(folder / "a.vtu", "<VTKFile type=\"PolyData\"/>", "is not an unstructured grid");
    require_error(folder / "a.vtu", "<VTKFile type=", "byte");
    const std::string grid = "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>";
    const std::string place = "a.vtu: byte " + std::to_string(grid.size() + 1);
    require_error(folder / "a.vtu", grid + "<Piece NumberOfPoints=\"x\"/></UnstructuredGrid></VTKFile>",
                  place + ": NumberOfPoints is not a number");
    const std::string points = "<Piece NumberOfPoints=\"1\" NumberOfCells=\"0\"><Points>";
    require_error(folder / "a.vtu",
                  grid + points +
                      "<DataArray Name=\"P\" type=\"Float64\" NumberOfComponents=\"3\">0 0 x</DataArray>"
                      "</Points></Piece></UnstructuredGrid></VTKFile>",
                  "a.vtu: byte " + std::to_string(grid.size() + points.size() + 1) +
                      ": array 'P': 'x' is no such number");
}
