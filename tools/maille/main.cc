#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tools/maille/commands.hh"
#include "tools/maille/version.hh"
#include "volmesh/error.hh"

namespace {

constexpr int bad_input = 2;

/// One line on stderr, whatever the message holds.
int complain(std::string message) {
    for (char& c : message)
        if (c == '\n') c = ' ';
    while (message.ends_with(' ')) message.pop_back();
    fmt::print(stderr, "maille: error: {}\n", message);
    return bad_input;
}

int run(int argc, char** argv) {
    namespace tools = maille::tools;
    CLI::App program("From a CSG model to a refined tetrahedral mesh, ready for a solver.", "maille");
    program.require_subcommand(1);
    tools::add_version_flag(program);
    tools::add_mesh_command(program);
    tools::add_refine_command(program);
    tools::add_quality_command(program);
    tools::add_info_command(program);
    tools::add_validate_command(program);
    tools::add_convert_command(program);
    tools::add_paper_command(program);
    tools::add_merge_command(program);
    program.footer(
        "Example:\n  maille mesh examples/bracket.csg --size 4 -o bracket.vtu\n\n"
        "'maille COMMAND --help' tells more of each.\n");
    try {
        program.parse(argc, argv);
    } catch (const CLI::RuntimeError& status) {
        return status.get_exit_code();
    } catch (const CLI::Success& help_or_version) {
        return program.exit(help_or_version);
    } catch (const CLI::ParseError& error) {
        return complain(fmt::format("{} (see 'maille --help')", error.what()));
    }
    if (std::fflush(stdout) != 0) return complain("cannot write to the standard output");
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const maille::InputError& error) {
        return complain(error.what());
    } catch (const std::bad_alloc&) {
        return complain("there is not enough memory for this");
    } catch (const std::exception& error) {
        return complain(fmt::format("this is a defect of maille, please report it: {}", error.what()));
    }
}
