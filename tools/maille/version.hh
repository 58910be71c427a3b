#pragma once

#include <CLI/App.hpp>

namespace maille::tools {

inline constexpr const char* version = MAILLE_VERSION;

/// The flag --version.
void add_version_flag(CLI::App& command);

}  // namespace maille::tools
