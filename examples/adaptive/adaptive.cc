#include <cstdio>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/os.h>

#include "examples/adaptive/loop.hh"
#include "modeler/build.hh"
#include "volmesh/error.hh"
#include "volmesh/io/mesh_io.hh"

namespace {

using namespace maille;

struct Options {
    std::string example;
    std::string output = "adaptive-out";
    double start_size = 0.5;
    Eigen::Index most_unknowns = 100'000;
    double energy = 0;
};

/// Writes the mesh of a step with its solution and its estimated errors.
void write_step(volmesh::TetMesh mesh, const Eigen::VectorXd& values, const std::vector<double>& errors,
                const std::filesystem::path& path) {
    volmesh::VPropHandleT<double> u;
    volmesh::CPropHandleT<double> error;
    mesh.add_property(u, "u");
    mesh.add_property(error, "estimated error");
    for (const volmesh::VertexHandle v : mesh.vertices()) mesh.property(u, v) = values[v.idx()];
    for (const volmesh::CellHandle c : mesh.cells()) mesh.property(error, c) = errors[c.idx()];
    volmesh::write_mesh(mesh, path);
}

std::vector<adaptive::Step> run_one(const adaptive::Example& example, const Options& options,
                                    bool is_uniform) {
    const auto model = modeler::read_model(std::string(ADAPTIVE_MODELS) + "/" + example.model);
    const auto projector = modeler::projector(model);
    const char* kind = is_uniform ? "uniform" : "adaptive";
    int number = 0;
    const auto see = [&](const volmesh::TetMesh& mesh, const adaptive::Step& step,
                         const Eigen::VectorXd& values, const std::vector<double>& errors) {
        const std::string name = fmt::format("{}_{}_{}.vtu", example.name, kind, number++);
        write_step(mesh, values, errors, std::filesystem::path(options.output) / name);
        fmt::print("{}: {} cells, {} unknowns, energy {:.8g}, estimate {:.5g}\n", name, step.cells,
                   step.unknowns, step.energy, step.estimate);
        std::fflush(stdout);
    };
    return adaptive::run(example, modeler::build(model, {.size = options.start_size}), projector,
                         {.is_uniform = is_uniform, .most_unknowns = options.most_unknowns, .see = see});
}

void write_table(const std::vector<adaptive::Step>& steps, const std::filesystem::path& path) {
    auto file = fmt::output_file(path.string());
    file.print("unknowns,cells,energy,error,estimate\n");
    for (const auto& step : steps)
        file.print("{},{},{:.12g},{:.6g},{:.6g}\n", step.unknowns, step.cells, step.energy,
                   step.error.value_or(0), step.estimate);
}

void run(const Options& options) {
    std::filesystem::create_directories(options.output);
    const adaptive::Example example = adaptive::example(options.example);
    std::vector<adaptive::Step> adapted = run_one(example, options, false);
    std::vector<adaptive::Step> uniform = run_one(example, options, true);
    if (!example.exact) {
        const double energy = options.energy > 0 ? options.energy : adaptive::extrapolated_energy(adapted, 4);
        fmt::print("energy {}: {:.9g}\n", options.energy > 0 ? "given" : "extrapolated", energy);
        adaptive::set_errors(adapted, energy);
        adaptive::set_errors(uniform, energy);
    }
    const std::filesystem::path folder = options.output;
    write_table(adapted, folder / (example.name + "_adaptive.csv"));
    write_table(uniform, folder / (example.name + "_uniform.csv"));
    fmt::print(
        "slope of the error against the unknowns, over the last steps: adaptive {:.3f}, uniform {:.3f}\n",
        adaptive::slope(adapted, 3), adaptive::slope(uniform, 2));
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App program("Solves a Poisson problem on meshes that are refined where its error is large");
    Options options;
    program.add_option("EXAMPLE", options.example, "fichera or blind_hole")->required();
    program.add_option("-o,--output", options.output, "Folder for the meshes and tables");
    program.add_option("--size", options.start_size, "Size of the start mesh")->check(CLI::PositiveNumber);
    program.add_option("--unknowns", options.most_unknowns, "Most unknowns")->check(CLI::PositiveNumber);
    program.add_option("--energy", options.energy,
                       "Energy of the exact solution, for errors of fichera; extrapolated if not given");
    CLI11_PARSE(program, argc, argv);
    try {
        run(options);
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "adaptive: error: {}\n", error.what());
        return 2;
    }
}
