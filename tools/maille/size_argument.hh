#pragma once

#include <optional>
#include <string>

#include "refine/size_field.hh"

namespace maille::tools {

/// The help of options that take a size.
inline constexpr const char* size_help =
    "a length, an expression of x, y, z and r (the distance from the origin), or FILE:FIELD, a vertex or "
    "cell field of "
    "a mesh file";

/// The size field that an argument of the command line stands for. Throws InputError where it stands for
/// none.
refine::SizeField size_field(const std::string& argument);
/// The same for an option that need not be given.
std::optional<refine::SizeField> optional_size_field(const std::optional<std::string>& argument);

}  // namespace maille::tools
