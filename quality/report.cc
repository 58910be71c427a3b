#include "quality/report.hh"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "volmesh/error.hh"

namespace maille::quality {
namespace {

using volmesh::CellHandle;
using volmesh::TetMesh;

constexpr std::size_t n_measures = measure_infos.size();
constexpr std::size_t n_worst = 10;
/// Sums are taken over chunks of this many cells and then over the chunks in order, whatever thread did
/// which.
constexpr std::uint32_t chunk_size = 4096;

using Values = std::array<double, n_measures>;

/// A question that the paper's tables answer in per cent.
struct Condition {
    const char* name;
    bool needs_size;
    bool (*holds)(const Values&);
};

double value_of(const Values& v, Measure m) {
    return v[static_cast<std::size_t>(m)];
}

constexpr std::array<Condition, 4> conditions{{
    {"r/Lmax<0.4", false, [](const Values& v) { return value_of(v, Measure::sigma) < 0.4; }},
    {"r/Lmax<0.2", false, [](const Values& v) { return value_of(v, Measure::sigma) < 0.2; }},
    {"Lmin/Lmax<0.3", false, [](const Values& v) { return value_of(v, Measure::tau) < 0.3; }},
    // The paper's text has the interval closed; and its refinement stops at 3/2 exactly.
    {"2/3<L/Lbar<3/2", true,
     [](const Values& v) {
         return value_of(v, Measure::phi) >= 2.0 / 3 && value_of(v, Measure::phi) <= 1.5;
     }},
}};

struct Candidate {
    double sigma;
    std::uint32_t cell;
    auto operator<=>(const Candidate&) const = default;
};

/// Figures of one chunk.
struct Partial {
    std::size_t cells = 0, inverted = 0;
    Values min, sum, max;
    std::array<std::vector<std::size_t>, n_measures> histograms;
    std::array<std::size_t, conditions.size()> holding{};
    std::vector<Candidate> worst;

    Partial() {
        min.fill(std::numeric_limits<double>::infinity());
        sum.fill(0);
        max.fill(-std::numeric_limits<double>::infinity());
        for (std::size_t m = 0; m < n_measures; ++m) histograms[m].resize(measure_infos[m].bins);
    }
};

Point centroid(const std::array<Point, 4>& p) {
    return (p[0] + p[1] + p[2] + p[3]) / 4;
}

double wanted_size(const WantedSize& size, const Point& p, std::uint32_t cell) {
    const double wanted = size(p);
    if (!(wanted > 0) || !std::isfinite(wanted))
        throw InputError(fmt::format("the wanted size is {} at ({}, {}, {}), in cell {}: it must be positive",
                                     wanted, p.x(), p.y(), p.z(), cell));
    return wanted;
}

Values measure(const TetGeometry& t, double phi_value) {
    return {beta(t),         sigma(t),        omega(t),           tau(t),
            kappa(t),        alpha(t),        gamma(t),           phi_value,
            dihedral_min(t), dihedral_max(t), solid_angle_min(t), solid_angle_max(t),
            aspect(t),       condition(t),    mean_ratio(t),      scaled_jacobian(t)};
}

std::uint32_t bin(const MeasureInfo& info, double value) {
    const double place = (value - info.low) / (info.high - info.low) * info.bins;
    return static_cast<std::uint32_t>(std::clamp(place, 0.0, info.bins - 1.0));
}

void keep_worst(std::vector<Candidate>& worst) {
    std::sort(worst.begin(), worst.end());
    if (worst.size() > n_worst) worst.resize(n_worst);
}

Partial assess_chunk(const TetMesh& mesh, const WantedSize* size, std::uint32_t first, std::uint32_t last) {
    Partial part;
    for (std::uint32_t i = first; i < last; ++i) {
        const CellHandle c(i);
        if (mesh.is_deleted(c)) continue;
        const auto p = mesh.cell_points(c);
        const TetGeometry t = tet_geometry(p[0], p[1], p[2], p[3]);
        const Values values = measure(t, size ? phi(t, wanted_size(*size, centroid(p), i)) : 0);
        ++part.cells;
        if (!(t.volume > 0)) ++part.inverted;
        for (std::size_t m = 0; m < n_measures; ++m) {
            part.min[m] = std::min(part.min[m], values[m]);
            part.max[m] = std::max(part.max[m], values[m]);
            part.sum[m] += values[m];
            ++part.histograms[m][bin(measure_infos[m], values[m])];
        }
        for (std::size_t k = 0; k < conditions.size(); ++k)
            if (conditions[k].holds(values)) ++part.holding[k];
        part.worst.push_back({value_of(values, Measure::sigma), i});
    }
    keep_worst(part.worst);
    return part;
}

void add(Partial& total, const Partial& part) {
    total.cells += part.cells;
    total.inverted += part.inverted;
    for (std::size_t m = 0; m < n_measures; ++m) {
        total.min[m] = std::min(total.min[m], part.min[m]);
        total.max[m] = std::max(total.max[m], part.max[m]);
        total.sum[m] += part.sum[m];
        for (std::size_t k = 0; k < part.histograms[m].size(); ++k)
            total.histograms[m][k] += part.histograms[m][k];
    }
    for (std::size_t k = 0; k < conditions.size(); ++k) total.holding[k] += part.holding[k];
    total.worst.insert(total.worst.end(), part.worst.begin(), part.worst.end());
    keep_worst(total.worst);
}

Partial assess_cells(const TetMesh& mesh, const WantedSize* size) {
    std::vector<Partial> parts((mesh.n_cells() + std::size_t{chunk_size} - 1) / chunk_size);
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t k) {
        const auto first = static_cast<std::uint32_t>(k * chunk_size);
        parts[k] = assess_chunk(mesh, size, first, first + std::min(chunk_size, mesh.n_cells() - first));
    });
    Partial total;
    for (const Partial& part : parts) add(total, part);
    return total;
}

WorstCell describe(const TetMesh& mesh, CellHandle c) {
    const auto p = mesh.cell_points(c);
    const TetGeometry t = tet_geometry(p[0], p[1], p[2], p[3]);
    WorstCell worst{c, sigma(t), dihedral_min(t), dihedral_max(t), centroid(p), {}};
    for (volmesh::SetHandle set : mesh.sets_of(mesh.combination(c)))
        worst.sets.push_back(mesh.set_info(set).name);
    return worst;
}

}  // namespace

Report assess(const TetMesh& mesh, const WantedSize* size) {
    Partial total = assess_cells(mesh, size);
    Report report;
    report.cells = total.cells;
    report.inverted = total.inverted;
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
    for (const Candidate& candidate : total.worst)
        report.worst.push_back(describe(mesh, CellHandle(candidate.cell)));
    return report;
}

}  // namespace maille::quality
