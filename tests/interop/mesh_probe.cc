// For the checks against other programs: `mesh_probe write FOLDER` writes a mesh in the formats that they
// read and tells what is in it, `mesh_probe info FILE` tells what is in a file, `mesh_probe convert IN OUT`
// what it says.
#include <algorithm>
#include <array>
#include <random>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "tests/support/kuhn.hh"
#include "tests/support/random_sets.hh"
#include "volmesh/io/mesh_io.hh"
#include "volmesh/measure.hh"

using namespace maille;
using namespace maille::volmesh;

namespace {

nlohmann::json facts(const TetMesh& mesh) {
    nlohmann::json sets = nlohmann::json::array();
    for (std::uint32_t i = 0; i < mesh.n_sets(); ++i) {
        const SetHandle s(i);
        const SetInfo& info = mesh.set_info(s);
        sets.push_back({{"name", info.name},
                        {"dimension", static_cast<int>(info.kind)},
                        {"size", mesh.set_size(s)},
                        {"measure", measure(mesh, s)}});
    }
    nlohmann::json properties = nlohmann::json::array();
    for (EntityKind kind : {EntityKind::vertex, EntityKind::cell})
        for (const auto& property : mesh.properties(kind).all()) properties.push_back(property->name());
    return {{"vertices", mesh.n_vertices()},
            {"cells", mesh.n_cells()},
            {"volume", volume(mesh)},
            {"sets", sets},
            {"properties", properties}};
}

TetMesh sample() {
    std::mt19937 random(3);
    TetMesh mesh = test::kuhn_cube(3);
    test::shake(mesh, 0.02, random);
    test::add_random_sets(mesh, random);
    VPropHandleT<double> x;
    mesh.add_property(x, "x");
    for (auto v : mesh.vertices()) mesh.property(x)[v] = mesh.point(v).x();
    return mesh;
}

void add_cell_fields(TetMesh& mesh) {
    CPropHandleT<double> number;
    CPropHandleT<Eigen::Vector3d> centre;
    mesh.add_property(number, "number");
    mesh.add_property(centre, "centre");
    for (auto c : mesh.cells()) {
        const auto p = mesh.cell_points(c);
        mesh.property(number)[c] = c.idx();
        mesh.property(centre)[c] = (p[0] + p[1] + p[2] + p[3]) / 4;
    }
}

/// A cube on rollers at x, y, z = 0, to be pulled at x = 1.
TetMesh cube_on_rollers() {
    TetMesh mesh = test::kuhn_cube(3);
    const std::array rollers{mesh.add_set("roller/x-", EntityKind::vertex),
                             mesh.add_set("roller/y-", EntityKind::vertex),
                             mesh.add_set("roller/z-", EntityKind::vertex)};
    const SetHandle far_vertices = mesh.add_set("far vertices", EntityKind::vertex);
    const SetHandle pulled = mesh.add_set("plate/x+", EntityKind::face);
    const SetHandle steel = mesh.add_set("steel", EntityKind::cell);
    for (auto v : mesh.vertices()) {
        for (int k = 0; k < 3; ++k)
            if (mesh.point(v)[k] == 0) mesh.insert(rollers[static_cast<std::size_t>(k)], v);
        if (mesh.point(v).x() == 1) mesh.insert(far_vertices, v);
    }
    for (auto c : mesh.cells()) mesh.insert(steel, c);
    for (HalffaceHandle hf : mesh.halffaces())
        if (std::ranges::all_of(mesh.halfface_vertices(hf),
                                [&](VertexHandle v) { return mesh.point(v).x() == 1; }))
            mesh.insert(pulled, hf);
    return mesh;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string command = argc > 2 ? argv[1] : "";
    try {
        if (command == "write") {
            const std::filesystem::path folder = argv[2];
            TetMesh mesh = sample();
            // meshio 5.0 reads no field of cells in 2.2, not even its own.
            write_mesh(mesh, folder / "sample22.msh", {"msh22"});
            add_cell_fields(mesh);
            write_mesh(cube_on_rollers(), folder / "rollers.inp");
            write_mesh(mesh, folder / "sample.vtu");
            write_mesh(mesh, folder / "sample41.msh");
            write_mesh(mesh, folder / "sample.e");
            write_mesh(cube_on_rollers(), folder / "rollers.msh");
            for (const char* surface : {"sample.stl", "sample.obj", "sample.off", "sample.ply"})
                write_mesh(mesh, folder / surface);
            fmt::print("{}\n", facts(mesh).dump());
        } else if (command == "info") {
            fmt::print("{}\n", facts(read_mesh(argv[2])).dump());
        } else if (command == "convert" && argc > 3) {
            write_mesh(read_mesh(argv[2]), argv[3]);
        } else {
            fmt::print(stderr, "usage: mesh_probe write FOLDER | info FILE | convert IN OUT\n");
            return 2;
        }
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 2;
    }
}
