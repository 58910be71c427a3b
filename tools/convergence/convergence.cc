/// Meshes models whose volume and areas are known, at sizes that halve, by building or by refinement, and
/// prints the errors as a Markdown table.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "modeler/build.hh"
#include "refine/refine.hh"
#include "tools/convergence/cases.hh"
#include "volmesh/error.hh"

namespace {

using namespace maille;
using namespace maille::convergence;

/// The power of the size that an error goes with; nothing is said of errors that are rounding.
std::string order(double before, double now) {
    constexpr double rounding = 1e-12;
    if (before <= rounding || now <= rounding) return "";
    return fmt::format("{:.2f}", std::log2(before / now));
}

std::string figure(double error) {
    return error < 1e-12 ? "0" : fmt::format("{:.2e}", error);
}

/// Makes the mesh of a case at a size; asked for sizes that halve.
using Mesher = std::function<const volmesh::TetMesh&(double size)>;

/// Builds every mesh from the model.
Mesher builder(const modeler::Model& model) {
    return [model, mesh = volmesh::TetMesh()](double size) mutable -> const volmesh::TetMesh& {
        return mesh = modeler::build(model, {.size = size, .threads = 2});
    };
}

/// Builds the first mesh and refines it to the sizes that follow.
Mesher refiner(const modeler::Model& model) {
    return [model, mesh = volmesh::TetMesh()](double size) mutable -> const volmesh::TetMesh& {
        const auto projector = modeler::projector(model);
        if (mesh.n_cells() == 0)
            mesh = modeler::build(model, {.size = size, .threads = 2});
        else
            refine::refine(mesh, refine::SizeField(size), {.threads = 2}, &projector);
        return mesh;
    };
}

/// Prints a case's rows; false where one of its meshes couldn't be made.
bool print_rows(const Case& c, const Mesher& mesh_at, int levels) {
    Errors before;
    for (int level = 0; level < levels; ++level) {
        const double size = std::ldexp(c.size, -level);
        const auto start = std::chrono::steady_clock::now();
        try {
            const volmesh::TetMesh& mesh = mesh_at(size);
            const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
            const Errors now = errors(c, mesh);
            fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.1f} |\n", c.name, size,
                       mesh.n_cells(), figure(now.volume), order(before.volume, now.volume), figure(now.area),
                       order(before.area, now.area), figure(now.worst_set),
                       order(before.worst_set, now.worst_set), now.worst_set_name, seconds.count());
            before = now;
        } catch (const InputError& error) {
            fmt::print("| {} | {} | failed: {} |\n", c.name, size, error.what());
            return false;
        }
        std::fflush(stdout);
    }
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Convergence of volume and areas: relative errors, and the power of the size that they go with.");
    int levels = 3;
    std::string examples = "examples";
    bool refined = false;
    std::vector<std::string> names;
    app.add_option("--levels", levels, "How many sizes, each half the one before")->check(CLI::Range(1, 8));
    app.add_option("--examples", examples, "Folder of the example models")->check(CLI::ExistingDirectory);
    app.add_flag("--refine", refined, "Refine the first mesh, with projection, rather than build each anew");
    app.add_option("cases", names, "Names of cases (default: all)");
    app.footer("Example: convergence --levels 4 sphere lens");
    CLI11_PARSE(app, argc, argv);

    fmt::print(
        "| model | size | cells | volume | order | area | order | worst set | order | which | seconds |\n");
    fmt::print("|---|---|---|---|---|---|---|---|---|---|---|\n");
    bool ok = true;
    for (const Case& c : all_cases()) {
        if (!names.empty() && std::find(names.begin(), names.end(), c.name) == names.end()) continue;
        const modeler::Model model = model_of(c, examples);
        ok = print_rows(c, refined ? refiner(model) : builder(model), levels) && ok;
    }
    return ok ? 0 : 1;
}
