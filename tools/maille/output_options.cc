#include "tools/maille/output_options.hh"

#include <filesystem>

#include <fmt/format.h>

#include "volmesh/error.hh"
#include "volmesh/io/mesh_io.hh"

namespace maille::tools {

void add_format_option(CLI::App& command, OutputOptions& options) {
    command.add_option("--format", options.format,
                       "Which of several formats the extension stands for: msh41 or msh22");
}

void add_output_options(CLI::App& command, OutputOptions& options) {
    command.add_option("-o,--output", options.path, output_help)->required()->type_name("OUT");
    add_format_option(command, options);
}

void check_folder(const std::string& path) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder))
        throw InputError(fmt::format("{}: there is no folder {}", path, folder.string()));
    if (std::filesystem::is_directory(path)) throw InputError(fmt::format("{}: this is a folder", path));
}

void check_output(const OutputOptions& options) {
    check_folder(options.path);
    volmesh::check_output_format(options.path, {.format = options.format});
}

void write(const volmesh::TetMesh& mesh, const OutputOptions& options) {
    volmesh::write_mesh(mesh, options.path, {.format = options.format});
}

}  // namespace maille::tools
