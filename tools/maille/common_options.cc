#include "tools/maille/common_options.hh"

#include <optional>

#include <tbb/global_control.h>

#include "tools/maille/version.hh"

namespace maille::tools {

void add_version_flag(CLI::App& command) {
    command.set_version_flag("--version", std::string("maille ") + version, "Print the version and exit");
}

CLI::App& add_plain_command(CLI::App& program, const std::string& name, const std::string& description,
                            const std::string& example, CommonOptions& options) {
    CLI::App& command = *program.add_subcommand(name, description);
    command.footer("Example:\n  " + example + "\n");
    add_version_flag(command);
    command.add_flag("-q,--quiet", options.quiet, "Print nothing but errors and what was asked for");
    command.add_flag("-v,--verbose", options.verbose, "Tell on stderr what is being done")
        ->excludes("--quiet");
    command.add_option("--threads", options.threads, "Number of threads; the result does not depend on it")
        ->check(CLI::Range(1, 1024))
        ->type_name("N");
    return command;
}

void add_json_option(CLI::App& command, CommonOptions& options, const std::string& what) {
    command.add_flag("--json", options.json, "Print " + what + " as JSON on stdout");
}

void call_with_threads(int threads, const std::function<void()>& run) {
    std::optional<tbb::global_control> limit;
    if (threads > 0)
        limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    run();
}

}  // namespace maille::tools
