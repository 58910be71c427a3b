#include "volmesh/io/references.hh"

#include <algorithm>
#include <set>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "volmesh/error.hh"
#include "volmesh/io/input_file.hh"
#include "volmesh/io/vtk_names.hh"

namespace maille::volmesh::io {

namespace {

using nlohmann::ordered_json;

Path sidecar_of(const Path& mesh_path) {
    return Path(mesh_path).replace_extension(".sets.json");
}

struct NamedReferences {
    std::string name;
    EntityKind kind;
    std::vector<long long> references;
    std::optional<RuleDraft> rule{};
};

/// What the action gives; in what it throws the file is named.
template <class Action>
auto in_file(const InputFile& file, const Action& action) {
    try {
        return action();
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", file.name(), error.what()));
    }
}

std::vector<NamedReferences> parse_sidecar(const InputFile& file, const MeshDraft& draft) {
    std::vector<NamedReferences> sets;
    try {
        const auto json = ordered_json::parse(file.text());
        if (json.at("vertices") != draft.points.size() || json.at("cells") != draft.cells.size())
            throw InputError(file.name() + ": tells the sets of another mesh: remove or rename it");
        for (const auto& set : json.at("sets")) {
            const EntityKind kind =
                in_file(file, [&] { return parse_kind(set.at("kind").get<std::string>()); });
            NamedReferences& named = sets.emplace_back();
            named = {set.at("name"), kind, {}};
            for (const auto& reference : set.at("references")) {
                if (!reference.is_number_integer())
                    throw InputError(fmt::format("{}: set '{}' has a reference that is no whole number",
                                                 file.name(), named.name));
                named.references.push_back(reference.get<long long>());
            }
            if (set.contains("rule"))
                named.rule =
                    in_file(file, [&] { return parse_set_rule(set.at("rule").get<std::string>(), kind); });
        }
    } catch (const nlohmann::json::exception& error) {
        throw InputError(fmt::format("{}: {}", file.name(), error.what()));
    }
    return sets;
}

}  // namespace

ReferenceWriter::ReferenceWriter(const TetMesh& mesh, const Path& mesh_path)
    : mesh_(mesh), out_(sidecar_of(mesh_path)) {}

void ReferenceWriter::commit() {
    ordered_json sets = ordered_json::array();
    for (TetMesh::Index s = 0; s < mesh_.n_sets(); ++s) {
        const SetInfo& info = mesh_.set_info(SetHandle(s));
        const auto kind = static_cast<std::size_t>(info.kind);
        ordered_json references = ordered_json::array();
        const auto& combinations = numbers_[kind].ids();
        for (std::size_t i = 0; i < combinations.size(); ++i)
            if (std::ranges::count(mesh_.sets_of(combinations[i]), SetHandle(s)) > 0)
                references.push_back(i + 1);
        sets.push_back(
            {{"name", info.name}, {"kind", vtk::kind_name(info.kind)}, {"references", references}});
        if (const std::string rule = set_rule_text(mesh_, info); !rule.empty()) sets.back()["rule"] = rule;
    }
    const ordered_json json{{"vertices", mesh_.n_vertices()}, {"cells", mesh_.n_cells()}, {"sets", sets}};
    try {
        out_ << json.dump(2) << '\n';
    } catch (const nlohmann::json::exception&) {
        throw InputError("the name of a set is no UTF-8 text: rename it");
    }
    out_.commit();
}

void ReferenceReader::make_sets(MeshDraft& draft, const Path& mesh_path) const {
    auto unnamed = members_;
    const Path sidecar = sidecar_of(mesh_path);
    if (std::filesystem::exists(sidecar)) {
        const InputFile file(sidecar);
        for (const NamedReferences& named : parse_sidecar(file, draft)) {
            MeshDraft::Set& set = draft.set(named.name, named.kind);
            set.rule = named.rule;
            for (long long reference : named.references) {
                const auto members = members_.find({named.kind, reference});
                if (members == members_.end()) continue;
                set.members.insert(set.members.end(), members->second.begin(), members->second.end());
                unnamed.erase(members->first);
            }
        }
    }
    for (const auto& [reference, members] : unnamed)
        draft.set(group_name(reference.second), reference.first).members = members;
}

}  // namespace maille::volmesh::io
