#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "modeler/model.hh"
#include "quality/improve.hh"
#include "quality/report.hh"
#include "tools/maille/commands.hh"
#include "tools/maille/common_options.hh"
#include "tools/maille/mesh_field.hh"
#include "tools/maille/model_options.hh"
#include "tools/maille/output_options.hh"
#include "tools/maille/page_option.hh"
#include "tools/maille/size_argument.hh"
#include "volmesh/io/mesh_io.hh"

namespace maille::tools {
namespace {

struct QualityOptions {
    CommonOptions common;
    std::string mesh;
    std::optional<std::string> size;
    std::optional<std::string> error;
    std::size_t n_worst = 10;
    PageOption page;
    ModelOptions model;
    OutputOptions improved;
};

/// Betters the mesh and writes it. Without a model no vertex of a curved surface moves.
void improve_and_write(volmesh::TetMesh& mesh, const quality::WantedSize* size,
                       const QualityOptions& options) {
    std::optional<volmesh::Projector> projector;
    if (!options.model.path.empty()) projector = modeler::projector(read(options.model));
    quality::improve(mesh, {.size = size}, projector ? &*projector : nullptr);
    write(mesh, options.improved);
}

void run(const QualityOptions& options) {
    std::optional<quality::WantedSize> size;
    std::vector<double> errors;
    const bool improves = !options.improved.path.empty();
    if (improves) check_output(options.improved);
    check_page(options.page);
    volmesh::TetMesh mesh = volmesh::read_mesh(options.mesh);
    if (options.size) size = SizeArgument(*options.size).field({.mesh = &mesh});
    const quality::WantedSize* wanted = size ? &*size : nullptr;
    if (improves) improve_and_write(mesh, wanted, options);
    if (options.error) errors = cell_field(*options.error, mesh);
    const quality::Report report =
        quality::assess(mesh, wanted, {.errors = errors, .n_worst = options.n_worst});
    if (!options.page.path.empty())
        write_page(options.page, improves ? options.improved.path : options.mesh, mesh, report, wanted,
                   errors);
    fmt::print("{}",
               options.common.json ? quality::to_json(report).dump(2) + "\n" : quality::to_text(report));
}

}  // namespace

void add_quality_command(CLI::App& program) {
    const auto options = std::make_shared<QualityOptions>();
    CLI::App& command = add_command(program, "quality", "Measure the cells of a mesh, or better them",
                                    "maille quality bracket.vtu --size '0.4+3*(1-exp(-r/10))'", options, run);
    command.add_option("MESH", options->mesh, "Mesh file")->required();
    command
        .add_option(
            "--size", options->size,
            std::string("Wanted size, for the size measure phi, and kept to by --improve: ") + size_help)
        ->type_name("EXPR");
    command.add_option("--worst", options->n_worst, "How many of the worst cells to list")
        ->capture_default_str()
        ->type_name("N");
    add_page_options(command, options->page);
    CLI::Option* improve = command
                               .add_option("--improve", options->improved.path,
                                           "Better the worst cells by smoothing, flips, collapse and "
                                           "split, write this mesh and report on it")
                               ->type_name("OUT");
    command
        .add_option(
            "--error", options->error,
            "An estimated error, to tell critical cells, those of bad shape and with an error above the "
            "mean: a cell field of MESH, or FILE:FIELD of a mesh file with the same cells")
        ->type_name("FIELD")
        ->excludes(improve);
    add_model_options(command, options->model, "Let vertices on the surfaces of this model move along them")
        ->needs(improve);
    add_json_option(command, options->common, "the report");
}

}  // namespace maille::tools
