#include "quality/report.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "volmesh/error.hh"

namespace maille::quality {
namespace {

using volmesh::CellHandle;
using volmesh::TetMesh;

constexpr std::size_t n_measures = measure_infos.size();
/// Sums are taken over chunks of this many cells and then over the chunks in order, whatever thread did
/// which.
constexpr std::uint32_t chunk_size = 4096;

/// A question that the paper's tables answer in per cent.
struct Condition {
    const char* name;
    bool needs_size;
    bool (*holds)(const CellMeasures&);
};

constexpr std::array<Condition, 4> conditions{{
    {"r/Lmax<0.4", false, [](const CellMeasures& v) { return value_of(v, Measure::sigma) < 0.4; }},
    {"r/Lmax<0.2", false, [](const CellMeasures& v) { return value_of(v, Measure::sigma) < 0.2; }},
    {"Lmin/Lmax<0.3", false, [](const CellMeasures& v) { return value_of(v, Measure::tau) < 0.3; }},
    // The paper's text has the interval closed; and its refinement stops at 3/2 exactly.
    {"2/3<L/Lbar<3/2", true,
     [](const CellMeasures& v) {
         return value_of(v, Measure::phi) >= 2.0 / 3 && value_of(v, Measure::phi) <= 1.5;
     }},
}};

/// A cell and the number that ranks it, least first.
struct Candidate {
    double rank;
    std::uint32_t cell;
    auto operator<=>(const Candidate&) const = default;
};

/// What is looked for, beside the statistics.
struct Question {
    const WantedSize* size;
    std::span<const double> errors;
    double mean_error;
    std::size_t n_worst;
};

/// Figures of one chunk.
struct Partial {
    std::size_t cells = 0, inverted = 0, badly_shaped = 0, critical = 0;
    CellMeasures min, sum, max;
    std::array<std::vector<std::size_t>, n_measures> histograms;
    std::array<std::size_t, conditions.size()> holding{};
    std::vector<Candidate> worst, worst_critical;

    Partial() {
        min.fill(std::numeric_limits<double>::infinity());
        sum.fill(0);
        max.fill(-std::numeric_limits<double>::infinity());
        for (std::size_t m = 0; m < n_measures; ++m) histograms[m].resize(measure_infos[m].bins);
    }
};

void keep_worst(std::vector<Candidate>& worst, std::size_t n) {
    n = std::min(n, worst.size());
    std::ranges::partial_sort(worst, worst.begin() + static_cast<std::ptrdiff_t>(n));
    worst.resize(n);
}

void add_cell(Partial& part, const CellMeasures& values, std::uint32_t cell, const Question& question) {
    ++part.cells;
    for (std::size_t m = 0; m < n_measures; ++m) {
        const MeasureInfo& info = measure_infos[m];
        part.min[m] = std::min(part.min[m], values[m]);
        part.max[m] = std::max(part.max[m], values[m]);
        part.sum[m] += values[m];
        ++part.histograms[m][bin_of(info.low, info.high, info.bins, values[m])];
    }
    for (std::size_t k = 0; k < conditions.size(); ++k)
        if (conditions[k].holds(values)) ++part.holding[k];
    part.worst.push_back({value_of(values, Measure::sigma), cell});
    if (!is_badly_shaped(values)) return;
    ++part.badly_shaped;
    if (question.errors.empty() || !(question.errors[cell] > question.mean_error)) return;
    ++part.critical;
    part.worst_critical.push_back({-question.errors[cell], cell});
}

Partial assess_chunk(const TetMesh& mesh, const Question& question, std::uint32_t first, std::uint32_t last) {
    Partial part;
    for (std::uint32_t i = first; i < last; ++i) {
        const CellHandle c(i);
        if (mesh.is_deleted(c)) continue;
        const TetGeometry t = cell_geometry(mesh, c);
        if (!(t.volume > 0)) ++part.inverted;
        add_cell(part, measure_cell(mesh, c, t, question.size), i, question);
    }
    keep_worst(part.worst, question.n_worst);
    keep_worst(part.worst_critical, question.n_worst);
    return part;
}

void add(Partial& total, const Partial& part, std::size_t n_worst) {
    total.cells += part.cells;
    total.inverted += part.inverted;
    total.badly_shaped += part.badly_shaped;
    total.critical += part.critical;
    for (std::size_t m = 0; m < n_measures; ++m) {
        total.min[m] = std::min(total.min[m], part.min[m]);
        total.max[m] = std::max(total.max[m], part.max[m]);
        total.sum[m] += part.sum[m];
        for (std::size_t k = 0; k < part.histograms[m].size(); ++k)
            total.histograms[m][k] += part.histograms[m][k];
    }
    for (std::size_t k = 0; k < conditions.size(); ++k) total.holding[k] += part.holding[k];
    for (auto list : {&Partial::worst, &Partial::worst_critical}) {
        (total.*list).insert((total.*list).end(), (part.*list).begin(), (part.*list).end());
        keep_worst(total.*list, n_worst);
    }
}

Partial assess_cells(const TetMesh& mesh, const Question& question) {
    std::vector<Partial> parts((mesh.n_cells() + std::size_t{chunk_size} - 1) / chunk_size);
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t k) {
        const auto first = static_cast<std::uint32_t>(k * chunk_size);
        parts[k] = assess_chunk(mesh, question, first, first + std::min(chunk_size, mesh.n_cells() - first));
    });
    Partial total;
    for (const Partial& part : parts) add(total, part, question.n_worst);
    return total;
}

/// Over the cells that are there, in their order.
double mean_of(const TetMesh& mesh, std::span<const double> errors) {
    if (errors.empty()) return 0;
    if (errors.size() != mesh.n_cells())
        throw std::invalid_argument("assess: there must be as many errors as cells");
    double sum = 0;
    std::size_t n = 0;
    for (std::uint32_t i = 0; i < mesh.n_cells(); ++i) {
        if (mesh.is_deleted(CellHandle(i))) continue;
        if (!(errors[i] >= 0) || !std::isfinite(errors[i]))
            throw InputError(fmt::format(
                "the estimated error is {} in cell {}: it must be finite and not negative", errors[i], i));
        sum += errors[i];
        ++n;
    }
    return n == 0 ? 0 : sum / static_cast<double>(n);
}

std::vector<std::string> sets_touched(const TetMesh& mesh, CellHandle c) {
    std::vector<std::string> names;
    for (int k = 0; k < 4; ++k)
        for (volmesh::SetHandle set : mesh.sets_of(mesh.combination(TetMesh::halfface(c, k)))) {
            const std::string& name = mesh.set_info(set).name;
            if (std::ranges::find(names, name) == names.end()) names.push_back(name);
        }
    return names;
}

WorstCell describe(const TetMesh& mesh, CellHandle c, const Question& question) {
    const CellMeasures values = measure_cell(mesh, c, cell_geometry(mesh, c));
    WorstCell worst{.cell = c,
                    .sigma = value_of(values, Measure::sigma),
                    .dihedral_min = value_of(values, Measure::dihedral_min),
                    .dihedral_max = value_of(values, Measure::dihedral_max),
                    .error = question.errors.empty() ? 0 : question.errors[c.idx()],
                    .centroid = centroid(mesh, c),
                    .sets = {},
                    .touches = sets_touched(mesh, c)};
    for (volmesh::SetHandle set : mesh.sets_of(mesh.combination(c)))
        worst.sets.push_back(mesh.set_info(set).name);
    return worst;
}

std::vector<WorstCell> describe(const TetMesh& mesh, const std::vector<Candidate>& candidates,
                                const Question& question) {
    std::vector<WorstCell> cells;
    for (const Candidate& candidate : candidates)
        cells.push_back(describe(mesh, CellHandle(candidate.cell), question));
    return cells;
}

}  // namespace

bool is_badly_shaped(const CellMeasures& values) {
    const double sigma = value_of(values, Measure::sigma);
    return sigma < 0.2 || (sigma < 0.4 && value_of(values, Measure::tau) < 0.3);
}

Report assess(const TetMesh& mesh, const WantedSize* size, const AssessOptions& options) {
    const Question question{.size = size,
                            .errors = options.errors,
                            .mean_error = mean_of(mesh, options.errors),
                            .n_worst = options.n_worst};
    Partial total = assess_cells(mesh, question);
    Report report;
    report.cells = total.cells;
    report.inverted = total.inverted;
    report.badly_shaped = total.badly_shaped;
    report.has_size = size != nullptr;
    const auto n = static_cast<double>(std::max<std::size_t>(total.cells, 1));
    for (std::size_t m = 0; m < n_measures; ++m) {
        Statistics& statistics = report.measures[m];
        if (total.cells > 0) statistics = {total.min[m], total.sum[m] / n, total.max[m], {}};
        statistics.histogram = std::move(total.histograms[m]);
    }
    for (std::size_t k = 0; k < conditions.size(); ++k)
        if (size || !conditions[k].needs_size)
            report.criteria.push_back({conditions[k].name, 100 * static_cast<double>(total.holding[k]) / n});
    report.worst = describe(mesh, total.worst, question);
    if (!options.errors.empty())
        report.critical = Critical{.mean_error = question.mean_error,
                                   .cells = total.critical,
                                   .worst = describe(mesh, total.worst_critical, question)};
    return report;
}

}  // namespace maille::quality
