#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <CLI/App.hpp>

#include "refine/size_field.hh"

namespace maille::tools {

/// The help of options that take a size.
inline constexpr const char* size_help =
    "a length, an expression of x, y, z and r (the distance from the origin), or FILE:FIELD, a vertex or "
    "cell field of a mesh file";
inline constexpr const char* refined_size_help =
    "a length, an expression of x, y, z, r (the distance from the origin), d('SET') (the distance to a named "
    "set) and curvature(N) (for N edges to a circle of a curved surface), or FILE:FIELD, a vertex or cell "
    "field of a mesh file; of several the smallest counts";

/// A size as the command line gives it, read as far as it can be before there is a mesh. Throws InputError
/// where it can't.
class SizeArgument {
  public:
    explicit SizeArgument(const std::string& text,
                          refine::CellValues cell_values = refine::CellValues::constant);
    refine::SizeField field(const refine::SizeContext& context = {}) const;

  private:
    std::variant<refine::SizeField, std::string> field_or_expression_;
};

/// Several sizes as they were given, and how cell fields among them are meant.
struct SizeOptions {
    std::vector<std::string> texts;
    refine::CellValues cell_values = refine::CellValues::constant;
};

/// The option of this name, which may be given several times, with one size each, and --cell-sizes. Returns
/// the first.
CLI::Option* add_size_options(CLI::App& command, const std::string& name, SizeOptions& options,
                              const std::string& help);

/// Several sizes, of which the smallest counts at each point.
using SizeArguments = std::vector<SizeArgument>;
SizeArguments read(const SizeOptions& options);
refine::SizeField smallest(const SizeArguments& sizes, const refine::SizeContext& context);

}  // namespace maille::tools
