#pragma once

#include <functional>
#include <memory>
#include <string>

#include <CLI/App.hpp>

namespace maille::tools {

/// What every subcommand takes.
struct CommonOptions {
    bool quiet = false;
    bool verbose = false;
    bool json = false;  ///< where the subcommand prints results
    int threads = 0;    ///< 0: as many as the machine has
};

/// Adds a subcommand whose `Options` hold a CommonOptions named `common`. `run` is called when it is chosen,
/// with its options and within the number of threads asked for. The help ends in the example.
template <typename Options>
CLI::App& add_command(CLI::App& program, const std::string& name, const std::string& description,
                      const std::string& example, const std::shared_ptr<Options>& options,
                      void (*run)(const Options&));

/// The option --json, for subcommands that print results.
void add_json_option(CLI::App& command, CommonOptions& options, const std::string& what);

/// The parts of add_command that don't depend on the options' type.
CLI::App& add_plain_command(CLI::App& program, const std::string& name, const std::string& description,
                            const std::string& example, CommonOptions& options);
void call_with_threads(int threads, const std::function<void()>& run);

template <typename Options>
CLI::App& add_command(CLI::App& program, const std::string& name, const std::string& description,
                      const std::string& example, const std::shared_ptr<Options>& options,
                      void (*run)(const Options&)) {
    CLI::App& command = add_plain_command(program, name, description, example, options->common);
    command.callback([options, run] { call_with_threads(options->common.threads, [&] { run(*options); }); });
    return command;
}

}  // namespace maille::tools
