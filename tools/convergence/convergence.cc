/// Meshes models whose volume and areas are known, at sizes that halve, and prints the errors as a Markdown
/// table.

#include <chrono>
#include <cmath>
#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "modeler/build.hh"
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

/// Prints a case's rows; false where one of its meshes couldn't be made.
bool print_rows(const Case& c, const std::filesystem::path& examples, int levels) {
    const modeler::Model model = model_of(c, examples);
    Errors before;
    for (int level = 0; level < levels; ++level) {
        const double size = std::ldexp(c.size, -level);
        const auto start = std::chrono::steady_clock::now();
        try {
            const auto mesh = modeler::build(model, {.size = size, .threads = 2});
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
    std::vector<std::string> names;
    app.add_option("--levels", levels, "How many sizes, each half the one before")->check(CLI::Range(1, 8));
    app.add_option("--examples", examples, "Folder of the example models")->check(CLI::ExistingDirectory);
    app.add_option("cases", names, "Names of cases (default: all)");
    app.footer("Example: convergence --levels 4 sphere lens");
    CLI11_PARSE(app, argc, argv);

    fmt::print(
        "| model | size | cells | volume | order | area | order | worst set | order | which | seconds |\n");
    fmt::print("|---|---|---|---|---|---|---|---|---|---|---|\n");
    bool ok = true;
    for (const Case& c : all_cases())
        if (names.empty() || std::find(names.begin(), names.end(), c.name) != names.end())
            ok = print_rows(c, examples, levels) && ok;
    return ok ? 0 : 1;
}
