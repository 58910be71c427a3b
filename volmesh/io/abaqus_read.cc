#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "volmesh/error.hh"
#include "volmesh/io/abaqus.hh"
#include "volmesh/io/abaqus_text.hh"
#include "volmesh/io/formats.hh"
#include "volmesh/io/mesh_draft.hh"
#include "volmesh/io/number_map.hh"
#include "volmesh/io/text_scanner.hh"

namespace maille::volmesh::io {

namespace {

using namespace abaqus;
using Index = TetMesh::Index;

/// How many nodes an element of that type has, as far as it can be read.
std::optional<std::size_t> n_nodes_of(const std::string& type) {
    static const std::map<std::string, std::size_t> types{
        {"C3D4", 4}, {"C3D4H", 4},  {"DC3D4", 4}, {"S3", 3},   {"S3R", 3}, {"CPS3", 3}, {"CPE3", 3},
        {"M3D3", 3}, {"SFM3D3", 3}, {"STRI3", 3}, {"T3D2", 2}, {"B31", 2}, {"B31R", 2}};
    const auto at = types.find(type);
    return at == types.end() ? std::nullopt : std::optional(at->second);
}

/// Elements or nodes of one label, as places in the lists of the draft.
struct Group {
    std::string label;  ///< as it is first written
    std::vector<Index> members;
};
using Groups = std::map<std::string, Group>;

class AbaqusReader {
  public:
    explicit AbaqusReader(const Path& path) : file_(path), text_(file_) {}

    MeshDraft read();

  private:
    struct Element {
        EntityKind kind;
        Index place;
    };
    struct Named {
        EntityKind kind;
        std::string key;
        std::string name;
        std::vector<std::array<Index, 2>> edges;  ///< numbers of nodes
        std::optional<RuleDraft> rule{};
    };

    bool next_line();
    bool next_data_line();
    void read_note(std::string_view note);
    void read_keyword();
    std::string parameter(const std::string& name) const;
    bool has_parameter(const std::string& name) const { return parameters_.contains(name); }

    void read_nodes();
    void read_elements();
    void add_element(std::size_t n_nodes, std::span<const std::string_view> items, Group* group);
    template <class Find>
    void read_set(Groups& groups, const std::string& label, Find find);
    void read_surface();
    void add_sides(std::string_view elements, std::string_view side, Group& surface);
    void add_side(Index element, std::string_view side, Group& surface);

    Group& group(Groups& groups, const std::string& label);
    void make_sets();
    void make_set(const Group& group, EntityKind kind, const std::string& name);

    template <class Number>
    Number number(std::string_view item, const char* what) const;
    Index node(std::string_view item) const;
    Index element(std::string_view item) const;
    [[noreturn]] void fail(const std::string& message) const { file_.fail_at_line(line_.data(), message); }

    InputFile file_;
    TextScanner text_;
    std::string_view line_;
    bool is_unread_ = false;  ///< the line is still to be looked at

    std::string keyword_;
    std::map<std::string, std::string> parameters_;

    MeshDraft draft_;
    NumberMap nodes_;
    NumberMap elements_;
    std::vector<Element> element_list_;
    Groups node_sets_;
    Groups element_sets_;
    Groups surfaces_;  ///< of places in the draft's faces
    Groups node_surfaces_;
    std::vector<Named> names_;
    std::set<std::string> whole_;  ///< labels of all nodes or all elements
};

MeshDraft AbaqusReader::read() {
    while (next_line()) {
        if (line_.front() != '*') continue;  // data of a keyword that says nothing of the mesh
        read_keyword();
        if (keyword_ == "NODE") {
            read_nodes();
        } else if (keyword_ == "ELEMENT") {
            read_elements();
        } else if (keyword_ == "NSET") {
            read_set(node_sets_, parameter("NSET"), [this](std::string_view item) { return node(item); });
        } else if (keyword_ == "ELSET") {
            read_set(element_sets_, parameter("ELSET"),
                     [this](std::string_view item) { return element(item); });
        } else if (keyword_ == "SURFACE") {
            read_surface();
        } else if (keyword_ == "INCLUDE" || keyword_ == "INSTANCE") {
            fail(
                fmt::format("*{} cannot be read: only files in one piece, without instances, can", keyword_));
        }
    }
    make_sets();
    return std::move(draft_);
}

/// The next line that is neither empty nor a comment.
bool AbaqusReader::next_line() {
    if (is_unread_) {
        is_unread_ = false;
        return true;
    }
    while (!text_.at_end()) {
        line_ = text_.line();
        if (line_.starts_with(note_sign)) read_note(line_.substr(note_sign.size()));
        if (!line_.empty() && !line_.starts_with("**")) return true;
    }
    return false;
}

bool AbaqusReader::next_data_line() {
    if (!next_line()) return false;
    is_unread_ = line_.front() == '*';
    return !is_unread_;
}

void AbaqusReader::read_note(std::string_view note) {
    const auto word = [&] {
        note = trimmed(note);
        const std::string_view result = note.substr(0, note.find(' '));
        note.remove_prefix(result.size());
        return result;
    };
    const std::string_view what = word();
    if (what == "all") {
        whole_.insert(upper(word()));
    } else if (what == "set") {
        const auto kind = std::ranges::find(kind_names, word());
        const std::string key = upper(word());
        const auto name = nlohmann::json::parse(note, nullptr, false);
        if (kind == kind_names.end() || !name.is_string())
            fail("a note on a set should have its kind, its label and its name in quotes");
        names_.push_back({static_cast<EntityKind>(kind - kind_names.begin()), key, name, {}});
    } else if (what == "rule") {
        const auto rule = nlohmann::json::parse(note, nullptr, false);
        if (names_.empty() || !rule.is_string()) fail("a note on a rule should follow that on its set");
        try {
            names_.back().rule = parse_set_rule(rule.get<std::string>(), names_.back().kind);
        } catch (const InputError& error) {
            fail(error.what());
        }
    } else if (what == "edge") {
        if (names_.empty() || names_.back().kind != EntityKind::edge)
            fail("this edge follows no set of edges");
        const Index a = node(word());
        names_.back().edges.push_back({a, node(word())});
    }
}

/// `*KEYWORD, NAME=VALUE, NAME`; a comma at the end continues it on the next line.
void AbaqusReader::read_keyword() {
    std::string whole(line_);
    while (whole.ends_with(',') && next_data_line()) whole += line_;
    const auto items = split_at_commas(whole);
    keyword_ = upper(items.front().substr(1));
    parameters_.clear();
    for (std::string_view item : items) {
        const std::size_t equals = item.find('=');
        const std::string_view value = equals == std::string_view::npos ? "" : item.substr(equals + 1);
        parameters_[upper(trimmed(item.substr(0, equals)))] = trimmed(value);
    }
}

std::string AbaqusReader::parameter(const std::string& name) const {
    const auto at = parameters_.find(name);
    if (at == parameters_.end() || at->second.empty()) fail(fmt::format("*{} needs {}=", keyword_, name));
    return at->second;
}

void AbaqusReader::read_nodes() {
    Group* set = has_parameter("NSET") ? &group(node_sets_, parameter("NSET")) : nullptr;
    while (next_data_line()) {
        const auto items = split_at_commas(line_);
        if (items.size() < 4) fail("a node has a number and three coordinates");
        nodes_.push_back(number<std::uint64_t>(items[0], "the number of a node"));
        Point point;
        for (int k = 0; k < 3; ++k) {
            point[k] = number<double>(items[static_cast<std::size_t>(k) + 1], "a coordinate");
            if (!std::isfinite(point[k])) fail("a coordinate is not a finite number");
        }
        if (set) set->members.push_back(static_cast<Index>(draft_.points.size()));
        draft_.points.push_back(point);
    }
    if (const auto twice = nodes_.sort()) fail(fmt::format("node {} is there twice", *twice));
}

void AbaqusReader::read_elements() {
    const std::string type = upper(parameter("TYPE"));
    const auto n_nodes = n_nodes_of(type);
    if (!n_nodes)
        fail(
            fmt::format("elements of type {} cannot be read: only linear tetrahedra (C3D4), triangles and "
                        "lines can",
                        type));
    Group* set = has_parameter("ELSET") ? &group(element_sets_, parameter("ELSET")) : nullptr;
    while (next_data_line()) {
        std::string whole(line_);
        auto items = split_at_commas(whole);
        while (items.size() < *n_nodes + 1 && whole.ends_with(',') && next_data_line()) {
            whole += line_;
            items = split_at_commas(whole);
        }
        if (items.size() != *n_nodes + 1)
            fail(fmt::format("an element of type {} has a number and {} nodes", type, *n_nodes));
        add_element(*n_nodes, items, set);
    }
    if (const auto twice = elements_.sort()) fail(fmt::format("element {} is there twice", *twice));
}

void AbaqusReader::add_element(std::size_t n_nodes, std::span<const std::string_view> items, Group* group) {
    elements_.push_back(number<std::uint64_t>(items[0], "the number of an element"));
    std::array<Index, 4> v{};
    for (std::size_t k = 0; k < n_nodes; ++k) v[k] = node(items[k + 1]);
    if (group) group->members.push_back(static_cast<Index>(element_list_.size()));
    if (n_nodes == 4) {
        element_list_.push_back({EntityKind::cell, static_cast<Index>(draft_.cells.size())});
        draft_.cells.push_back(v);
    } else if (n_nodes == 3) {
        element_list_.push_back({EntityKind::face, static_cast<Index>(draft_.faces.size())});
        draft_.faces.push_back({v[0], v[1], v[2]});
    } else {
        element_list_.push_back({EntityKind::edge, static_cast<Index>(draft_.edges.size())});
        draft_.edges.push_back({v[0], v[1]});
    }
}

/// Members by number, by the label of another set, or with GENERATE as first, last and step.
template <class Find>
void AbaqusReader::read_set(Groups& groups, const std::string& label, Find find) {
    Group& set = group(groups, label);
    const bool is_generated = has_parameter("GENERATE");
    while (next_data_line()) {
        const auto items = split_at_commas(line_);
        if (is_generated) {
            if (items.size() < 2 || items.size() > 3)
                fail("GENERATE needs a first and a last number, and a step");
            const auto first = number<std::uint64_t>(items[0], "the first number");
            const auto last = number<std::uint64_t>(items[1], "the last number");
            const auto step = items.size() == 3 ? number<std::uint64_t>(items[2], "the step") : 1;
            if (step == 0 || last < first) fail("a range should go upwards, by steps above 0");
            for (std::uint64_t i = first; i <= last; i += step)
                set.members.push_back(find(std::to_string(i)));
            continue;
        }
        for (std::string_view item : items) {
            if (const auto other = groups.find(key_of(item)); other != groups.end()) {
                const std::vector<Index> members = other->second.members;
                set.members.insert(set.members.end(), members.begin(), members.end());
            } else {
                set.members.push_back(find(item));
            }
        }
    }
}

void AbaqusReader::read_surface() {
    const std::string label = parameter("NAME");
    const bool is_of_nodes = has_parameter("TYPE") && upper(parameter("TYPE")) == "NODE";
    if (is_of_nodes) {
        Group& set = group(node_surfaces_, label);
        while (next_data_line()) {
            const std::string_view item = split_at_commas(line_).front();
            if (const auto other = node_sets_.find(key_of(item)); other != node_sets_.end())
                set.members.insert(set.members.end(), other->second.members.begin(),
                                   other->second.members.end());
            else
                set.members.push_back(node(item));
        }
        return;
    }
    Group& surface = group(surfaces_, label);
    while (next_data_line()) {
        const auto items = split_at_commas(line_);
        if (items.size() != 2) fail("a line of a surface has an element, or a set of them, and a side");
        add_sides(items[0], items[1], surface);
    }
}

void AbaqusReader::add_sides(std::string_view elements, std::string_view side, Group& surface) {
    if (const auto set = element_sets_.find(key_of(elements)); set != element_sets_.end())
        for (Index element : set->second.members) add_side(element, side, surface);
    else
        add_side(element(elements), side, surface);
}

void AbaqusReader::add_side(Index element, std::string_view side, Group& surface) {
    const Element& what = element_list_[element];
    const std::string name = upper(side);
    const auto place = static_cast<Index>(draft_.faces.size());
    if (what.kind == EntityKind::face && (name == "SPOS" || name == "SNEG")) {
        surface.members.push_back(what.place);
    } else if (what.kind == EntityKind::cell && name.size() == 2 && name[0] == 'S' && name[1] >= '1' &&
               name[1] <= '4') {
        const auto& cell = draft_.cells[what.place];
        const auto [a, b, c] = sides[static_cast<std::size_t>(name[1] - '1')];
        draft_.faces.push_back({cell[a], cell[b], cell[c]});
        surface.members.push_back(place);
    } else {
        fail(fmt::format("'{}' is no side of this element", side));
    }
}

Group& AbaqusReader::group(Groups& groups, const std::string& label) {
    Group& result = groups[key_of(label)];
    if (result.label.empty()) result.label = without_quotes(label);
    return result;
}

void AbaqusReader::make_set(const Group& group, EntityKind kind, const std::string& name) {
    auto& members = draft_.set(name, kind).members;
    members.insert(members.end(), group.members.begin(), group.members.end());
}

void AbaqusReader::make_sets() {
    std::map<std::pair<EntityKind, std::string>, std::string> names;
    for (const Named& named : names_) {
        names[{named.kind, named.key}] = named.name;
        MeshDraft::Set& set = draft_.set(named.name, named.kind);
        set.rule = named.rule;
        auto& members = set.members;
        for (const auto& edge : named.edges) {
            members.push_back(static_cast<Index>(draft_.edges.size()));
            draft_.edges.push_back(edge);
        }
    }
    const auto name_of = [&](EntityKind kind, const std::string& key, const Group& group) {
        const auto at = names.find({kind, key});
        return at == names.end() ? group.label : at->second;
    };
    for (const auto& [groups, kind] :
         {std::pair(&node_sets_, EntityKind::vertex), std::pair(&node_surfaces_, EntityKind::vertex),
          std::pair(&surfaces_, EntityKind::face)})
        for (const auto& [key, group] : *groups)
            if (kind != EntityKind::vertex || !whole_.contains(key))
                make_set(group, kind, name_of(kind, key, group));
    for (const auto& [key, group] : element_sets_) {
        if (whole_.contains(key)) continue;
        std::map<EntityKind, Group> by_kind;
        for (Index element : group.members)
            by_kind[element_list_[element].kind].members.push_back(element_list_[element].place);
        for (const auto& [kind, members] : by_kind) make_set(members, kind, name_of(kind, key, group));
    }
}

template <class Number>
Number AbaqusReader::number(std::string_view item, const char* what) const {
    if (item.starts_with('+')) item.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(item.data(), item.data() + item.size(), value);
    if (error != std::errc{} || end != item.data() + item.size())
        fail(fmt::format("'{}' stands where {} should be", item.substr(0, 40), what));
    return value;
}

Index AbaqusReader::node(std::string_view item) const {
    const auto at = nodes_.find(number<std::uint64_t>(item, "a node"));
    if (!at) fail(fmt::format("there is no node {}", item));
    return *at;
}

Index AbaqusReader::element(std::string_view item) const {
    const auto at = elements_.find(number<std::uint64_t>(item, "an element"));
    if (!at) fail(fmt::format("there is no element {}", item));
    return *at;
}

}  // namespace

TetMesh read_abaqus(const Path& path) {
    return assemble(AbaqusReader(path).read(), path);
}

}  // namespace maille::volmesh::io
