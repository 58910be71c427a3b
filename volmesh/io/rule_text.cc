#include "volmesh/io/rule_text.hh"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "volmesh/error.hh"
#include "volmesh/io/vtk_names.hh"

namespace maille::volmesh::io {

namespace {

constexpr std::array set_rules{"copy", "none", "both_ends", "from_edges", "from_faces"};
constexpr std::array property_rules{"none", "copy", "interpolate", "share"};

/// Place of the words in the list.
template <std::size_t N>
std::size_t place_of(const std::array<const char*, N>& words, std::string_view word, const char* what) {
    const auto at = std::ranges::find(words, word);
    if (at == words.end())
        throw InputError(
            fmt::format("'{}' is no {}: {} are", word.substr(0, 40), what, fmt::join(words, ", ")));
    return static_cast<std::size_t>(at - words.begin());
}

/// The text up to the first such separator; what follows stays in `text`.
std::string_view take(std::string_view& text, std::string_view separator) {
    const std::size_t end = std::min(text.find(separator), text.size());
    const std::string_view front = text.substr(0, end);
    text.remove_prefix(std::min(end + separator.size(), text.size()));
    return front;
}

}  // namespace

std::string set_rule_text(const TetMesh& mesh, const SetInfo& set) {
    const SetRule::Kind usual = set.kind == EntityKind::vertex ? SetRule::Kind::none : SetRule::Kind::copy;
    if (set.rule.kind == usual || set.rule.kind == SetRule::Kind::custom) return "";
    std::string text = set_rules[static_cast<std::size_t>(set.rule.kind)];
    if (set.rule.source.is_valid()) {
        const SetInfo& source = mesh.set_info(set.rule.source);
        text += fmt::format(" of {} {}", vtk::kind_name(source.kind), source.name);
    }
    return text;
}

EntityKind parse_kind(std::string_view word) {
    return static_cast<EntityKind>(place_of(vtk::kind_names, word, "kind of set"));
}

RuleDraft parse_set_rule(std::string_view text, EntityKind kind) {
    RuleDraft rule{static_cast<SetRule::Kind>(place_of(set_rules, take(text, " of "), "rule of sets"))};
    if (!text.empty()) {
        const EntityKind of = parse_kind(take(text, " "));
        rule.source = {of, std::string(text)};
    }
    const bool is_from = rule.kind == SetRule::Kind::from_edges || rule.kind == SetRule::Kind::from_faces;
    const bool is_of_vertices = is_from || rule.kind == SetRule::Kind::both_ends;
    const bool suits = kind == EntityKind::vertex ? rule.kind != SetRule::Kind::copy : !is_of_vertices;
    if (!suits || (is_from && !rule.source) || (rule.source && !is_of_vertices))
        throw InputError(fmt::format("the rule '{}' does not suit a set of kind {}",
                                     set_rules[static_cast<std::size_t>(rule.kind)], vtk::kind_name(kind)));
    return rule;
}

const char* property_rule_name(PropertyRule rule) {
    return property_rules[static_cast<std::size_t>(rule)];
}

PropertyRule parse_property_rule(std::string_view text) {
    return static_cast<PropertyRule>(place_of(property_rules, text, "rule of properties"));
}

}  // namespace maille::volmesh::io
