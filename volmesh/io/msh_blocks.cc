#include "volmesh/io/msh_blocks.hh"

#include <algorithm>

#include <fmt/core.h>

#include "volmesh/error.hh"
#include "volmesh/io/combination_numbers.hh"
#include "volmesh/io/msh_contents.hh"
#include "volmesh/io/set_elements.hh"

namespace maille::volmesh::io::msh {

namespace {

int dimension_of(EntityKind kind) {
    return static_cast<int>(kind);
}

int group_of_rest_in(const TetMesh& mesh) {
    return static_cast<int>(mesh.n_sets()) + 1;
}

/// Sorts elements of one dimension into blocks.
class Blocks {
  public:
    Blocks(std::vector<Block>& blocks, const TetMesh& mesh, int dimension)
        : blocks_(blocks), first_(blocks.size()), mesh_(mesh), dimension_(dimension) {}

    Block& of(CombinationId combination) {
        const auto number = static_cast<std::size_t>(numbers_.number(combination));
        if (first_ + number > blocks_.size())
            blocks_.push_back({dimension_, static_cast<int>(number), groups(combination), {}});
        return blocks_[first_ + number - 1];
    }

  private:
    std::vector<int> groups(CombinationId combination) const {
        std::vector<int> groups;
        for (SetHandle set : mesh_.sets_of(combination)) groups.push_back(group_of(set));
        if (groups.empty() && mesh_.n_sets() > 0) groups.push_back(group_of_rest_in(mesh_));
        return groups;
    }

    std::vector<Block>& blocks_;
    std::size_t first_;
    const TetMesh& mesh_;
    int dimension_;
    CombinationNumbers numbers_;
};

template <std::size_t N>
void add_blocks(std::vector<Block>& blocks, const TetMesh& mesh, const std::vector<SetElement<N>>& elements) {
    Blocks of_dimension(blocks, mesh, N - 1);
    for (const SetElement<N>& element : elements) {
        Element written{{}, element.cell};
        std::ranges::copy(element.vertices, written.vertices.begin());
        of_dimension.of(element.combination).elements.push_back(written);
    }
}

void require_writable(const std::string& name) {
    if (name.find_first_of("\"\n\r") != std::string::npos)
        throw InputError(
            fmt::format("the name '{}' cannot stand in a Gmsh file, as it has a quote or a line end: "
                        "rename it or write .vtu",
                        name));
}

void write_field_head(OutputFile& out, const char* section, const Field& field, std::size_t n_values) {
    out << '$' << section << "\n1\n\"" << field.name << "\"\n1\n0\n3\n0\n";
    out << field.n_components() << '\n' << n_values << '\n';
}

void write_value(OutputFile& out, const Field& field, std::size_t item, std::size_t number, bool is_binary) {
    const double* values = field.values.data() + item * field.n_components();
    if (is_binary) {
        out.write_value(static_cast<std::int32_t>(number));
        out.write_array(std::span(values, field.n_components()));
    } else {
        out << number;
        for (std::size_t k = 0; k < field.n_components(); ++k) out << ' ' << values[k];
        out << '\n';
    }
}

void write_vertex_field(OutputFile& out, const Field& field, bool is_binary) {
    const std::size_t n = field.values.size() / field.n_components();
    write_field_head(out, "NodeData", field, n);
    for (std::size_t i = 0; i < n; ++i) write_value(out, field, i, i + 1, is_binary);
    out << (is_binary ? "\n$EndNodeData\n" : "$EndNodeData\n");
}

void write_cell_field(OutputFile& out, const Field& field, const std::vector<CellHandle>& elements,
                      bool is_binary) {
    write_field_head(out, "ElementData", field, elements.size());
    Field nothing = field;
    nothing.values.assign(field.n_components(), 0);
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const bool has_cell = elements[i].is_valid();
        write_value(out, has_cell ? field : nothing, has_cell ? elements[i].idx() : 0, i + 1, is_binary);
    }
    out << (is_binary ? "\n$EndElementData\n" : "$EndElementData\n");
}

void write_types(OutputFile& out, const std::vector<Field>& fields) {
    const auto has_own_type = [](const Field& f) {
        return f.type == FieldType::real32 || f.type == FieldType::int32;
    };
    const auto n = std::ranges::count_if(fields, has_own_type);
    if (n == 0) return;
    out << "$MailleProperties\n" << n << '\n';
    for (const Field& field : fields)
        if (has_own_type(field))
            out << (field.kind == EntityKind::vertex ? "vertex " : "cell ") << type_name(field.type) << " \""
                << field.name << "\"\n";
    out << "$EndMailleProperties\n";
}

}  // namespace

std::vector<Block> blocks_of(const TetMesh& mesh) {
    std::vector<Block> blocks;
    Blocks cells(blocks, mesh, 3);
    for (TetMesh::Index i = 0; i < mesh.n_cells(); ++i)
        cells.of(mesh.combination(CellHandle(i)))
            .elements.push_back({mesh.cell_vertex_indices()[i], CellHandle(i)});
    if (blocks.empty()) cells.of(0);
    const SetElements elements = set_elements(mesh);
    add_blocks(blocks, mesh, elements.faces);
    add_blocks(blocks, mesh, elements.edges);
    add_blocks(blocks, mesh, elements.vertices);
    return blocks;
}

int type_of_dimension(int dimension) {
    constexpr std::array types{point, line, triangle, tetrahedron};
    return types[dimension];
}

void write_head(OutputFile& out, const TetMesh& mesh, bool is_version_4, bool is_binary) {
    for (TetMesh::Index s = 0; s < mesh.n_sets(); ++s) {
        const SetInfo& set = mesh.set_info(SetHandle(s));
        require_writable(set.name);
        if (set.kind == EntityKind::cell && set.name == group_of_rest)
            throw InputError(fmt::format(
                "the name '{}' stands for the cells of no set in a Gmsh file: rename the set", set.name));
    }
    out << "$MeshFormat\n" << (is_version_4 ? "4.1 " : "2.2 ") << (is_binary ? "1 8\n" : "0 8\n");
    if (is_binary) {
        out.write_value(std::int32_t{1});
        out << '\n';
    }
    out << "$EndMeshFormat\n";
}

void write_names(OutputFile& out, const TetMesh& mesh) {
    if (mesh.n_sets() == 0) return;
    bool has_rest = false;
    for (TetMesh::Index c = 0; c < mesh.n_cells() && !has_rest; ++c)
        has_rest = mesh.combination(CellHandle(c)) == 0;
    out << "$PhysicalNames\n" << mesh.n_sets() + (has_rest ? 1U : 0U) << '\n';
    for (TetMesh::Index s = 0; s < mesh.n_sets(); ++s) {
        const SetInfo& set = mesh.set_info(SetHandle(s));
        out << dimension_of(set.kind) << ' ' << group_of(SetHandle(s)) << " \"" << set.name << "\"\n";
    }
    if (has_rest) out << "3 " << group_of_rest_in(mesh) << " \"" << group_of_rest << "\"\n";
    out << "$EndPhysicalNames\n";
}

void write_fields(OutputFile& out, const TetMesh& mesh, const std::vector<CellHandle>& elements,
                  bool is_binary) {
    const std::vector<Field> fields = fields_of(mesh);
    for (const Field& field : fields) {
        require_writable(field.name);
        if (field.kind == EntityKind::vertex) {
            write_vertex_field(out, field, is_binary);
        } else {
            write_cell_field(out, field, elements, is_binary);
        }
    }
    write_types(out, fields);
    write_rules(out, mesh, fields);
}

}  // namespace maille::volmesh::io::msh
