#include "tools/maille/refine_options.hh"

#include <map>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace maille::tools {
namespace {

using refine::Method;
using refine::Order;

const std::map<std::string, Method> methods{{"rivara", Method::rivara}, {"bisection", Method::bisection}};
const std::map<std::string, Order> orders{
    {"longest", Order::longest}, {"shape", Order::shape}, {"none", Order::none}};

template <typename Value>
const std::string& name_in(const std::map<std::string, Value>& names, Value value) {
    return std::ranges::find(names, value, [](const auto& entry) { return entry.second; })->first;
}

}  // namespace

const std::string& method_name(Method method) {
    return name_in(methods, method);
}
const std::string& order_name(Order order) {
    return name_in(orders, order);
}

void add_refine_options(CLI::App& command, refine::RefineOptions& options) {
    command.add_option("--method", options.method, "How elements are refined")
        ->transform(CLI::CheckedTransformer(methods, CLI::ignore_case).description(""))
        ->type_name("rivara|bisection");
    command.add_option("--order", options.order, "Which elements of a pass come first")
        ->transform(CLI::CheckedTransformer(orders, CLI::ignore_case).description(""))
        ->type_name("longest|shape|none");
    command
        .add_option(
            "--ratio", options.ratio,
            "An element is refined while its longest edge is longer than this times the wanted size (1.5)")
        ->check(CLI::PositiveNumber)
        ->type_name("X");
    command.add_option("--max-iterations", options.max_iterations, "Most passes (100)")
        ->check(CLI::PositiveNumber)
        ->type_name("N");
    command.add_flag("--smooth", options.smooth,
                     "Let new vertices inside the mesh move to better the elements");
}

refine::RefineResult refine_with_progress(volmesh::TetMesh& mesh, const refine::SizeField& size,
                                          refine::RefineOptions options, const volmesh::Projector* projector,
                                          Progress& progress) {
    options.progress = [&](const refine::Progress& pass) {
        progress.note(fmt::format("pass {}, {} cells", pass.iterations, pass.cells));
    };
    refine::RefineResult result = refine::refine(mesh, size, options, projector);
    if (!result.ended)
        progress.warn(fmt::format("refinement was stopped after {} passes, with elements left to refine",
                                  result.iterations));
    return result;
}

}  // namespace maille::tools
