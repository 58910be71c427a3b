#include <array>
#include <map>

#include <CLI/CLI.hpp>

#include "modeler/merge.hh"
#include "tools/maille/commands.hh"
#include "tools/maille/common_options.hh"
#include "tools/maille/output_options.hh"
#include "tools/maille/progress.hh"
#include "tools/maille/summary.hh"
#include "volmesh/io/mesh_io.hh"

namespace maille::tools {
namespace {

using modeler::Operation;

struct MergeCommandOptions {
    CommonOptions common;
    std::string first;
    std::string second;
    Operation operation = Operation::join;
    OutputOptions output;
};

void run(const MergeCommandOptions& options) {
    check_output(options.output);
    Summary summary;
    Progress progress(options.common, 3);
    progress.step("reading");
    const std::array meshes{volmesh::read_mesh(options.first), volmesh::read_mesh(options.second)};
    summary.clock.end(Phase::read);

    progress.step("merging");
    const modeler::CsgTree tree{.operation = options.operation,
                                .children = {{.operation = Operation::leaf, .primitive = 0},
                                             {.operation = Operation::leaf, .primitive = 1}}};
    modeler::BuildReport report;
    const volmesh::TetMesh mesh = modeler::merge(meshes, tree, {}, &report);
    for (const std::string& warning : report.warnings) progress.warn(warning);
    summary.clock.end(Phase::merge);

    progress.step("writing");
    write(mesh, options.output);
    summary.clock.end(Phase::write);
    progress.done();
    summary.print(mesh, options.output.path, options.common);
}

}  // namespace

void add_merge_command(CLI::App& program) {
    const auto options = std::make_shared<MergeCommandOptions>();
    CLI::App& command =
        add_command(program, "merge", "Combine two meshes by a boolean operation",
                    "maille merge plate.vtu pin.vtu --op difference -o drilled.vtu", options, run);
    command.add_option("A", options->first, "Mesh file")->required();
    command.add_option("B", options->second, "Mesh file")->required();
    const std::map<std::string, Operation> operations{{"union", Operation::join},
                                                      {"intersection", Operation::intersection},
                                                      {"difference", Operation::difference},
                                                      {"fragment", Operation::fragment}};
    command
        .add_option("--op", options->operation, "What to make of A and B; where they overlap, A's sets count")
        ->required()
        ->transform(CLI::CheckedTransformer(operations, CLI::ignore_case).description(""))
        ->type_name("union|intersection|difference|fragment");
    add_output_options(command, options->output);
    add_json_option(command, options->common, "a summary");
}

}  // namespace maille::tools
