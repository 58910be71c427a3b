// VTK's XML unstructured grid, as ParaView and meshio read it: arrays appended, in raw bytes, compressed by
// zlib. The tetrahedra come first, then what is in sets: triangles, lines, vertices. A set is an array of
// UInt8 over all cells, 1 for its members; its attribute `kinds` tells which dimensions it speaks of, so that
// sets of different kinds may share a name.
#include <algorithm>
#include <limits>
#include <map>
#include <sstream>

#include <pugixml.hpp>

#include "volmesh/io/fields.hh"
#include "volmesh/io/formats.hh"
#include "volmesh/io/output_file.hh"
#include "volmesh/io/rule_text.hh"
#include "volmesh/io/set_elements.hh"
#include "volmesh/io/vtk_arrays.hh"
#include "volmesh/io/vtk_names.hh"

namespace maille::volmesh::io {

namespace {

/// The tree of the file, and what is appended to it.
class VtuTree {
  public:
    VtuTree(std::size_t n_points, std::size_t n_cells) {
        auto root = document_.append_child("VTKFile");
        for (const auto& [name, value] : {std::pair{"type", "UnstructuredGrid"},
                                          {"version", "1.0"},
                                          {"byte_order", "LittleEndian"},
                                          {"header_type", "UInt64"},
                                          {"compressor", "vtkZLibDataCompressor"}})
            root.append_attribute(name) = value;
        grid_ = root.append_child("UnstructuredGrid");
        piece_ = grid_.append_child("Piece");
        piece_.append_attribute("NumberOfPoints") = static_cast<unsigned long long>(n_points);
        piece_.append_attribute("NumberOfCells") = static_cast<unsigned long long>(n_cells);
        for (const char* section : {"PointData", "CellData", "Points", "Cells"}) piece_.append_child(section);
    }

    template <class T>
    pugi::xml_node add(const char* section, const std::string& name, std::span<const T> values,
                       int n_components = 1) {
        return add(piece_.child(section), name, values, n_components);
    }

    /// What is of the whole grid, or of neither its points nor its cells.
    template <class T>
    pugi::xml_node add_field_data(const std::string& name, std::span<const T> values, int n_components = 1) {
        auto section = grid_.child("FieldData");
        if (!section) section = grid_.prepend_child("FieldData");
        auto array = add(section, name, values, n_components);
        array.append_attribute("NumberOfTuples") =
            static_cast<unsigned long long>(values.size() / static_cast<std::size_t>(n_components));
        return array;
    }

    void write(const Path& path) const {
        std::ostringstream text;
        document_.save(text, "  ");
        const std::string head = text.str();
        OutputFile out(path);
        out << std::string_view(head).substr(0, head.rfind("</VTKFile>"));
        out << "  <AppendedData encoding=\"raw\">\n   _";
        for (const std::string& part : parts_) out << part;
        out << "\n  </AppendedData>\n</VTKFile>\n";
        out.commit();
    }

  private:
    template <class T>
    pugi::xml_node add(pugi::xml_node section, const std::string& name, std::span<const T> values,
                       int n_components) {
        auto array = section.append_child("DataArray");
        array.append_attribute("type") = vtk::type_name<T>;
        array.append_attribute("Name") = name.c_str();
        if (n_components > 1) array.append_attribute("NumberOfComponents") = n_components;
        array.append_attribute("format") = "appended";
        array.append_attribute("offset") = static_cast<unsigned long long>(offset_);
        for (std::string& part :
             vtk::compressed({reinterpret_cast<const char*>(values.data()), values.size_bytes()})) {
            offset_ += part.size();
            parts_.push_back(std::move(part));
        }
        return array;
    }

    pugi::xml_document document_;
    pugi::xml_node grid_, piece_;
    std::vector<std::string> parts_;  ///< of what is appended
    std::size_t offset_ = 0;
};

/// What is not a tetrahedron.
struct LowerCells {
    std::vector<std::uint8_t> types;
    std::vector<CombinationId> combinations;
    std::vector<CellHandle> cells;
    std::vector<TetMesh::Index> connectivity;

    template <std::size_t N>
    void add(const std::vector<SetElement<N>>& elements, std::uint8_t type) {
        for (const SetElement<N>& element : elements) {
            types.push_back(type);
            combinations.push_back(element.combination);
            cells.push_back(element.cell);
            connectivity.insert(connectivity.end(), element.vertices.begin(), element.vertices.end());
        }
    }
};

template <class T>
void add_connectivity(VtuTree& tree, const TetMesh& mesh, const LowerCells& lower) {
    std::vector<T> connectivity;
    std::vector<T> offsets;
    std::vector<std::uint8_t> types(mesh.n_cells(), vtk::tetra);
    connectivity.reserve(std::size_t{4} * mesh.n_cells() + lower.connectivity.size());
    offsets.reserve(mesh.n_cells() + lower.types.size());
    for (const auto& cell : mesh.cell_vertex_indices()) {
        connectivity.insert(connectivity.end(), cell.begin(), cell.end());
        offsets.push_back(static_cast<T>(connectivity.size()));
    }
    connectivity.insert(connectivity.end(), lower.connectivity.begin(), lower.connectivity.end());
    for (std::uint8_t type : lower.types) {
        types.push_back(type);
        offsets.push_back(static_cast<T>((offsets.empty() ? 0 : offsets.back()) + vtk::n_vertices(type)));
    }
    tree.add<T>("Cells", "connectivity", connectivity);
    tree.add<T>("Cells", "offsets", offsets);
    tree.add<std::uint8_t>("Cells", "types", types);
}

template <class T>
pugi::xml_node add_field(VtuTree& tree, const Field& field, const std::vector<double>& values) {
    const std::vector<T> typed(values.begin(), values.end());
    const auto n_components = static_cast<int>(field.n_components());
    switch (field.kind) {
        case EntityKind::vertex:
            return tree.add<T>("PointData", field.name, typed, n_components);
        case EntityKind::cell:
            return tree.add<T>("CellData", field.name, typed, n_components);
        default: {
            auto array = tree.add_field_data<T>(field.name, typed, n_components);
            array.append_attribute("of") = vtk::kind_name(field.kind);
            return array;
        }
    }
}

void add_field(VtuTree& tree, const Field& field, const LowerCells& lower) {
    std::vector<double> values = field.values;
    if (field.kind == EntityKind::cell) {  // a triangle, line or vertex has the value of its cell
        const std::size_t n = field.n_components();
        for (CellHandle cell : lower.cells)
            for (std::size_t k = 0; k < n; ++k)
                values.push_back(cell.is_valid() ? field.values[cell.idx() * n + k] : 0);
    }
    auto array = field.type == FieldType::real32  ? add_field<float>(tree, field, values)
                 : field.type == FieldType::int32 ? add_field<std::int32_t>(tree, field, values)
                                                  : add_field<double>(tree, field, values);
    if (field.rule) array.append_attribute("rule") = property_rule_name(*field.rule);
    if (!field.default_value.empty()) {
        std::string text;
        for (double x : field.default_value) text += (text.empty() ? "" : " ") + text_of(x);
        array.append_attribute("default") = text.c_str();
    }
}

/// A text is its bytes.
void add_mesh_value(VtuTree& tree, const MeshValue& property) {
    const auto add = [&](const auto* begin, std::size_t n, int n_components, const char* of) {
        using T = std::remove_cvref_t<decltype(*begin)>;
        tree.add_field_data<T>(property.name, {begin, n}, n_components).append_attribute("of") = of;
    };
    std::visit(
        [&]<class T>(const T& value) {
            if constexpr (std::is_same_v<T, std::string>) {
                add(reinterpret_cast<const std::uint8_t*>(value.data()), value.size(), 1, "mesh text");
            } else if constexpr (std::is_arithmetic_v<T>) {
                add(&value, 1, 1, "mesh");
            } else {
                add(value.data(), 3, 3, "mesh");
            }
        },
        property.value);
}

/// Entities one after another that are in the same sets.
struct Run {
    CombinationId combination;
    std::size_t length;
};

std::vector<Run> runs_of_combinations(const TetMesh& mesh, const LowerCells& lower) {
    std::vector<Run> runs;
    const auto add = [&](CombinationId combination) {
        if (runs.empty() || runs.back().combination != combination) runs.push_back({combination, 0});
        ++runs.back().length;
    };
    for (TetMesh::Index c = 0; c < mesh.n_cells(); ++c) add(mesh.combination(CellHandle(c)));
    for (CombinationId combination : lower.combinations) add(combination);
    return runs;
}

/// For each combination whether it has one of the sets.
std::vector<std::uint8_t> combinations_in(const TetMesh& mesh, const std::vector<SetHandle>& sets,
                                          CombinationId n_combinations) {
    std::vector<std::uint8_t> is_in(n_combinations, 0);
    for (CombinationId id = 0; id < n_combinations; ++id)
        for (SetHandle set : mesh.sets_of(id))
            if (std::ranges::find(sets, set) != sets.end()) is_in[id] = 1;
    return is_in;
}

void add_sets(VtuTree& tree, const TetMesh& mesh, const LowerCells& lower) {
    std::vector<std::string> names;  // in the order of the sets
    std::map<std::string, std::vector<SetHandle>> sets_by_name;
    for (TetMesh::Index s = 0; s < mesh.n_sets(); ++s) {
        const std::string& name = mesh.set_info(SetHandle(s)).name;
        auto& sets = sets_by_name[name];
        if (sets.empty()) names.push_back(name);
        sets.emplace_back(s);
    }
    const std::vector<Run> runs = runs_of_combinations(mesh, lower);
    CombinationId n_combinations = 0;
    for (const Run& run : runs) n_combinations = std::max(n_combinations, run.combination + 1);

    std::vector<std::uint8_t> flags(mesh.n_cells() + lower.types.size());
    for (const std::string& name : names) {
        const std::vector<SetHandle>& sets = sets_by_name[name];
        const auto is_in = combinations_in(mesh, sets, n_combinations);
        auto at = flags.begin();
        for (const Run& run : runs) at = std::fill_n(at, run.length, is_in[run.combination]);
        std::string kinds;
        for (SetHandle set : sets)
            kinds += (kinds.empty() ? "" : " ") + std::string(vtk::kind_name(mesh.set_info(set).kind));
        auto array = tree.add<std::uint8_t>("CellData", name, flags);
        array.append_attribute("kinds") = kinds.c_str();
        for (SetHandle set : sets) {
            const SetInfo& info = mesh.set_info(set);
            if (const std::string rule = set_rule_text(mesh, info); !rule.empty())
                array.append_attribute(vtk::rule_attribute(info.kind).c_str()) = rule.c_str();
        }
    }
}

}  // namespace

void write_vtu(const TetMesh& mesh, const Path& path) {
    const SetElements elements = set_elements(mesh);
    LowerCells lower;
    lower.add(elements.faces, vtk::triangle);
    lower.add(elements.edges, vtk::line);
    lower.add(elements.vertices, vtk::vertex);

    VtuTree tree(mesh.n_vertices(), mesh.n_cells() + lower.types.size());
    for (const Field& field :
         fields_of(mesh, {EntityKind::vertex, EntityKind::cell, EntityKind::edge, EntityKind::face}))
        add_field(tree, field, lower);
    for (const MeshValue& value : mesh_values_of(mesh)) add_mesh_value(tree, value);
    add_sets(tree, mesh, lower);
    tree.add<double>(
        "Points", "Points",
        {mesh.points().empty() ? nullptr : mesh.points().data()->data(), 3 * mesh.points().size()}, 3);
    const std::size_t n_places = std::size_t{4} * mesh.n_cells() + lower.connectivity.size();
    if (n_places <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
        add_connectivity<std::int32_t>(tree, mesh, lower);
    } else {
        add_connectivity<std::int64_t>(tree, mesh, lower);
    }
    tree.write(path);
}

}  // namespace maille::volmesh::io
