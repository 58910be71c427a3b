// $MailleRules, which others skip: the rules of sets and properties that are not those that a reader chooses.
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "volmesh/error.hh"
#include "volmesh/io/msh_blocks.hh"
#include "volmesh/io/msh_contents.hh"
#include "volmesh/io/rule_text.hh"
#include "volmesh/io/vtk_names.hh"

namespace maille::volmesh::io::msh {

namespace {

bool is_usual(const Field& field) {
    const bool is_interpolated = field.kind == EntityKind::vertex && field.type != FieldType::int32;
    return !field.rule || *field.rule == (is_interpolated ? PropertyRule::interpolate : PropertyRule::copy);
}

}  // namespace

void write_rules(OutputFile& out, const TetMesh& mesh, const std::vector<Field>& fields) {
    std::vector<std::string> lines;
    for (TetMesh::Index s = 0; s < mesh.n_sets(); ++s) {
        const SetInfo& set = mesh.set_info(SetHandle(s));
        if (const std::string rule = set_rule_text(mesh, set); !rule.empty())
            lines.push_back(fmt::format("set {} \"{}\" {}", vtk::kind_name(set.kind), set.name, rule));
    }
    for (const Field& field : fields)
        if (!is_usual(field))
            lines.push_back(fmt::format("property {} \"{}\" {}", vtk::kind_name(field.kind), field.name,
                                        property_rule_name(*field.rule)));
    if (lines.empty()) return;
    out << "$MailleRules\n" << lines.size() << '\n';
    for (const std::string& line : lines) out << line << '\n';
    out << "$EndMailleRules\n";
}

void read_rules(Contents& contents, MshSource& source) {
    TextScanner& text = source.text();
    const std::size_t n = text.count("the number of rules", 8);
    for (std::size_t i = 0; i < n; ++i) {
        const std::string_view what = text.word("set or property");
        const std::string_view kind_word = text.word("a kind");
        const std::string_view line = text.line();
        const std::size_t end = line.rfind('"');
        if (!line.starts_with('"') || end == 0) text.fail("a name in quotes should stand here");
        const std::string name(line.substr(1, end - 1));
        const std::string_view rule = line.substr(std::min(end + 2, line.size()));
        try {
            const EntityKind kind = parse_kind(kind_word);
            if (what == "set")
                contents.set_rules.push_back({{name, kind}, parse_set_rule(rule, kind)});
            else
                contents.property_rules.push_back({{name, kind}, parse_property_rule(rule)});
        } catch (const InputError& error) {
            text.fail(error.what());
        }
    }
}

/// Others may have dropped what a rule is of.
void set_rules(Contents& contents) {
    MeshDraft& draft = contents.draft;
    for (const auto& [of, rule] : contents.set_rules)
        if (draft.find_set(of.first, of.second) != nullptr) draft.set(of.first, of.second).rule = rule;
    for (const auto& [of, rule] : contents.property_rules)
        for (Field& field : draft.fields)
            if (field.name == of.first && field.kind == of.second) field.rule = rule;
}

}  // namespace maille::volmesh::io::msh
