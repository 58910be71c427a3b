#include "tools/benchmark/merging.hh"

#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "modeler/build.hh"
#include "modeler/solid.hh"

namespace maille::benchmark {
namespace {

struct Figures {
    double primitives = std::numeric_limits<double>::infinity();  ///< CPU seconds
    double merge = std::numeric_limits<double>::infinity();
    double cells = 0, kept = 0;
};

Figures measure(const modeler::Model& model, double size, int repeats) {
    Figures best;
    for (int i = 0; i < repeats; ++i) {
        modeler::BuildReport report;
        const auto mesh = modeler::build(model, {.size = size}, &report);
        best.primitives = std::min(best.primitives, report.primitives.cpu_seconds);
        best.merge = std::min(best.merge, report.merge.cpu_seconds);
        best.cells = static_cast<double>(mesh.n_cells());
        best.kept = static_cast<double>(report.kept_cells);
    }
    return best;
}

}  // namespace

void measure_merging(int repeats) {
    const modeler::Model model = (modeler::box({2, 2, 2}) - modeler::cylinder(4, .5).at({1, 1, -1})).model();
    fmt::print(
        "| tetrahedra | kept | primitives, CPU s | merging, CPU s | power |\n|---:|---:|---:|---:|---:|\n");
    Figures before;
    for (const double size : {.1, .07, .047, .033}) {
        const Figures now = measure(model, size, repeats);
        const std::string power = before.cells > 0
                                      ? fmt::format("{:.2f}", std::log(now.merge / before.merge) /
                                                                  std::log(now.cells / before.cells))
                                      : "";
        fmt::print("| {:.0f} | {:.0f} % | {:.2f} | {:.2f} | {} |\n", now.cells, 100 * now.kept / now.cells,
                   now.primitives, now.merge, power);
        before = now;
    }
}

}  // namespace maille::benchmark
