/// How fast and how lean refinement and the mesh data structure are, as Markdown tables.

#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tools/benchmark/files.hh"
#include "tools/benchmark/incidences.hh"
#include "tools/benchmark/merging.hh"
#include "tools/benchmark/refinement.hh"
#include "volmesh/error.hh"

using namespace maille::benchmark;

int main(int argc, char** argv) {
    CLI::App app("How fast and how lean refinement and the mesh are.");
    app.require_subcommand(1);
    std::string start = "kuhn:20";
    RefinementCase what;
    int kuhn = 55;

    auto* refinement = app.add_subcommand("refine", "Refines a mesh of the unit cube");
    refinement->add_option("--start", start, "The start mesh: kuhn:N (N^3 bricks of six) or a file")
        ->capture_default_str();
    const std::map<std::string, Work> works{{"local", Work::local},
                                            {"expression", Work::expression},
                                            {"uniform", Work::uniform},
                                            {"eighths", Work::eighths}};
    refinement
        ->add_option("--work", what.work,
                     "local, expression (the same as a text), uniform (to one size) or eighths")
        ->transform(CLI::CheckedTransformer(works));
    refinement->add_option("--scale", what.scale, "Local work: multiplies all sizes")->capture_default_str();
    refinement->add_option("--size", what.size, "Uniform work: the size");
    refinement->add_option("--levels", what.levels, "Eighths: how often every element is cut into eight")
        ->capture_default_str();
    refinement->add_flag("!--bare", what.with_parts, "Without the twenty sets and the property");
    refinement->add_flag("--check", what.check, "Validate the results, which takes longer than the work");
    refinement->add_option("--threads", what.threads)->capture_default_str();
    refinement->add_option("--repeat", what.repeats, "The median of so many runs")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);

    auto* mesh = app.add_subcommand("mesh", "Builds a mesh and goes through its incidences");
    mesh->add_option("--kuhn", kuhn, "Bricks a side; 55 makes 998,250 tetrahedra")->capture_default_str();
    mesh->add_option("--repeat", what.repeats, "The best of so many runs")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    std::string start_of_files = "kuhn:94";
    auto* files = app.add_subcommand("files", "Writes and reads a mesh, and copies its files");
    files
        ->add_option("--start", start_of_files,
                     "The mesh: kuhn:N or a file; kuhn:94 has 4,983,504 tetrahedra")
        ->capture_default_str();
    files->add_option("--repeat", what.repeats, "The best of so many runs")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    auto* merging = app.add_subcommand("merge", "Merges a box and a cylinder, at four sizes");
    merging->add_option("--repeat", what.repeats, "The best of so many runs")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    CLI11_PARSE(app, argc, argv);

    try {
        if (refinement->parsed()) {
            for (const auto& [name, work] : works)
                if (work == what.work) what.name = name + ", " + start;
            print_refinement_header();
            run(start_mesh(start), what);
        } else if (merging->parsed()) {
            measure_merging(what.repeats);
        } else if (files->parsed()) {
            measure_files(start_mesh(start_of_files), what.repeats);
        } else {
            const CellSoup soup = kuhn_cube(kuhn);
            fmt::print("{} tetrahedra, ordered\n\n", soup.cells.size());
            measure_incidences(soup, what.repeats);
            fmt::print("\nrandomly renumbered\n\n");
            measure_incidences(renumbered(soup, 1), what.repeats);
        }
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
    return 0;
}
