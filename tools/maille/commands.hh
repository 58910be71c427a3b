#pragma once

#include <CLI/App.hpp>

/// The subcommands of the program `maille`, one a file. Each function adds its own to the program, with its
/// options and help, and what it does when it is chosen.
///
/// A subcommand throws InputError where its input cannot be used, and CLI::RuntimeError(1) where a check
/// failed.
namespace maille::tools {

void add_mesh_command(CLI::App& program);
void add_refine_command(CLI::App& program);
void add_quality_command(CLI::App& program);
void add_info_command(CLI::App& program);
void add_validate_command(CLI::App& program);
void add_convert_command(CLI::App& program);
void add_paper_command(CLI::App& program);
void add_merge_command(CLI::App& program);

}  // namespace maille::tools
