#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tools/maille/commands.hh"
#include "tools/maille/common_options.hh"
#include "tools/maille/mesh_info.hh"
#include "volmesh/io/mesh_io.hh"

namespace maille::tools {
namespace {

struct InfoOptions {
    CommonOptions common;
    std::string mesh;
};

void run(const InfoOptions& options) {
    const MeshInfo info = mesh_info(volmesh::read_mesh(options.mesh));
    fmt::print("{}", options.common.json ? to_json(info).dump(2) + "\n" : to_text(info));
}

}  // namespace

void add_info_command(CLI::App& program) {
    const auto options = std::make_shared<InfoOptions>();
    CLI::App& command = add_command(program, "info", "Tell a mesh's counts, volume, area and sets",
                                    "maille info bracket.vtu", options, run);
    command.add_option("MESH", options->mesh, "Mesh file")->required();
    add_json_option(command, options->common, "the figures");
}

}  // namespace maille::tools
