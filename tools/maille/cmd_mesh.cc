#include <optional>

#include <CLI/CLI.hpp>

#include "tools/maille/commands.hh"
#include "tools/maille/common_options.hh"
#include "tools/maille/improvement.hh"
#include "tools/maille/model_options.hh"
#include "tools/maille/output_options.hh"
#include "tools/maille/picture_option.hh"
#include "tools/maille/refine_options.hh"
#include "tools/maille/size_argument.hh"
#include "tools/maille/start_mesh.hh"
#include "tools/maille/summary.hh"

namespace maille::tools {
namespace {

struct MeshOptions {
    CommonOptions common;
    ModelOptions model;
    std::optional<std::string> start_size;
    bool improve = true;
    SizeOptions refined_size;
    refine::RefineOptions refine;
    OutputOptions output;
    std::string picture;
};

void run(const MeshOptions& options) {
    check_output(options.output);
    if (!options.picture.empty()) check_folder(options.picture);
    const SizeArguments refined_size = read(options.refined_size);

    Summary summary;
    Progress progress(options.common, refined_size.empty() ? 4 : 5);
    progress.step("reading the model");
    const modeler::Model model = read(options.model);
    const volmesh::Projector projector = modeler::projector(model);
    StartMeshOptions start{.improve = options.improve, .threads = options.common.threads};
    if (options.start_size) start.size = SizeArgument(*options.start_size).field();
    summary.clock.end(Phase::read);

    volmesh::TetMesh mesh = start_mesh(model, projector, start, progress, summary);
    if (!refined_size.empty()) {
        progress.step("refining");
        const refine::SizeField size = smallest(refined_size, {&mesh, &projector});
        summary.add(refine_with_progress(mesh, size, options.refine, &projector, progress));
        summary.clock.end(Phase::refine);
        if (options.improve) improve_refined(mesh, size, options.refine, &projector, progress, summary);
    }
    progress.step("writing");
    write(mesh, options.output);
    if (!options.picture.empty()) write_picture(mesh, options.picture);
    summary.clock.end(Phase::write);
    progress.done();
    summary.print(mesh, options.output.path, options.common);
}

}  // namespace

void add_mesh_command(CLI::App& program) {
    const auto options = std::make_shared<MeshOptions>();
    CLI::App& command = add_command(
        program, "mesh", "Make a tetrahedral mesh of a CSG model",
        "maille mesh examples/bracket.csg --size 4 --refine '0.4+3*(1-exp(-r/10))' -o bracket.vtu", options,
        run);
    command.add_option("MODEL", options->model.path, "Model file (.csg, .geo)")->required();
    add_output_options(command, options->output);
    command.add_option("--size", options->start_size, start_size_help)->type_name("EXPR");
    add_facets_option(command, options->model);
    add_size_options(
        command, "--refine", options->refined_size,
        std::string("Then refine to this size, with new boundary vertices on the true surfaces: ") +
            refined_size_help);
    add_refine_options(command, options->refine);
    command.add_flag(
        "!--no-improve", options->improve,
        "Leave elements as meshing and refinement make them: don't smooth, flip, collapse or split "
        "to better the worst");
    add_picture_option(command, options->picture);
    add_json_option(command, options->common, "a summary");
}

}  // namespace maille::tools
