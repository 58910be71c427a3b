#include "tools/maille/short_of_target.hh"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace maille::tools {
namespace {

/// "12 vertices are short of hole/side, the farthest by 0.01 at (1, 2, 3)", and so on for each combination of
/// surfaces.
std::string words_for(const std::vector<quality::ShortOfTarget>& all) {
    std::map<std::vector<std::string>, std::vector<const quality::ShortOfTarget*>> by_surfaces;
    for (const quality::ShortOfTarget& each : all) by_surfaces[each.surfaces].push_back(&each);
    std::vector<std::string> lines;
    for (const auto& [surfaces, members] : by_surfaces) {
        const quality::ShortOfTarget& farthest =
            **std::ranges::max_element(members, {}, [](const auto* each) {
                return each->distance.value_or(std::numeric_limits<double>::infinity());
            });
        const std::string distance = farthest.distance ? fmt::format("by {:.3g}", *farthest.distance)
                                                       : std::string("with no common point of them nearby");
        lines.push_back(fmt::format("{} {} short of {}, the farthest {} at ({:.6g}, {:.6g}, {:.6g})",
                                    members.size(), members.size() == 1 ? "vertex is" : "vertices are",
                                    fmt::join(surfaces, " and "), distance, farthest.place.x(),
                                    farthest.place.y(), farthest.place.z()));
    }
    return fmt::format("{}", fmt::join(lines, "; "));
}

}  // namespace

void warn_of_short(const quality::ProjectionResult& projection, Progress& progress) {
    if (!projection.short_of_target.empty()) progress.warn(words_for(projection.short_of_target));
}

}  // namespace maille::tools
