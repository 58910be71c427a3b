#include "tools/maille/page_option.hh"

#include <filesystem>

#include <CLI/CLI.hpp>

#include "tools/maille/output_options.hh"
#include "volmesh/error.hh"
#ifdef MAILLE_HAS_HTML
#include "tools/html/page.hh"
#endif

namespace maille::tools {

void add_page_options(CLI::App& command, PageOption& options) {
    CLI::Option* page =
        command
            .add_option("--html", options.path, "Write the report, with the mesh to look into, as a web page")
            ->type_name("FILE");
    command
        .add_option(
            "--html-cells", options.max_cells,
            "How many cells the page carries, about; of a larger mesh its boundary, some cuts and the "
            "worst cells are sent")
        ->capture_default_str()
        ->check(CLI::PositiveNumber)
        ->type_name("N")
        ->needs(page);
}

#ifdef MAILLE_HAS_HTML

void check_page(const PageOption& options) {
    if (!options.path.empty()) check_folder(options.path);
}

void write_page(const PageOption& options, const std::string& mesh_path, const volmesh::TetMesh& mesh,
                const quality::Report& report, const quality::WantedSize* size,
                std::span<const double> errors) {
    html::write_page(mesh, report, options.path,
                     {.title = std::filesystem::path(mesh_path).filename().string(),
                      .size = size,
                      .errors = errors,
                      .max_cells = options.max_cells});
}

#else

void check_page(const PageOption& options) {
    if (!options.path.empty())
        throw InputError(
            "--html: this program was built without pages; build it with esbuild and three.js "
            "installed (tools/setup), and the CMake option MAILLE_HTML on");
}

void write_page(const PageOption&, const std::string&, const volmesh::TetMesh&, const quality::Report&,
                const quality::WantedSize*, std::span<const double>) {}

#endif

}  // namespace maille::tools
