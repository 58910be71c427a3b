#include <cmath>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "refine/paper.hh"
#include "tools/maille/commands.hh"
#include "tools/maille/common_options.hh"
#include "tools/maille/refine_options.hh"

namespace maille::tools {
namespace {

using nlohmann::ordered_json;
using refine::PaperExample;
using refine::PaperRun;
using refine::Spread;

struct PaperOptions {
    CommonOptions common;
    int example = 0;
};

/// The percentages of the tables, by the names that the report of `maille quality` gives them.
constexpr std::pair<const char*, double PaperRun::*> criteria[] = {
    {"r/Lmax<0.4", &PaperRun::sigma_below_0_4_percent},
    {"r/Lmax<0.2", &PaperRun::sigma_below_0_2_percent},
    {"Lmin/Lmax<0.3", &PaperRun::tau_below_0_3_percent},
    {"2/3<L/Lbar<3/2", &PaperRun::phi_within_percent},
};

struct SpreadRow {
    const char* symbol;
    const char* name;
    Spread PaperRun::*value;
};
constexpr SpreadRow spreads[] = {{"r/Lmax", "sigma", &PaperRun::sigma},
                                 {"Lmin/Lmax", "tau", &PaperRun::tau},
                                 {"L/Lbar", "phi", &PaperRun::phi}};

ordered_json to_json(const PaperRun& run, int example) {
    ordered_json json{{"example", example},
                      {"method", method_name(run.method)},
                      {"order", order_name(run.order)},
                      {"iterations", run.iterations},
                      {"ended", run.ended},
                      {"cells", run.cells},
                      {"vertices", run.vertices}};
    for (const SpreadRow& row : spreads) {
        const Spread& spread = run.*row.value;
        json[row.name] = {{"min", spread.min}, {"mean", spread.mean}, {"max", spread.max}};
    }
    for (const auto& [name, percent] : criteria) json["criteria"][name] = run.*percent;
    json["seconds"] = run.seconds;
    return json;
}

/// A row of the table: a figure of each run, and below it the printed one.
template <typename Figure>
void print_row(const PaperExample& example, const std::string& label, const char* pattern,
               const Figure& figure) {
    fmt::print("{:<20}", label);
    for (const PaperRun& run : example.runs)
        fmt::print("{:>16}", fmt::format(fmt::runtime(pattern), figure(run)));
    fmt::print("\n{:<20}", "      in the paper");
    for (const PaperRun& run : example.printed_runs)
        fmt::print("{:>16}", fmt::format(fmt::runtime(pattern), figure(run)));
    fmt::print("\n");
}

double two_digits_cut(double percent) {
    return std::floor(percent * 100) / 100;
}

void print_table(const PaperExample& example) {
    fmt::print("{}\n{:<20}", example.title, "");
    for (const PaperRun& run : example.runs)
        fmt::print("{:>16}", fmt::format("{}{}", method_name(run.method),
                                         run.order == refine::Order::none ? "" : "+sort"));
    fmt::print("\n");
    print_row(example, "iterations", "{}", [](const PaperRun& run) { return run.iterations; });
    print_row(example, "cells", "{}", [](const PaperRun& run) { return run.cells; });
    print_row(example, "vertices", "{}", [](const PaperRun& run) { return run.vertices; });
    for (const SpreadRow& row : spreads) {
        const auto label = [&](const char* which) { return fmt::format("{} {}", row.symbol, which); };
        print_row(example, label("min"), "{:.6g}", [&](const PaperRun& run) { return (run.*row.value).min; });
        print_row(example, label("mean"), "{:.6g}",
                  [&](const PaperRun& run) { return (run.*row.value).mean; });
        print_row(example, label("max"), "{:.6g}", [&](const PaperRun& run) { return (run.*row.value).max; });
    }
    for (const auto& [name, percent] : criteria)
        print_row(example, fmt::format("{} %", name), "{:.2f}",
                  [&, member = percent](const PaperRun& run) { return two_digits_cut(run.*member); });
    print_row(example, "seconds", "{:.3g}", [](const PaperRun& run) { return run.seconds; });
    for (const PaperRun& run : example.runs)
        if (!run.ended)
            fmt::print("{} in order '{}' did not end: stopped after {} passes\n", method_name(run.method),
                       order_name(run.order), run.iterations);
}

void run(const PaperOptions& options) {
    ordered_json json = ordered_json::array();
    for (const int number : {1, 2}) {
        if (options.example != 0 && options.example != number) continue;
        const PaperExample example = refine::paper_example(number);
        if (!options.common.json) {
            print_table(example);
            fmt::print("\n");
        }
        for (const PaperRun& run : example.runs) json.push_back(to_json(run, number));
    }
    if (options.common.json) fmt::print("{}\n", json.dump(2));
}

}  // namespace

void add_paper_command(CLI::App& program) {
    const auto options = std::make_shared<PaperOptions>();
    CLI::App& command =
        add_command(program, "paper", "Repeat the examples of the paper that the refinement follows",
                    "maille paper 1", options, run);
    command
        .add_option("EXAMPLE", options->example, "1: the unit cube, 2: the hollow cube; both if not given")
        ->check(CLI::IsMember({1, 2}));
    add_json_option(command, options->common, "the runs");
}

}  // namespace maille::tools
