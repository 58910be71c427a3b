#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "volmesh/tet_mesh.hh"

/// Rules of heritage in words, as files keep them: `none`, `copy`, `interpolate`, `share` for properties;
/// `none`, `copy`, `both_ends`, and `both_ends of face wall`, `from_edges of edge rim`, `from_faces of face
/// wall` for sets, with the kind and the name of the set that the rule looks at.
namespace maille::volmesh::io {

/// A set's rule, whose source may not be made yet.
struct RuleDraft {
    SetRule::Kind kind;
    std::optional<std::pair<EntityKind, std::string>> source{};
};

/// No words for what a reader takes anyway, the default of the kind, nor for functions of the user's, which
/// no file can hold.
std::string set_rule_text(const TetMesh& mesh, const SetInfo& set);
/// "vertex", "edge", "face" or "cell". Throws InputError for other words.
EntityKind parse_kind(std::string_view word);
/// Throws InputError where the words mean nothing, or no rule for sets of that kind.
RuleDraft parse_set_rule(std::string_view text, EntityKind kind);

const char* property_rule_name(PropertyRule rule);
PropertyRule parse_property_rule(std::string_view text);

}  // namespace maille::volmesh::io
