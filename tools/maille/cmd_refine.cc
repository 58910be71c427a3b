#include <CLI/CLI.hpp>

#include "tools/maille/commands.hh"
#include "tools/maille/common_options.hh"
#include "tools/maille/improvement.hh"
#include "tools/maille/model_options.hh"
#include "tools/maille/output_options.hh"
#include "tools/maille/refine_options.hh"
#include "tools/maille/size_argument.hh"
#include "tools/maille/start_mesh.hh"
#include "tools/maille/summary.hh"
#include "volmesh/error.hh"
#include "volmesh/io/mesh_io.hh"

namespace maille::tools {
namespace {

struct RefineCommandOptions {
    CommonOptions common;
    std::string input;
    ModelOptions model;
    SizeOptions size;
    refine::RefineOptions refine;
    int levels = 0;  ///< of uniform refinement; 0: to a size
    OutputOptions output;
};

/// The mesh to refine: read, or made of the model where that is what was given.
volmesh::TetMesh read_mesh_or_make(const RefineCommandOptions& options,
                                   const std::optional<modeler::Model>& model,
                                   const volmesh::Projector* projector, Progress& progress,
                                   Summary& summary) {
    if (is_model_file(options.input))
        return start_mesh(*model, *projector, {.threads = options.common.threads}, progress, summary);
    volmesh::TetMesh mesh = volmesh::read_mesh(options.input);
    summary.clock.end(Phase::read);
    return mesh;
}

/// The model that the mesh is to follow, if there is one.
std::optional<modeler::Model> model_of(const RefineCommandOptions& options) {
    ModelOptions model = options.model;
    if (is_model_file(options.input)) {
        if (!model.path.empty())
            throw InputError("--model goes with a mesh: " + options.input + " is a model itself");
        model.path = options.input;
    }
    if (model.path.empty()) return std::nullopt;
    return read(model);
}

bool is_projecting(const RefineCommandOptions& options, const volmesh::Projector* surfaces) {
    return surfaces != nullptr && options.refine.project;
}

void refine_to_size(const RefineCommandOptions& options, const SizeArguments& sizes, volmesh::TetMesh& mesh,
                    const volmesh::Projector* surfaces, Progress& progress, Summary& summary) {
    const refine::SizeField size = smallest(sizes, {&mesh, surfaces});
    summary.add(refine_with_progress(mesh, size, options.refine, surfaces, progress),
                is_projecting(options, surfaces));
    summary.clock.end(Phase::refine);
    if (options.refine.smooth) improve_refined(mesh, size, options.refine, surfaces, progress, summary);
}

void refine_by_levels(const RefineCommandOptions& options, volmesh::TetMesh& mesh,
                      const volmesh::Projector* surfaces, Progress& progress, Summary& summary) {
    const refine::UniformOptions uniform{
        .levels = options.levels, .project = options.refine.project, .min_shape = options.refine.min_shape};
    summary.add(refine_uniformly_with_progress(mesh, uniform, surfaces, progress),
                is_projecting(options, surfaces));
    summary.clock.end(Phase::refine);
}

void run(const RefineCommandOptions& options) {
    if (options.size.texts.empty() && options.levels == 0)
        throw InputError("give a size (--size) or a number of levels (--uniform)");
    check_output(options.output);
    const SizeArguments sizes = read(options.size);
    Summary summary;
    Progress progress(options.common, is_model_file(options.input) ? 5 : 3);
    progress.step("reading");
    const std::optional<modeler::Model> model = model_of(options);
    std::optional<volmesh::Projector> projector;
    if (model) projector = modeler::projector(*model);
    const volmesh::Projector* surfaces = projector ? &*projector : nullptr;
    summary.clock.end(Phase::read);
    volmesh::TetMesh mesh = read_mesh_or_make(options, model, surfaces, progress, summary);

    progress.step("refining");
    if (options.levels > 0)
        refine_by_levels(options, mesh, surfaces, progress, summary);
    else
        refine_to_size(options, sizes, mesh, surfaces, progress, summary);

    progress.step("writing");
    write(mesh, options.output);
    summary.clock.end(Phase::write);
    progress.done();
    summary.print(mesh, options.output.path, options.common);
}

}  // namespace

void add_refine_command(CLI::App& program) {
    const auto options = std::make_shared<RefineCommandOptions>();
    CLI::App& command = add_command(
        program, "refine", "Refine a mesh, or the mesh of a model, to a size",
        "maille refine examples/tee.csg --size 0.1 --method rivara --order longest -o tee.msh", options, run);
    command.add_option("MESH", options->input, "Mesh file, or model file (.csg, .geo)")->required();
    add_output_options(command, options->output);
    CLI::Option* size =
        add_size_options(command, "--size", options->size, std::string("Wanted size: ") + refined_size_help);
    add_refine_options(command, options->refine);
    CLI::Option* levels = command
                              .add_option("--uniform", options->levels,
                                          "Instead of a size: cut every element into eight, N times")
                              ->check(CLI::Range(1, 9))
                              ->type_name("N");
    for (const char* name :
         {"--method", "--order", "--ties", "--ratio", "--gradation", "--max-iterations", "--smooth"})
        levels->excludes(command.get_option(name));
    levels->excludes(size);
    CLI::Option& smooth = *command.get_option("--smooth");
    smooth.description(
        smooth.get_description() +
        "; in the end better the worst by smoothing, flips, collapse and split, within the size");
    add_model_options(command, options->model, "Put new boundary vertices on the surfaces of this model");
    command.add_flag("!--no-project", options->refine.project,
                     "Leave new boundary vertices where they are born");
    add_json_option(command, options->common, "a summary");
}

}  // namespace maille::tools
