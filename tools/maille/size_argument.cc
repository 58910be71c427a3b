#include "tools/maille/size_argument.hh"

#include <map>

#include <CLI/CLI.hpp>

#include "tools/maille/mesh_field.hh"
#include "volmesh/io/mesh_io.hh"

namespace maille::tools {
namespace {

std::variant<refine::SizeField, std::string> field_or_expression(const std::string& text,
                                                                 refine::CellValues cell_values) {
    if (const auto field = parse_mesh_field(text))
        return refine::mesh_size(volmesh::read_mesh(field->path), field->name, cell_values);
    refine::check_size(text);
    return text;
}

}  // namespace

SizeArgument::SizeArgument(const std::string& text, refine::CellValues cell_values)
    : field_or_expression_(field_or_expression(text, cell_values)) {}

refine::SizeField SizeArgument::field(const refine::SizeContext& context) const {
    if (const auto* field = std::get_if<refine::SizeField>(&field_or_expression_)) return *field;
    return refine::parse_size(std::get<std::string>(field_or_expression_), context);
}

SizeArguments read(const SizeOptions& options) {
    SizeArguments sizes;
    for (const std::string& text : options.texts) sizes.emplace_back(text, options.cell_values);
    return sizes;
}

refine::SizeField smallest(const SizeArguments& sizes, const refine::SizeContext& context) {
    std::vector<refine::SizeField> fields;
    for (const SizeArgument& size : sizes) fields.push_back(size.field(context));
    return fields.size() == 1 ? fields.front() : refine::minimum(std::move(fields));
}

CLI::Option* add_size_options(CLI::App& command, const std::string& name, SizeOptions& options,
                              const std::string& help) {
    using refine::CellValues;
    const std::map<std::string, CellValues> meanings{{"constant", CellValues::constant},
                                                     {"averaged", CellValues::averaged}};
    command
        .add_option(
            "--cell-sizes", options.cell_values,
            "What a cell field of a mesh file means: constant in each cell, or averaged at the vertices "
            "by volume and linear between them")
        ->transform(CLI::CheckedTransformer(meanings, CLI::ignore_case).description(""))
        ->type_name("constant|averaged");
    return command.add_option(name, options.texts, help)
        ->type_name("EXPR")
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

}  // namespace maille::tools
