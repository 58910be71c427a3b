#include "tools/maille/refine_options.hh"

#include <algorithm>
#include <map>
#include <numbers>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tools/maille/short_of_target.hh"
#include "volmesh/error.hh"
#include "volmesh/measure.hh"

namespace maille::tools {
namespace {

using refine::Method;
using refine::Order;
using refine::Ties;

const std::map<std::string, Method> methods{{"rivara", Method::rivara}, {"bisection", Method::bisection}};
const std::map<std::string, Order> orders{
    {"longest", Order::longest}, {"shape", Order::shape}, {"none", Order::none}};

const std::map<std::string, Ties> ties{
    {"order", Ties::order}, {"fewest", Ties::fewest}, {"boundary", Ties::boundary}};

template <typename Value>
const std::string& name_in(const std::map<std::string, Value>& names, Value value) {
    return std::ranges::find(names, value, [](const auto& entry) { return entry.second; })->first;
}

/// Refuses a size that takes more cells than a mesh may have. No tetrahedron is larger than the regular one,
/// so the sum is less than their number, as far as the size is seen at the present cells' centroids.
void refuse_too_many_cells(const volmesh::TetMesh& mesh, const refine::SizeField& size,
                           const refine::RefineOptions& options) {
    const double volume_of_unit_edge = 1 / (6 * std::numbers::sqrt2);
    double least_number = 0;
    for (const volmesh::CellHandle c : mesh.cells()) {
        const auto p = mesh.cell_points(c);
        const double edge = options.ratio * size((p[0] + p[1] + p[2] + p[3]) / 4);
        least_number += volmesh::volume(mesh, c) / edge / edge / edge / volume_of_unit_edge;
    }
    if (least_number > options.max_cells)
        throw InputError(fmt::format("this size takes more than {:.2g} cells; a mesh may have {}",
                                     least_number, options.max_cells));
}

auto notes_to(Progress& progress) {
    return [&progress](const refine::Progress& pass) {
        progress.note(fmt::format("pass {}, {} cells", pass.iterations, pass.cells));
    };
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
            "--ties", options.ties,
            "Which of several longest edges is split: the oldest, that with the fewest elements round it "
            "that need no refinement, or one on the boundary")
        ->transform(CLI::CheckedTransformer(ties, CLI::ignore_case).description(""))
        ->type_name("order|fewest|boundary");
    command
        .add_option(
            "--ratio", options.ratio,
            "An element is refined while its longest edge is longer than this times the wanted size (1.5)")
        ->check(CLI::PositiveNumber)
        ->type_name("X");
    command
        .add_option(
            "--gradation", options.gradation,
            "Let the size grow by no more than this for each unit of length: 0.3 makes soft transitions")
        ->check(CLI::PositiveNumber)
        ->type_name("G");
    command.add_option("--max-iterations", options.max_iterations, "Most passes (100)")
        ->check(CLI::PositiveNumber)
        ->type_name("N");
    command
        .add_option("--min-shape", options.min_shape,
                    "No move onto a surface leaves an element of lower gamma, unless one beside it was worse "
                    "(0.0005)")
        ->check(CLI::Range(1e-12, 1.0))
        ->type_name("Q");
    command.add_flag("--smooth", options.smooth,
                     "Let new vertices inside the mesh move to better the elements");
}

refine::RefineResult refine_with_progress(volmesh::TetMesh& mesh, const refine::SizeField& size,
                                          refine::RefineOptions options, const volmesh::Projector* projector,
                                          Progress& progress) {
    refuse_too_many_cells(mesh, size, options);
    options.progress = notes_to(progress);
    refine::RefineResult result = refine::refine(mesh, size, options, projector);
    if (!result.ended)
        progress.warn(fmt::format("refinement was stopped after {} passes, with elements left to refine",
                                  result.iterations));
    warn_of_short(result.projection, progress);
    return result;
}

refine::RefineResult refine_uniformly_with_progress(volmesh::TetMesh& mesh, refine::UniformOptions options,
                                                    const volmesh::Projector* projector, Progress& progress) {
    options.progress = notes_to(progress);
    refine::RefineResult result = refine::refine_uniformly(mesh, options, projector);
    warn_of_short(result.projection, progress);
    return result;
}

}  // namespace maille::tools
