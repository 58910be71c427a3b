#pragma once

#include <string>

#include <CLI/App.hpp>

#include "modeler/model.hh"

namespace maille::tools {

/// Which model to read, and how.
struct ModelOptions {
    std::string path;
    modeler::Facets facets = modeler::Facets::automatic;
};

void add_facets_option(CLI::App& command, ModelOptions& options);
/// The options --model and --facets; returns the first.
CLI::Option* add_model_options(CLI::App& command, ModelOptions& options, const std::string& what);

modeler::Model read(const ModelOptions& options);

/// Whether the file is a model, not a mesh: by its extension.
bool is_model_file(const std::string& path);

}  // namespace maille::tools
