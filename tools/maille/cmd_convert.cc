#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tools/maille/commands.hh"
#include "tools/maille/common_options.hh"
#include "tools/maille/output_options.hh"
#include "volmesh/io/mesh_io.hh"

namespace maille::tools {
namespace {

struct ConvertOptions {
    CommonOptions common;
    std::string input;
    OutputOptions output;
};

void run(const ConvertOptions& options) {
    check_output(options.output);
    const volmesh::TetMesh mesh = volmesh::read_mesh(options.input);
    write(mesh, options.output);
    if (!options.common.quiet)
        fmt::print("{}: {} cells, {} vertices, {} sets\n", options.output.path, mesh.n_cells(),
                   mesh.n_vertices(), mesh.n_sets());
}

}  // namespace

void add_convert_command(CLI::App& program) {
    const auto options = std::make_shared<ConvertOptions>();
    CLI::App& command =
        add_command(program, "convert", "Write a mesh in another format, or its boundary as a surface",
                    "maille convert bracket.vtu bracket.msh", options, run);
    command.add_option("IN", options->input, "Mesh file")->required();
    command.add_option("OUT", options->output.path, output_help)->required();
    add_format_option(command, options->output);
}

}  // namespace maille::tools
