#include "tools/html/quantities.hh"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace maille::html {
namespace {

using quality::Measure;
using quality::MeasureInfo;
using volmesh::CellHandle;
using volmesh::TetMesh;

constexpr std::uint32_t n_codes = 1U << 16;

struct Ends {
    double low, high;
};

Ends ends_of_bin(const Quantity& quantity, std::uint32_t bin) {
    const double width = (quantity.high - quantity.low) / quantity.n_bins();
    Ends ends{quantity.low + bin * width, quantity.low + (bin + 1) * width};
    if (bin == 0) ends.low = std::min(ends.low, quantity.statistics.min);
    if (bin + 1 == quantity.n_bins()) ends.high = std::max(quantity.high, quantity.statistics.max);
    return ends;
}

Quantity quantity_of(const MeasureInfo& info, const quality::Report& report) {
    return {.name = std::string(info.name),
            .unit = std::string(info.unit),
            .low = info.low,
            .high = info.high,
            .best = info.best,
            .statistics = report[info.measure],
            .codes = {}};
}

/// Its histogram runs from 0 to the greatest error.
Quantity error_quantity(const TetMesh& mesh, const quality::Report& report, std::span<const double> errors) {
    constexpr std::uint32_t bins = 20;
    Quantity quantity{
        .name = "error", .unit = "", .low = 0, .high = 1, .best = 0, .statistics = {}, .codes = {}};
    quality::Statistics& statistics = quantity.statistics;
    statistics.histogram.resize(bins);
    statistics.mean = report.critical->mean_error;
    bool is_first = true;
    for (const CellHandle c : mesh.cells()) {
        const double error = errors[c.idx()];
        statistics.min = is_first ? error : std::min(statistics.min, error);
        statistics.max = std::max(statistics.max, error);
        is_first = false;
    }
    if (statistics.max > 0) quantity.high = statistics.max;
    for (const CellHandle c : mesh.cells())
        ++statistics.histogram[quality::bin_of(quantity.low, quantity.high, bins, errors[c.idx()])];
    return quantity;
}

}  // namespace

std::uint32_t levels_of_bin(const Quantity& quantity) {
    return n_codes / quantity.n_bins();
}

std::uint16_t encode(const Quantity& quantity, double value) {
    const std::uint32_t levels = levels_of_bin(quantity);
    const std::uint32_t bin = quality::bin_of(quantity.low, quantity.high, quantity.n_bins(), value);
    const Ends ends = ends_of_bin(quantity, bin);
    const double part = std::clamp((value - ends.low) / (ends.high - ends.low), 0.0, 1.0);
    return static_cast<std::uint16_t>(bin * levels + std::lround(part * (levels - 1)));
}

double decode(const Quantity& quantity, std::uint16_t code) {
    const std::uint32_t levels = levels_of_bin(quantity);
    const Ends ends = ends_of_bin(quantity, code / levels);
    return ends.low + (ends.high - ends.low) * (code % levels) / (levels - 1);
}

std::vector<Quantity> quantities_of(const TetMesh& mesh, const quality::Report& report,
                                    const quality::WantedSize* size, std::span<const double> errors) {
    std::vector<Quantity> quantities;
    std::vector<Measure> measures;
    for (const MeasureInfo& info : quality::measure_infos) {
        if (info.measure == Measure::phi && !size) continue;
        quantities.push_back(quantity_of(info, report));
        measures.push_back(info.measure);
    }
    if (!errors.empty()) quantities.push_back(error_quantity(mesh, report, errors));
    for (Quantity& quantity : quantities) quantity.codes.resize(mesh.n_cells());
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, mesh.n_cells(), 1024), [&](const auto& range) {
        for (std::uint32_t i = range.begin(); i != range.end(); ++i) {
            const CellHandle c(i);
            if (mesh.is_deleted(c)) continue;
            const auto values = quality::measure_cell(mesh, c, quality::cell_geometry(mesh, c), size);
            for (std::size_t k = 0; k < measures.size(); ++k)
                quantities[k].codes[i] = encode(quantities[k], value_of(values, measures[k]));
            if (!errors.empty()) quantities.back().codes[i] = encode(quantities.back(), errors[i]);
        }
    });
    return quantities;
}

}  // namespace maille::html
