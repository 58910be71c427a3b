#include "tools/benchmark/refinement.hh"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include <fmt/format.h>

#include "quality/measures.hh"
#include "refine/refine.hh"
#include "refine/uniform.hh"
#include "tools/benchmark/meter.hh"
#include "tools/benchmark/named_parts.hh"
#include "volmesh/validate.hh"

namespace maille::benchmark {
namespace {

struct Figures {
    std::uint32_t cells = 0, new_cells = 0;
    Seconds seconds;
    refine::Seconds phases;
    std::size_t peak = 0;
    std::uint64_t digest = 0;
    double worst = 1;
};

refine::SizeField size_of(const RefinementCase& what) {
    if (what.work == Work::uniform) return refine::SizeField(what.size);
    if (what.work == Work::eighths) return refine::SizeField(1.0);
    if (what.work == Work::expression)
        return refine::parse_size(fmt::format("{}*(0.0008+0.05*(1-exp(-r)))", what.scale));
    return refine::SizeField([scale = what.scale](const volmesh::Point& p) {
        return scale * (0.0008 + 0.05 * (1 - std::exp(-p.norm())));
    });
}

refine::RefineResult refine_by(const RefinementCase& what, volmesh::TetMesh& mesh,
                               const refine::SizeField& size) {
    if (what.work == Work::eighths)
        return refine::refine_uniformly(mesh, {.levels = what.levels, .threads = what.threads});
    return refine::refine(mesh, size, {.threads = what.threads});
}

/// A number that changes with every bit of the mesh (FNV-1a on whole words).
std::uint64_t digest(const volmesh::TetMesh& mesh) {
    std::uint64_t sum = 14695981039346656037U;
    const auto add = [&](std::uint64_t word) { sum = (sum ^ word) * 1099511628211U; };
    for (const auto& cell : mesh.cell_vertex_indices())
        for (const std::uint32_t v : cell) add(v);
    for (const auto& p : mesh.points())
        for (int i = 0; i < 3; ++i) add(std::bit_cast<std::uint64_t>(p[i]));
    for (const auto c : mesh.cells()) add(mesh.combination(volmesh::CellHandle(c)));
    for (const auto v : mesh.vertices()) add(mesh.combination(volmesh::VertexHandle(v)));
    return sum;
}

double worst_radius_ratio(const volmesh::TetMesh& mesh) {
    double worst = 1;
    for (const auto c : mesh.cells()) {
        const auto p = mesh.cell_points(c);
        worst = std::min(worst, quality::beta(quality::tet_geometry(p[0], p[1], p[2], p[3])));
    }
    return worst;
}

Figures measure(const CellSoup& soup, const RefinementCase& what) {
    Figures figures;
    const refine::SizeField size = size_of(what);
    forget_peak();
    const std::size_t before = resident_bytes();
    volmesh::TetMesh mesh = soup.mesh();
    if (what.with_parts) name_parts(mesh);
    const std::uint32_t n_before = mesh.n_cells();
    const Seconds start = now();
    const refine::RefineResult result = refine_by(what, mesh, size);
    figures.seconds = now() - start;
    figures.peak = peak_bytes() - before;
    figures.phases = result.seconds;
    figures.cells = mesh.n_cells();
    figures.new_cells = mesh.n_cells() - n_before;
    figures.digest = digest(mesh);
    figures.worst = worst_radius_ratio(mesh);
    if (!result.ended) throw std::runtime_error("the refinement has not ended");
    if (what.check && !volmesh::validate(mesh).ok())
        throw std::runtime_error("the refined mesh is not valid");
    return figures;
}

template <class Value>
auto median(const std::vector<Figures>& runs, const Value& value) {
    std::vector<decltype(value(runs[0]))> values;
    for (const Figures& run : runs) values.push_back(value(run));
    std::ranges::sort(values);
    return values[values.size() / 2];
}

}  // namespace

void print_refinement_header() {
    fmt::print(
        "| work | threads | tets | 3r/R min | Mtet/s | in user mode | splitting alone | wall s "
        "| B/tet at the peak | digest |\n"
        "|---|---|---|---|---|---|---|---|---|---|\n");
}

void run(const CellSoup& soup, const RefinementCase& what) {
    std::vector<Figures> runs;
    for (int i = 0; i < what.repeats; ++i) {
        runs.push_back(measure(soup, what));
        if (runs[i].digest != runs[0].digest) throw std::runtime_error("the same input gave another mesh");
    }
    const double millions = runs[0].new_cells / 1e6;
    const auto splitting = [](const Figures& f) {
        return f.seconds.cpu * f.phases.split / (f.phases.split + f.phases.mark);
    };
    fmt::print("| {} | {} | {} | {:.3f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.0f} | {:016x} |\n",
               what.name, what.threads, runs[0].cells, runs[0].worst,
               millions / median(runs, [](const Figures& f) { return f.seconds.cpu; }),
               millions / median(runs, [](const Figures& f) { return f.seconds.cpu - f.seconds.system; }),
               millions / median(runs, splitting),
               median(runs, [](const Figures& f) { return f.seconds.wall; }),
               static_cast<double>(median(runs, [](const Figures& f) { return f.peak; })) / runs[0].cells,
               runs[0].digest);
    std::fflush(stdout);
}

}  // namespace maille::benchmark
