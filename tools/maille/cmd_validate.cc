#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tools/maille/commands.hh"
#include "tools/maille/common_options.hh"
#include "volmesh/io/mesh_io.hh"
#include "volmesh/validate.hh"

namespace maille::tools {
namespace {

struct ValidateOptions {
    CommonOptions common;
    std::string mesh;
};

void run(const ValidateOptions& options) {
    const volmesh::TetMesh mesh = volmesh::read_mesh(options.mesh);
    const volmesh::Validation validation = volmesh::validate(mesh);
    for (const std::string& error : validation.errors) fmt::print("{}: {}\n", options.mesh, error);
    if (!validation.ok()) throw CLI::RuntimeError(1);
    if (!options.common.quiet)
        fmt::print("{}: valid ({} cells, {} vertices)\n", options.mesh, mesh.n_cells(), mesh.n_vertices());
}

}  // namespace

void add_validate_command(CLI::App& program) {
    const auto options = std::make_shared<ValidateOptions>();
    CLI::App& command = add_command(program, "validate",
                                    "Check that a mesh conforms and no cell is inverted; status 1 if not",
                                    "maille validate bracket.vtu", options, run);
    command.add_option("MESH", options->mesh, "Mesh file")->required();
}

}  // namespace maille::tools
