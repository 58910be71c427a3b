#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "quality/report.hh"

namespace maille::quality {
namespace {

bool is_told(const Report& report, const MeasureInfo& info) {
    return info.measure != Measure::phi || report.has_size;
}

/// A histogram as a line of blocks: the height of each is an eighth of the fullest bin's, at least one for
/// any cell.
std::string bars(const std::vector<std::size_t>& histogram) {
    static constexpr std::array<const char*, 9> blocks{" ", "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
    const std::size_t fullest =
        std::max<std::size_t>(1, *std::max_element(histogram.begin(), histogram.end()));
    std::string line;
    for (std::size_t count : histogram) line += blocks[(8 * count + fullest - 1) / fullest];
    return line;
}

/// Cut after two digits, never rounded up: 100.00 is all.
double cut(double percent) {
    return std::floor(percent * 100) / 100;
}

/// Six figures, as the paper prints them; what is no more than rounding of nothing is printed as 0.
std::string figure(double x) {
    return fmt::format("{:.6g}", std::abs(x) < 1e-14 ? 0.0 : x);
}

double percent(std::size_t part, std::size_t whole) {
    return 100 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(whole, 1));
}

void append_list(std::string& text, const std::string& title, const std::vector<WorstCell>& cells,
                 bool has_errors) {
    if (cells.empty()) return;
    auto out = std::back_inserter(text);
    fmt::format_to(out, "\n{:<14}{:>10}{:>10}{:>21}  {:<36}  sets\n", title, has_errors ? "error" : "",
                   "sigma", "dihedral angles", "centroid");
    for (const WorstCell& w : cells)
        fmt::format_to(
            out, "{:>14}{:>10}{:>10}{:>21}  {:<36}  {}{}{}\n", w.cell.idx(),
            has_errors ? fmt::format("{:.4g}", w.error) : "", fmt::format("{:.4g}", w.sigma),
            fmt::format("{:.1f}..{:.1f}", w.dihedral_min, w.dihedral_max),
            fmt::format("({:.5g}, {:.5g}, {:.5g})", w.centroid.x(), w.centroid.y(), w.centroid.z()),
            fmt::join(w.sets, ", "), w.touches.empty() ? "" : "; at ", fmt::join(w.touches, ", "));
}

nlohmann::ordered_json list_of(const std::vector<WorstCell>& cells, bool has_errors) {
    auto list = nlohmann::ordered_json::array();
    for (const WorstCell& w : cells) {
        list.push_back({{"cell", w.cell.idx()},
                        {"sigma", w.sigma},
                        {"dihedral_min", w.dihedral_min},
                        {"dihedral_max", w.dihedral_max},
                        {"centroid", {w.centroid.x(), w.centroid.y(), w.centroid.z()}},
                        {"sets", w.sets},
                        {"touches", w.touches}});
        if (has_errors) list.back()["error"] = w.error;
    }
    return list;
}

}  // namespace

std::string to_text(const Report& report) {
    std::string text;
    auto out = std::back_inserter(text);
    fmt::format_to(out, "{} cells, {} inverted\n\n", report.cells, report.inverted);
    fmt::format_to(out, "{:<13}{:>12}{:>12}{:>12}  histogram\n", "measure", "min", "mean", "max");
    for (const MeasureInfo& info : measure_infos) {
        if (!is_told(report, info)) continue;
        const Statistics& s = report[info.measure];
        fmt::format_to(out, "{:<13}{:>12}{:>12}{:>12}  {:g} |{}| {:g}\n", info.name, figure(s.min),
                       figure(s.mean), figure(s.max), info.low, bars(s.histogram), info.high);
    }
    fmt::format_to(out, "\n{:<16}{:>9}\n", "criterion", "% cells");
    for (const Criterion& c : report.criteria)
        fmt::format_to(out, "{:<16}{:>9.2f}\n", c.name, cut(c.percent));
    fmt::format_to(out, "\n{} cells of bad shape (sigma < 0.2, or sigma < 0.4 and tau < 0.3)\n",
                   report.badly_shaped);
    if (report.critical)
        fmt::format_to(out, "{} of them critical: with an error above the mean, {:.6g}\n",
                       report.critical->cells, report.critical->mean_error);
    append_list(text, "worst cells", report.worst, report.critical.has_value());
    if (report.critical) append_list(text, "critical cells", report.critical->worst, true);
    return text;
}

nlohmann::ordered_json to_json(const Report& report) {
    using Json = nlohmann::ordered_json;
    Json json{{"cells", report.cells}, {"inverted", report.inverted}};
    for (const MeasureInfo& info : measure_infos) {
        Json& entry = json["measures"][std::string(info.name)];
        if (!is_told(report, info)) continue;
        const Statistics& s = report[info.measure];
        entry = {{"min", s.min},
                 {"mean", s.mean},
                 {"max", s.max},
                 {"histogram", s.histogram},
                 {"range", {info.low, info.high}}};
    }
    json["criteria"] = Json::object();
    for (const Criterion& c : report.criteria) json["criteria"][c.name] = c.percent;
    json["bad_shape"] = {{"cells", report.badly_shaped},
                         {"percent", percent(report.badly_shaped, report.cells)}};
    json["critical"] = nullptr;
    if (const auto& critical = report.critical)
        json["critical"] = {{"cells", critical->cells},
                            {"percent", percent(critical->cells, report.cells)},
                            {"mean_error", critical->mean_error},
                            {"worst", list_of(critical->worst, true)}};
    json["worst"] = list_of(report.worst, report.critical.has_value());
    return json;
}

}  // namespace maille::quality
