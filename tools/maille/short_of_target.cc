#include "tools/maille/short_of_target.hh"

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace maille::tools {
namespace {

/// "12 vertices are short of hole/side, the farthest by 0.01 at (1, 2, 3)".
std::string words_for(const std::vector<std::string>& surfaces,
                      const std::vector<const quality::ShortOfTarget*>& members) {
    const quality::ShortOfTarget& farthest = **std::ranges::max_element(
        members, {}, [](const auto* each) { return each->distance.value_or(each->off); });
    const std::string distance =
        farthest.distance
            ? fmt::format("by {:.3g}", *farthest.distance)
            : fmt::format("off one of them, which have no common point nearby, by {:.3g}", farthest.off);
    return fmt::format("{} {} short of {}, the farthest {} at ({:.6g}, {:.6g}, {:.6g})", members.size(),
                       members.size() == 1 ? "vertex is" : "vertices are", fmt::join(surfaces, " and "),
                       distance, farthest.place.x(), farthest.place.y(), farthest.place.z());
}

/// The same for each combination of surfaces, those with the most vertices first, and how many are left over.
std::string words_for(const std::vector<quality::ShortOfTarget>& all) {
    constexpr std::size_t most_words = 5;
    using Members = std::vector<const quality::ShortOfTarget*>;
    std::map<std::vector<std::string>, Members> by_surfaces;
    for (const quality::ShortOfTarget& each : all) by_surfaces[each.surfaces].push_back(&each);
    std::vector<std::pair<std::vector<std::string>, Members>> groups(by_surfaces.begin(), by_surfaces.end());
    std::ranges::stable_sort(groups, std::greater(), [](const auto& group) { return group.second.size(); });
    std::vector<std::string> words;
    std::size_t n_told = 0;
    for (const auto& [surfaces, members] : groups) {
        if (words.size() == most_words) break;
        words.push_back(words_for(surfaces, members));
        n_told += members.size();
    }
    if (n_told < all.size())
        words.push_back(fmt::format("and {} more vertices of others", all.size() - n_told));
    return fmt::format("{}", fmt::join(words, "; "));
}

}  // namespace

void warn_of_short(const quality::ProjectionResult& projection, Progress& progress) {
    if (!projection.short_of_target.empty()) progress.warn(words_for(projection.short_of_target));
}

}  // namespace maille::tools
