// MFEM's text format, version 1.3, in which attributes have names. An element's attribute stands for the
// combination of sets that it is in; those of no set have the attributes of a set of that name. All of the
// boundary is there, and what else is in sets of faces. Sets of edges and vertices and rules of sets, for
// which MFEM has no place, stand behind the end of its mesh.
#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/core.h>

#include "volmesh/error.hh"
#include "volmesh/io/combination_numbers.hh"
#include "volmesh/io/formats.hh"
#include "volmesh/io/mesh_draft.hh"
#include "volmesh/io/output_file.hh"
#include "volmesh/io/rule_text.hh"
#include "volmesh/io/set_elements.hh"
#include "volmesh/io/text_scanner.hh"
#include "volmesh/io/vtk_names.hh"

namespace maille::volmesh::io {

namespace {

using Index = TetMesh::Index;

constexpr const char* set_of_rest = "(no set)";
constexpr int triangle = 2;
constexpr int tetrahedron = 4;

// ---- reading
// --------------------------------------------------------------------------------------------------------
class MfemReader {
  public:
    explicit MfemReader(const Path& path) : file_(path), text_(file_, '#') {}

    MeshDraft read();

  private:
    /// Members by attribute, and attributes by set.
    struct Attributes {
        std::map<std::int64_t, std::vector<Index>> members;
        std::vector<std::pair<std::string, std::vector<std::int64_t>>> sets;
    };

    bool has_read(std::string_view section);
    std::string set_name();
    void read_vertices();
    template <std::size_t N>
    void read_elements(int geometry, std::vector<std::array<Index, N>>& elements, Attributes& attributes);
    template <class Each>
    void read_named_lists(std::size_t numbers_each, const Each& read_one);
    void read_attribute_sets(Attributes& attributes);
    void read_edge_sets();
    void read_vertex_sets();
    void read_rules();
    void make_sets(const Attributes& attributes, EntityKind kind);
    Index vertex();

    InputFile file_;
    TextScanner text_;
    MeshDraft draft_;
    Attributes of_cells_, of_faces_;
    std::vector<std::tuple<EntityKind, std::string, RuleDraft>> rules_;
};

MeshDraft MfemReader::read() {
    if (!text_.rest().starts_with("MFEM mesh v1."))
        text_.fail(text_.rest().starts_with("MFEM")
                       ? "only MFEM's formats of the kind 'MFEM mesh v1.x' can be read"
                       : "a file of MFEM's begins with 'MFEM mesh v1.'");
    text_.line();
    while (!text_.at_end()) {
        const std::string_view section = text_.word("a section");
        if (!has_read(section))
            text_.fail(fmt::format("'{}' is no section that can be read", section.substr(0, 40)));
    }
    make_sets(of_cells_, EntityKind::cell);
    make_sets(of_faces_, EntityKind::face);
    for (const auto& [kind, name, rule] : rules_)
        if (draft_.find_set(name, kind) != nullptr) draft_.set(name, kind).rule = rule;
    return std::move(draft_);
}

bool MfemReader::has_read(std::string_view section) {
    if (section == "dimension") {
        if (text_.integer<int>("the dimension") != 3) text_.fail("the dimension should be 3");
    } else if (section == "elements") {
        read_elements(tetrahedron, draft_.cells, of_cells_);
    } else if (section == "boundary") {
        read_elements(triangle, draft_.faces, of_faces_);
    } else if (section == "attribute_sets") {
        read_attribute_sets(of_cells_);
    } else if (section == "bdr_attribute_sets") {
        read_attribute_sets(of_faces_);
    } else if (section == "vertices") {
        read_vertices();
    } else if (section == "edge_sets") {
        read_edge_sets();
    } else if (section == "vertex_sets") {
        read_vertex_sets();
    } else if (section == "set_rules") {
        read_rules();
    } else if (section == "nodes") {
        text_.fail("curved meshes (with 'nodes') cannot be read: only linear tetrahedra can");
    } else if (section == "vertex_parents") {
        text_.fail("meshes with hanging nodes ('vertex_parents') cannot be read");
    } else {
        return section == "mfem_mesh_end";
    }
    return true;
}

/// Elements come before the vertices: assemble() sees whether those are there.
Index MfemReader::vertex() {
    return text_.integer<Index>("a vertex");
}

void MfemReader::read_vertices() {
    const std::size_t n = text_.count("the number of vertices", 6);
    if (n == 0 && text_.at_end()) return;
    if (text_.word("the dimension") != "3") text_.fail("vertices should have 3 coordinates, and stand here");
    if (!draft_.points.empty()) text_.fail("the vertices are there twice");
    draft_.points.reserve(n);
    for (std::size_t i = 0; i < n; ++i) draft_.points.push_back(text_.point());
}

template <std::size_t N>
void MfemReader::read_elements(int geometry, std::vector<std::array<Index, N>>& elements,
                               Attributes& attributes) {
    const std::size_t n = text_.count("the number of elements", 2 * N + 4);
    elements.reserve(elements.size() + n);
    for (std::size_t i = 0; i < n; ++i) {
        const auto attribute = text_.integer<std::int64_t>("an attribute");
        if (text_.integer<int>("a geometry type") != geometry)
            text_.fail("only tetrahedra (type 4), and triangles (type 2) on the boundary, can be read");
        attributes.members[attribute].push_back(static_cast<Index>(elements.size()));
        auto& element = elements.emplace_back();
        for (Index& v : element) v = vertex();
    }
}

/// In quotes or of one word.
std::string MfemReader::set_name() {
    if (text_.at_end()) text_.fail("the file ends where a set should be");
    if (text_.rest().front() != '"') return std::string(text_.word("the name of a set"));
    text_.bytes(1);
    const std::size_t end = text_.rest().find_first_of("\"\n");
    if (end == std::string_view::npos || text_.rest()[end] == '\n')
        text_.fail("the name of a set has no closing quote");
    const std::string name(text_.bytes(end));
    text_.bytes(1);
    return name;
}

/// A number of lists; each has a name, a number of items and the items.
template <class Each>
void MfemReader::read_named_lists(std::size_t numbers_each, const Each& read_one) {
    const std::size_t n_sets = text_.count("the number of sets");
    for (std::size_t i = 0; i < n_sets; ++i) {
        const std::string name = set_name();
        read_one(name, text_.count("the number of a set's members", 2 * numbers_each));
    }
}

void MfemReader::read_attribute_sets(Attributes& attributes) {
    read_named_lists(1, [&](const std::string& name, std::size_t n) {
        auto& set = attributes.sets.emplace_back(name, std::vector<std::int64_t>());
        for (std::size_t k = 0; k < n; ++k) set.second.push_back(text_.integer<std::int64_t>("an attribute"));
    });
}

void MfemReader::read_edge_sets() {
    read_named_lists(2, [&](const std::string& name, std::size_t n) {
        auto& members = draft_.set(name, EntityKind::edge).members;
        for (std::size_t k = 0; k < n; ++k) {
            members.push_back(static_cast<Index>(draft_.edges.size()));
            const Index a = vertex();
            draft_.edges.push_back({a, vertex()});
        }
    });
}

void MfemReader::read_vertex_sets() {
    read_named_lists(1, [&](const std::string& name, std::size_t n) {
        auto& members = draft_.set(name, EntityKind::vertex).members;
        for (std::size_t k = 0; k < n; ++k) {
            members.push_back(vertex());
            if (members.back() >= draft_.points.size()) text_.fail("a set has a vertex that there is not");
        }
    });
}

/// A line each: kind, name and rule.
void MfemReader::read_rules() {
    const std::size_t n = text_.count("the number of rules", 8);
    for (std::size_t i = 0; i < n; ++i) {
        const std::string_view kind_word = text_.word("the kind of a set");
        const std::string name = set_name();
        const std::string_view rule = text_.line();
        try {
            const EntityKind kind = parse_kind(kind_word);
            rules_.emplace_back(kind, name, parse_set_rule(rule, kind));
        } catch (const InputError& error) {
            text_.fail(error.what());
        }
    }
}

/// Attributes that no set names are groups without a name.
void MfemReader::make_sets(const Attributes& attributes, EntityKind kind) {
    auto unnamed = attributes.members;
    for (const auto& [name, numbers] : attributes.sets) {
        for (std::int64_t number : numbers) unnamed.erase(number);
        if (name == set_of_rest) continue;
        auto& members = draft_.set(name, kind).members;
        for (std::int64_t number : numbers)
            if (const auto at = attributes.members.find(number); at != attributes.members.end())
                members.insert(members.end(), at->second.begin(), at->second.end());
    }
    for (const auto& [number, members] : unnamed) draft_.set(group_name(number), kind).members = members;
}

// ---- writing
// --------------------------------------------------------------------------------------------------------
std::string quoted(const std::string& name) {
    if (name.find_first_of("\"\n\r") != std::string::npos || name == set_of_rest)
        throw InputError(fmt::format(
            "the name '{}' cannot stand in a file of MFEM's: rename the set or write .vtu", name));
    return '"' + name + '"';
}

/// The sets of a kind, in the order of their making.
std::vector<SetHandle> sets_of_kind(const TetMesh& mesh, EntityKind kind) {
    std::vector<SetHandle> sets;
    for (Index s = 0; s < mesh.n_sets(); ++s)
        if (mesh.set_info(SetHandle(s)).kind == kind) sets.emplace_back(s);
    return sets;
}

void write_attribute_sets(OutputFile& out, const TetMesh& mesh, const char* section, EntityKind kind,
                          const CombinationNumbers& numbers) {
    const auto write = [&](const std::string& quoted_name, const auto& is_in) {
        std::string list;
        std::size_t n = 0;
        for (std::size_t i = 0; i < numbers.ids().size(); ++i)
            if (is_in(mesh.sets_of(numbers.ids()[i]))) {
                list += fmt::format("{}{}", n == 0 ? "" : " ", i + 1);
                ++n;
            }
        out << quoted_name << '\n' << n << '\n' << list << '\n';
    };
    const auto sets = sets_of_kind(mesh, kind);
    const bool has_rest = std::ranges::count(numbers.ids(), CombinationId{0}) > 0;
    out << '\n' << section << '\n' << sets.size() + (has_rest ? 1U : 0U) << '\n';
    for (SetHandle set : sets)
        write(quoted(mesh.set_info(set).name),
              [&](std::span<const SetHandle> in) { return std::ranges::count(in, set) > 0; });
    if (has_rest)
        write(fmt::format("\"{}\"", set_of_rest), [](std::span<const SetHandle> in) { return in.empty(); });
}

void write_element(OutputFile& out, int attribute, int geometry, const auto& vertices) {
    out << attribute << ' ' << geometry;
    for (Index v : vertices) out << ' ' << v;
    out << '\n';
}

/// Faces on the boundary or in sets, by half-face, seen from outside their cell.
std::vector<HalffaceHandle> written_faces(const TetMesh& mesh) {
    std::vector<HalffaceHandle> faces;
    for (const HalffaceHandle hf : mesh.halffaces())
        if (mesh.is_boundary(hf) || (hf < mesh.opposite_halfface_handle(hf) && mesh.combination(hf) != 0))
            faces.push_back(hf);
    return faces;
}

template <std::size_t N>
void write_member_sets(OutputFile& out, const TetMesh& mesh, const char* section, EntityKind kind,
                       const std::vector<SetElement<N>>& elements) {
    const auto sets = sets_of_kind(mesh, kind);
    if (sets.empty()) return;
    out << '\n' << section << '\n' << sets.size() << '\n';
    for (SetHandle set : sets) {
        const auto is_member = [&](const SetElement<N>& element) {
            return std::ranges::count(mesh.sets_of(element.combination), set) > 0;
        };
        out << quoted(mesh.set_info(set).name) << '\n' << std::ranges::count_if(elements, is_member) << '\n';
        for (const SetElement<N>& element : elements) {
            if (!is_member(element)) continue;
            for (std::size_t k = 0; k < N; ++k) out << element.vertices[k] << (k + 1 < N ? ' ' : '\n');
        }
    }
}

void write_rules(OutputFile& out, const TetMesh& mesh) {
    std::vector<std::string> lines;
    for (const EntityKind kind : {EntityKind::cell, EntityKind::face, EntityKind::edge, EntityKind::vertex})
        for (SetHandle set : sets_of_kind(mesh, kind))
            if (const std::string rule = set_rule_text(mesh, mesh.set_info(set)); !rule.empty())
                lines.push_back(
                    fmt::format("{} {} {}", vtk::kind_name(kind), quoted(mesh.set_info(set).name), rule));
    if (lines.empty()) return;
    out << "\nset_rules\n" << lines.size() << '\n';
    for (const std::string& line : lines) out << line << '\n';
}

}  // namespace

TetMesh read_mfem(const Path& path) {
    return assemble(MfemReader(path).read(), path);
}

void write_mfem(const TetMesh& mesh, const Path& path) {
    OutputFile out(path);
    CombinationNumbers of_cells;
    CombinationNumbers of_faces;
    out << "MFEM mesh v1.3\n\ndimension\n3\n\nelements\n" << mesh.n_cells() << '\n';
    for (const CellHandle c : mesh.cells())
        write_element(out, of_cells.number(mesh.combination(c)), tetrahedron,
                      mesh.cell_vertex_indices()[c.idx()]);
    write_attribute_sets(out, mesh, "attribute_sets", EntityKind::cell, of_cells);

    const auto faces = written_faces(mesh);
    out << "\nboundary\n" << faces.size() << '\n';
    for (const HalffaceHandle hf : faces) {
        const auto [a, b, c] = mesh.halfface_vertices(hf);
        write_element(out, of_faces.number(mesh.combination(hf)), triangle,
                      std::array{a.idx(), b.idx(), c.idx()});
    }
    write_attribute_sets(out, mesh, "bdr_attribute_sets", EntityKind::face, of_faces);

    out << "\nvertices\n" << mesh.n_vertices() << "\n3\n";
    for (const Point& p : mesh.points()) out << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    out << "\nmfem_mesh_end\n";

    const SetElements elements = set_elements(mesh);
    write_member_sets(out, mesh, "edge_sets", EntityKind::edge, elements.edges);
    write_member_sets(out, mesh, "vertex_sets", EntityKind::vertex, elements.vertices);
    write_rules(out, mesh);
    out.commit();
}

}  // namespace maille::volmesh::io
