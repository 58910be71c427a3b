#include <cstdlib>
#include <limits>
#include <map>
#include <utility>

#include <fmt/core.h>

#include "volmesh/error.hh"
#include "volmesh/io/formats.hh"
#include "volmesh/io/msh_contents.hh"

namespace maille::volmesh::io {

namespace msh {

namespace {

/// What a type of element is called, for messages.
const char* name_of_type(std::int32_t type) {
    switch (type) {
        case 3:
            return "quadrangle";
        case 5:
            return "hexahedron";
        case 6:
            return "prism";
        case 7:
            return "pyramid";
        case 8:
            return "second-order line";
        case 9:
            return "second-order triangle";
        case 11:
            return "second-order tetrahedron";
        case 26:
            return "third-order line";
        case 21:
            return "third-order triangle";
        case 29:
            return "third-order tetrahedron";
        default:
            return "unknown";
    }
}

std::string quoted_text(MshSource& source) {
    std::string_view text = source.text().line();
    if (text.size() < 2 || text.front() != '"' || text.back() != '"')
        source.fail("a name in quotes should stand here");
    return std::string(text.substr(1, text.size() - 2));
}

void read_names(Contents& contents, MshSource& source) {
    const std::size_t n = source.text().count("the number of names", 6);
    for (std::size_t i = 0; i < n; ++i) {
        const auto dimension = source.text().integer<std::int32_t>("the dimension of a group");
        const auto tag = source.text().integer<std::int32_t>("the number of a group");
        if (dimension < 0 || dimension > 3) source.fail("the dimension of a group should be 0 to 3");
        contents.names.push_back({{dimension, tag}, quoted_text(source)});
    }
}

/// $MailleEntities: what 2.2 has no place for, all groups of the entities of cells.
void read_groups_of_cells(Contents& contents, MshSource& source) {
    TextScanner& text = source.text();
    const std::size_t n = text.count("the number of entities", 4);
    for (std::size_t i = 0; i < n; ++i) {
        const auto entity = text.integer<std::int32_t>("the tag of an entity");
        std::vector<std::int32_t>& groups = contents.groups_of_entity[{3, entity}];
        groups.resize(text.count("the number of groups", 2));
        for (std::int32_t& group : groups) group = text.integer<std::int32_t>("the number of a group");
    }
}

/// $MailleCellOrder: where the cells were in the mesh, in the order of the file, by runs.
void read_cell_order(Contents& contents, MshSource& source) {
    contents.cell_order.resize(source.text().count("the number of runs", 4));
    for (auto& [first, length] : contents.cell_order) {
        first = source.text().integer<Index>("the place of a cell");
        length = source.text().integer<Index>("the number of cells");
    }
}

/// $MailleProperties: types of those fields that are not of doubles.
void read_types(Contents& contents, MshSource& source) {
    TextScanner& text = source.text();
    const std::size_t n = text.count("the number of properties", 8);
    for (std::size_t i = 0; i < n; ++i) {
        const std::string_view kind = text.word("vertex or cell");
        const std::string_view type = text.word("a type");
        auto& types = kind == "cell" ? contents.cell_types : contents.vertex_types;
        for (const FieldType known : {FieldType::real32, FieldType::int32})
            if (type == type_name(known)) types.emplace_back(quoted_text(source), known);
    }
}

/// $NodeData and $ElementData. What has no value in the file gets none (NaN).
void read_data(Contents& contents, MshSource& source, EntityKind kind) {
    TextScanner& text = source.text();
    const std::size_t n_names = text.count("the number of names", 2);
    text.line();
    std::string name;
    for (std::size_t i = 0; i < n_names; ++i) {
        if (i == 0)
            name = quoted_text(source);
        else
            text.line();
    }
    const std::size_t n_reals = text.count("the number of real tags", 2);
    for (std::size_t i = 0; i < n_reals; ++i) text.real("a real tag");
    const std::size_t n_integers = text.count("the number of integer tags", 2);
    if (n_integers < 3) source.fail("there should be at least three integer tags");
    std::size_t n_components = 0;
    std::size_t n_items = 0;
    for (std::size_t i = 0; i < n_integers; ++i) {
        const auto tag = text.integer<std::int64_t>("an integer tag");
        if (i == 1) n_components = static_cast<std::size_t>(tag);
        if (i == 2) n_items = static_cast<std::size_t>(tag);
    }
    text.line();
    if (n_components < 1 || n_components > 9) source.fail("a field should have 1 to 9 components");
    source.checked(n_items, "the number of values", 1 + n_components);

    const NumberMap& numbers = kind == EntityKind::vertex ? contents.nodes : contents.cells;
    std::vector<double> values(numbers.size() * n_components, std::numeric_limits<double>::quiet_NaN());
    bool has_values = false;
    for (std::size_t i = 0; i < n_items; ++i) {
        const std::int32_t number = source.integer("the number of a node or element");
        const auto at = numbers.find(static_cast<std::uint64_t>(number));
        for (std::size_t k = 0; k < n_components; ++k) {
            const double value = source.real("a value");
            if (at) values[*at * n_components + k] = value;
        }
        has_values = has_values || at;
    }
    if (has_values) append_field(contents.draft.fields, name, kind, FieldType::real64, n_components, values);
}

void read_node_data(Contents& contents, MshSource& source) {
    read_data(contents, source, EntityKind::vertex);
}
void read_element_data(Contents& contents, MshSource& source) {
    read_data(contents, source, EntityKind::cell);
}

using SectionReader = void (*)(Contents&, MshSource&);

/// Null for a section that says nothing of the mesh.
SectionReader reader_of(const std::string& section, bool is_version_4) {
    static const std::map<std::string, SectionReader> common{
        {"PhysicalNames", read_names},        {"NodeData", read_node_data},
        {"ElementData", read_element_data},   {"MailleEntities", read_groups_of_cells},
        {"MailleCellOrder", read_cell_order}, {"MailleProperties", read_types},
        {"MailleRules", read_rules}};
    static const std::map<std::string, SectionReader> of_version_4{
        {"Entities", read_entities},
        {"PartitionedEntities", read_partitioned_entities},
        {"Nodes", read_nodes41},
        {"Elements", read_elements41}};
    static const std::map<std::string, SectionReader> of_version_2{{"Nodes", read_nodes22},
                                                                   {"Elements", read_elements22}};
    for (const auto* readers : {&common, is_version_4 ? &of_version_4 : &of_version_2})
        if (const auto reader = readers->find(section); reader != readers->end()) return reader->second;
    return nullptr;
}

void make_sets(Contents& contents) {
    MeshDraft& draft = contents.draft;
    std::map<DimTag, std::string> names(contents.names.begin(), contents.names.end());
    for (const auto& [group, name] : contents.names)
        if (group.dimension != 3 || name != group_of_rest)
            draft.set(name, kind_of_dimension(group.dimension));
    for (auto& [group, members] : contents.members) {
        const auto named = names.find(group);
        const std::string name = named == names.end() ? group_name(group.tag) : named->second;
        if (group.dimension == 3 && name == group_of_rest) continue;
        auto& of_set = draft.set(name, kind_of_dimension(group.dimension)).members;
        of_set.insert(of_set.end(), members.begin(), members.end());
    }
}

void set_types(Contents& contents) {
    for (Field& field : contents.draft.fields) {
        const auto& types = field.kind == EntityKind::vertex ? contents.vertex_types : contents.cell_types;
        for (const auto& [name, type] : types)
            if (field.name == name && field.type == FieldType::real64 &&
                (type != FieldType::int32 || smallest_integer_type(field.values) == FieldType::int32))
                field.type = type;
    }
}

/// Puts the cells back where they were in the mesh.
void restore_cell_order(Contents& contents, const std::string& file) {
    if (contents.cell_order.empty()) return;
    MeshDraft& draft = contents.draft;
    const std::size_t n_cells = draft.cells.size();
    std::vector<Index> place;
    place.reserve(n_cells);
    std::vector<std::uint8_t> is_taken(n_cells, 0);
    bool is_order = true;
    for (const auto& [first, length] : contents.cell_order) {
        is_order = is_order && first <= n_cells && length <= n_cells - first;
        for (Index p = first; is_order && p - first < length; ++p) {
            is_order = std::exchange(is_taken[p], 1) == 0;
            place.push_back(p);
        }
    }
    if (!is_order || place.size() != n_cells)
        throw InputError(file + ": $MailleCellOrder is not an order of the cells");
    auto cells = draft.cells;
    for (Index i = 0; i < place.size(); ++i) cells[place[i]] = draft.cells[i];
    draft.cells = std::move(cells);
    for (auto& [group, members] : contents.members)
        if (group.dimension == 3)
            for (Index& member : members) member = place[member];
    for (Field& field : draft.fields) {
        if (field.kind != EntityKind::cell) continue;
        const std::size_t n = field.n_components();
        auto values = field.values;
        for (std::size_t i = 0; i < place.size(); ++i)
            for (std::size_t k = 0; k < n; ++k) values[place[i] * n + k] = field.values[i * n + k];
        field.values = std::move(values);
    }
}

}  // namespace

int n_nodes(const MshSource& source, std::int32_t element_type) {
    switch (element_type) {
        case point:
            return 1;
        case line:
            return 2;
        case triangle:
            return 3;
        case tetrahedron:
            return 4;
        default:
            source.fail(fmt::format(
                "element type {} (number {} of Gmsh's) cannot be read: only linear tetrahedra and their "
                "triangles, lines and points can",
                name_of_type(element_type), element_type));
    }
}

void add_elements(Contents& contents, const MshSource& source, std::int32_t type,
                  std::span<const std::uint64_t> numbers, std::span<const std::int32_t> groups) {
    if (type != tetrahedron && groups.empty()) return;
    const auto n_vertices = static_cast<std::size_t>(n_nodes(source, type));
    MeshDraft& draft = contents.draft;
    std::vector<std::vector<Index>*> members;
    for (std::int32_t group : groups)
        members.push_back(&contents.members[{static_cast<std::int32_t>(n_vertices) - 1, std::abs(group)}]);
    for (std::size_t at = 0; at < numbers.size(); at += 1 + n_vertices) {
        std::array<Index, 4> v{};
        for (std::size_t k = 0; k < n_vertices; ++k) {
            const std::uint64_t node = numbers[at + 1 + k];
            const auto vertex = contents.nodes.find(node);
            if (!vertex)
                source.fail(fmt::format("element {} has node {}, which there is not", numbers[at], node));
            v[k] = *vertex;
        }
        std::size_t place = v[0];
        if (type == tetrahedron) {
            place = draft.cells.size();
            draft.cells.push_back(v);
            contents.cells.push_back(numbers[at]);
        } else if (type == triangle) {
            place = draft.faces.size();
            draft.faces.push_back({v[0], v[1], v[2]});
        } else if (type == line) {
            place = draft.edges.size();
            draft.edges.push_back({v[0], v[1]});
        }
        for (auto* of_group : members) of_group->push_back(static_cast<Index>(place));
    }
}

void sort_nodes(Contents& contents, const MshSource& source) {
    if (const auto twice = contents.nodes.sort()) source.fail(fmt::format("node {} is there twice", *twice));
}

}  // namespace msh

TetMesh read_msh(const Path& path) {
    const InputFile file(path);
    MshSource source(file);
    msh::Contents contents;
    for (std::string name = source.next_section(); !name.empty(); name = source.next_section()) {
        if (const msh::SectionReader read = msh::reader_of(name, source.is_version_4())) {
            read(contents, source);
            source.end_section(name);
        } else {
            source.skip_section(name);
        }
    }
    msh::restore_cell_order(contents, file.name());
    msh::set_types(contents);
    msh::make_sets(contents);
    msh::set_rules(contents);
    return assemble(std::move(contents.draft), path);
}

}  // namespace maille::volmesh::io
