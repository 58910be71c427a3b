#include "tools/maille/model_options.hh"

#include <filesystem>
#include <map>

#include <CLI/CLI.hpp>

namespace maille::tools {

void add_facets_option(CLI::App& command, ModelOptions& options) {
    using modeler::Facets;
    const std::map<std::string, Facets> names{
        {"auto", Facets::automatic}, {"keep", Facets::keep}, {"round", Facets::round}};
    command
        .add_option("--facets", options.facets,
                    "Round solids: auto (facets where $fn is 3 to 8), keep (OpenSCAD's facets), or round")
        ->transform(CLI::CheckedTransformer(names, CLI::ignore_case).description(""))
        ->type_name("auto|keep|round");
}

CLI::Option* add_model_options(CLI::App& command, ModelOptions& options, const std::string& what) {
    CLI::Option* model = command.add_option("--model", options.path, what)->type_name("MODEL");
    add_facets_option(command, options);
    return model;
}

modeler::Model read(const ModelOptions& options) {
    return modeler::read_model(options.path, options.facets);
}

bool is_model_file(const std::string& path) {
    const auto extension = std::filesystem::path(path).extension();
    return extension == ".csg" || extension == ".geo";
}

}  // namespace maille::tools
