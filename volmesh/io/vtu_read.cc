#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>

#include <fmt/core.h>
#include <pugixml.hpp>

#include "volmesh/error.hh"
#include "volmesh/io/formats.hh"
#include "volmesh/io/input_file.hh"
#include "volmesh/io/mesh_draft.hh"
#include "volmesh/io/vtk_arrays.hh"
#include "volmesh/io/vtk_names.hh"

namespace maille::volmesh::io {

namespace {

using Index = TetMesh::Index;

/// The file's tree, and where its appended arrays are.
class VtuFile {
  public:
    explicit VtuFile(const Path& path);

    pugi::xml_node piece() const { return piece_; }
    /// An attribute of the piece, a count.
    std::size_t count(const char* attribute) const;

    struct Array {
        vtk::Numbers numbers;
        std::size_t n_components;
    };
    Array array(pugi::xml_node node) const;

    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(file_.name() + ": " + message);
    }
    /// With the byte at which the node stands in the file.
    [[noreturn]] void fail_at(pugi::xml_node node, const std::string& message) const {
        const auto offset = std::max<std::ptrdiff_t>(node.offset_debug(), 0);
        file_.fail_at_byte(file_.text().data() + offset, message);
    }

  private:
    /// Parses all but the appended arrays, which are not XML.
    void parse();
    void find_appended(std::size_t tag);
    vtk::Bytes decoded_bytes(pugi::xml_node node) const;

    InputFile file_;
    pugi::xml_document document_;
    pugi::xml_node piece_;
    vtk::Encoding encoding_;
    std::string_view appended_;
    bool is_appended_base64_ = false;
};

VtuFile::VtuFile(const Path& path) : file_(path) {
    parse();
    const auto root = document_.child("VTKFile");
    if (std::string_view(root.attribute("type").value()) != "UnstructuredGrid")
        fail("is not an unstructured grid of VTK's");
    if (std::string_view(root.attribute("byte_order").as_string("LittleEndian")) != "LittleEndian")
        fail("was written by a machine of the other byte order");
    const std::string_view compressor = root.attribute("compressor").value();
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
        fail(fmt::format("is compressed by {}, which cannot be read: choose zlib or none", compressor));
    const std::string_view head_type = root.attribute("header_type").as_string("UInt32");
    if (head_type != "UInt32" && head_type != "UInt64")
        fail(fmt::format("has an unknown header_type, '{}'", head_type));
    encoding_ = {!compressor.empty(), head_type == "UInt64"};
    const auto grid = root.child("UnstructuredGrid");
    piece_ = grid.child("Piece");
    if (!piece_) fail("has no piece of a mesh");
    if (piece_.next_sibling("Piece")) fail("is in several pieces, which cannot be read: merge them first");
}

void VtuFile::parse() {
    const std::string_view text = file_.text();
    const std::size_t appended = text.find("<AppendedData");
    std::string head(text.substr(0, appended));
    if (appended != std::string_view::npos) {
        find_appended(appended);
        head += "</VTKFile>";
    }
    const auto result = document_.load_buffer(head.data(), head.size());
    if (!result)
        file_.fail_at_byte(text.data() + result.offset, fmt::format("is no XML: {}", result.description()));
}

void VtuFile::find_appended(std::size_t tag) {
    const std::string_view text = file_.text();
    const std::size_t end_of_tag = text.find('>', tag);
    const std::size_t begin = text.find('_', end_of_tag);
    if (end_of_tag == std::string_view::npos || begin == std::string_view::npos)
        fail("ends within its appended data");
    is_appended_base64_ = text.substr(tag, end_of_tag - tag).find("base64") != std::string_view::npos;
    appended_ = text.substr(begin + 1);
}

std::size_t VtuFile::count(const char* attribute) const {
    const std::string_view text = piece_.attribute(attribute).value();
    std::size_t n = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
    if (error != std::errc{} || end != text.data() + text.size())
        fail_at(piece_, fmt::format("{} is not a number", attribute));
    return n;
}

vtk::Bytes VtuFile::decoded_bytes(pugi::xml_node node) const {
    if (std::string_view(node.attribute("format").value()) != "appended") {
        std::string_view text = node.child_value();
        text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
        return vtk::decoded(text, true, encoding_);
    }
    const auto offset = node.attribute("offset").as_ullong(appended_.size());
    if (offset >= appended_.size()) throw InputError("its offset is beyond the appended data");
    return vtk::decoded(appended_.substr(offset), is_appended_base64_, encoding_);
}

VtuFile::Array VtuFile::array(pugi::xml_node node) const {
    Array array{{node.attribute("type").value()}, 1};
    array.n_components = std::max(1U, node.attribute("NumberOfComponents").as_uint(1));
    array.numbers.is_text = std::string_view(node.attribute("format").as_string("ascii")) == "ascii";
    if (array.numbers.is_text) {
        array.numbers.text = node.child_value();
    } else {
        array.numbers.bytes = decoded_bytes(node);
    }
    return array;
}

/// Reads the mesh out of the file.
class VtuReader {
  public:
    explicit VtuReader(const Path& path)
        : file_(path), n_points_(file_.count("NumberOfPoints")), n_cells_(file_.count("NumberOfCells")) {}

    MeshDraft read() {
        read_points();
        read_cells();
        for (pugi::xml_node array : file_.piece().child("PointData").children("DataArray"))
            read_point_data(array);
        for (pugi::xml_node array : file_.piece().child("CellData").children("DataArray"))
            read_cell_data(array);
        for (pugi::xml_node array : file_.piece().parent().child("FieldData").children("DataArray"))
            read_field_data(array);
        return std::move(draft_);
    }

  private:
    /// Calls the action on the array, and names the array in what goes wrong.
    template <class Action>
    void with_array(pugi::xml_node node, const Action& action) {
        try {
            action(file_.array(node));
        } catch (const InputError& error) {
            file_.fail_at(node, fmt::format("array '{}': {}", node.attribute("Name").value(), error.what()));
        }
    }

    /// Calls the action on the array of that name among those of the cells.
    template <class Action>
    void with_cell_array(const char* name, const Action& action);
    void read_points();
    void read_cells();
    void add_cell(std::uint32_t type, std::span<const Index> vertices);
    void read_point_data(pugi::xml_node node);
    void read_cell_data(pugi::xml_node node);
    void read_field_data(pugi::xml_node node);
    void read_mesh_value(const std::string& name, const VtuFile::Array& array);
    bool read_set(pugi::xml_node node, const VtuFile::Array& array);
    void require_value_each(std::size_t n) const;
    void add_members(const std::string& name, EntityKind kind, const std::vector<Index>& members);
    void read_groups(const std::vector<std::int64_t>& groups);
    void add_field(pugi::xml_node node, EntityKind kind, const VtuFile::Array& array,
                   std::vector<double> values);

    VtuFile file_;
    std::size_t n_points_, n_cells_;
    MeshDraft draft_;
    /// By cell of the file: its kind, and its number in the draft's list of that kind.
    std::vector<std::pair<EntityKind, Index>> places_;
};

template <class Action>
void VtuReader::with_cell_array(const char* name, const Action& action) {
    const auto node = file_.piece().child("Cells").find_child_by_attribute("DataArray", "Name", name);
    if (!node) file_.fail(fmt::format("has no array '{}'", name));
    with_array(node, action);
}

void VtuReader::read_points() {
    const auto node = file_.piece().child("Points").child("DataArray");
    if (!node) file_.fail("has no points");
    with_array(node, [&](const VtuFile::Array& array) {
        const std::vector<double> values = array.numbers.as_reals();
        if (array.n_components != 3 || values.size() != 3 * n_points_ || values.size() / 3 != n_points_)
            throw InputError(fmt::format("{} coordinates for {} points", values.size(), n_points_));
        if (!std::ranges::all_of(values, [](double x) { return std::isfinite(x); }))
            throw InputError("a coordinate is not a finite number");
        draft_.points.reserve(n_points_);
        for (std::size_t i = 0; i < values.size(); i += 3)
            draft_.points.emplace_back(values[i], values[i + 1], values[i + 2]);
    });
}

void VtuReader::read_cells() {
    if (n_cells_ == 0) return;
    std::vector<Index> connectivity, types;
    std::vector<std::int64_t> offsets;
    const auto require_all = [&](std::size_t n) {
        if (n < n_cells_) throw InputError(fmt::format("has {} values instead of {}", n, n_cells_));
    };
    with_cell_array("types", [&](const VtuFile::Array& array) {
        types = array.numbers.as_indices();
        require_all(types.size());
    });
    with_cell_array("offsets", [&](const VtuFile::Array& array) {
        offsets = array.numbers.as_integers();
        require_all(offsets.size());
    });
    with_cell_array("connectivity",
                    [&](const VtuFile::Array& array) { connectivity = array.numbers.as_indices(); });
    places_.reserve(n_cells_);
    draft_.cells.reserve(std::min(n_cells_, connectivity.size() / 4));
    std::int64_t begin = 0;
    for (std::size_t i = 0; i < n_cells_; ++i) {
        if (offsets[i] < begin || offsets[i] > static_cast<std::int64_t>(connectivity.size()))
            file_.fail(fmt::format("the offset of cell {} is out of range", i));
        add_cell(types[i], std::span(connectivity).subspan(begin, offsets[i] - begin));
        begin = offsets[i];
    }
}

/// What a type of cell is called, for messages.
const char* name_of_type(std::uint32_t type) {
    switch (type) {
        case 4:
            return "polyline";
        case 7:
            return "polygon";
        case 9:
            return "quadrangle";
        case 11:
            return "voxel";
        case 12:
            return "hexahedron";
        case 13:
            return "wedge";
        case 14:
            return "pyramid";
        case 21:
            return "quadratic line";
        case 22:
            return "quadratic triangle";
        case 24:
            return "quadratic tetrahedron";
        case 25:
            return "quadratic hexahedron";
        case 42:
            return "polyhedron";
        case 71:
            return "Lagrange tetrahedron";
        default:
            return "unknown";
    }
}

void VtuReader::add_cell(std::uint32_t type, std::span<const Index> vertices) {
    const int n = type <= 255 ? vtk::n_vertices(static_cast<std::uint8_t>(type)) : 0;
    if (n == 0)
        file_.fail(fmt::format(
            "cell {} is of type {} (VTK's number {}), which cannot be read: only linear tetrahedra and "
            "their triangles, lines and vertices can",
            places_.size(), name_of_type(type), type));
    if (vertices.size() != static_cast<std::size_t>(n))
        file_.fail(fmt::format("cell {} has {} vertices instead of {}", places_.size(), vertices.size(), n));
    std::array<Index, 4> v{};
    for (int k = 0; k < n; ++k) {
        if (vertices[k] >= n_points_)
            file_.fail(fmt::format("cell {} has {}, but there are {} vertices", places_.size(),
                                   vertices[k] == TetMesh::none ? "a negative or too large vertex"
                                                                : fmt::format("vertex {}", vertices[k]),
                                   n_points_));
        v[k] = vertices[k];
    }
    const auto place = [&](EntityKind kind, std::size_t i) {
        places_.emplace_back(kind, static_cast<Index>(i));
    };
    switch (n) {
        case 1:
            place(EntityKind::vertex, v[0]);
            break;
        case 2:
            place(EntityKind::edge, draft_.edges.size());
            draft_.edges.push_back({v[0], v[1]});
            break;
        case 3:
            place(EntityKind::face, draft_.faces.size());
            draft_.faces.push_back({v[0], v[1], v[2]});
            break;
        default:
            place(EntityKind::cell, draft_.cells.size());
            draft_.cells.push_back(v);
    }
}

void VtuReader::add_field(pugi::xml_node node, EntityKind kind, const VtuFile::Array& array,
                          std::vector<double> values) {
    FieldType type = FieldType::real64;
    if (array.numbers.type == "Float32") type = FieldType::real32;
    if (!array.numbers.is_real()) type = smallest_integer_type(values);
    const std::size_t n_before = draft_.fields.size();
    append_field(draft_.fields, node.attribute("Name").value(), kind, type, array.n_components,
                 std::move(values));
    // Ours, which are never taken apart, may tell more.
    if (draft_.fields.size() != n_before + 1) return;
    Field& field = draft_.fields.back();
    if (const auto rule = node.attribute("rule")) field.rule = parse_property_rule(rule.value());
    if (const auto text = node.attribute("default"))
        field.default_value = vtk::Numbers{"Float64", true, text.value(), {}}.as_reals();
}

void VtuReader::read_point_data(pugi::xml_node node) {
    with_array(node, [&](const VtuFile::Array& array) {
        std::vector<double> values = array.numbers.as_reals();
        if (values.size() != n_points_ * array.n_components)
            throw InputError(fmt::format("{} values for {} points", values.size(), n_points_));
        add_field(node, EntityKind::vertex, array, std::move(values));
    });
}

void VtuReader::read_cell_data(pugi::xml_node node) {
    const std::string name = node.attribute("Name").value();
    if (name == "vtkGhostType") return;
    with_array(node, [&](const VtuFile::Array& array) {
        if (array.n_components == 1 && read_set(node, array)) return;
        const std::vector<double> all = array.numbers.as_reals();
        const std::size_t n = array.n_components;
        std::vector<double> values;
        if (all.size() != n_cells_ * n)
            throw InputError(fmt::format("{} values for {} cells", all.size(), n_cells_));
        values.reserve(all.size());
        for (std::size_t i = 0; i < n_cells_; ++i)
            if (places_[i].first == EntityKind::cell)
                values.insert(values.end(), &all[i * n], &all[i * n] + n);
        add_field(node, EntityKind::cell, array, std::move(values));
    });
}

/// Ours only: others' say nothing of the mesh's parts.
void VtuReader::read_field_data(pugi::xml_node node) {
    const std::string_view of = node.attribute("of").value();
    if (of.empty()) return;
    with_array(node, [&](const VtuFile::Array& array) {
        const std::string name = node.attribute("Name").value();
        if (of == "mesh text") {
            const auto bytes = array.numbers.as_integers();
            draft_.mesh_values.push_back({name, std::string(bytes.begin(), bytes.end())});
        } else if (of == "mesh") {
            read_mesh_value(name, array);
        } else if (of == vtk::kind_name(EntityKind::edge)) {
            add_field(node, EntityKind::edge, array, array.numbers.as_reals());
        } else if (of == vtk::kind_name(EntityKind::face)) {
            add_field(node, EntityKind::face, array, array.numbers.as_reals());
        } else {
            throw InputError(fmt::format("there is nothing of which '{}' could be", of));
        }
    });
}

void VtuReader::read_mesh_value(const std::string& name, const VtuFile::Array& array) {
    const std::vector<double> values = array.numbers.as_reals();
    const std::string& type = array.numbers.type;
    if (values.size() == 3) {
        draft_.mesh_values.push_back({name, Eigen::Vector3d(values[0], values[1], values[2])});
    } else if (values.size() != 1) {
        throw InputError(fmt::format("{} numbers for one mesh", values.size()));
    } else if (type == "Float32") {
        draft_.mesh_values.push_back({name, static_cast<float>(values[0])});
    } else if (!array.numbers.is_real() && smallest_integer_type(values) == FieldType::int32) {
        draft_.mesh_values.push_back({name, static_cast<std::int32_t>(values[0])});
    } else {
        draft_.mesh_values.push_back({name, values[0]});
    }
}

void VtuReader::require_value_each(std::size_t n) const {
    if (n != n_cells_) throw InputError(fmt::format("{} values for {} cells", n, n_cells_));
}

/// Calls the action for the place of each flag that is not 0. Most sets have few members.
template <class Action>
void for_each_flag(std::span<const std::uint8_t> flags, const Action& action) {
    constexpr std::size_t step = 64;
    for (std::size_t begin = 0; begin < flags.size(); begin += step) {
        const std::size_t end = std::min(begin + step, flags.size());
        std::uint8_t any = 0;
        for (std::size_t i = begin; i < end; ++i) any |= flags[i];
        if (any == 0) continue;
        for (std::size_t i = begin; i < end; ++i)
            if (flags[i] != 0) action(i);
    }
}

/// Whether the array tells sets: ours by its attribute, others' if it has only 0 and 1 in bytes; or meshio's
/// groups.
bool VtuReader::read_set(pugi::xml_node node, const VtuFile::Array& array) {
    const std::string name = node.attribute("Name").value();
    const auto kinds = node.attribute("kinds");
    const bool is_of_groups = name == "gmsh:physical";
    if (!kinds && !is_of_groups && array.numbers.type != "UInt8" && array.numbers.type != "Int8")
        return false;
    if (!kinds) {
        const std::vector<std::int64_t> values = array.numbers.as_integers();
        require_value_each(values.size());
        if (is_of_groups) {
            read_groups(values);
            return true;
        }
        if (!std::ranges::all_of(values, [](std::int64_t value) { return value == 0 || value == 1; }))
            return false;
        if (std::ranges::find(values, 1) == values.end()) draft_.set(name, EntityKind::cell);
    }
    std::istringstream words(kinds.as_string(""));
    for (std::string word; words >> word;) {
        const auto kind = std::ranges::find(vtk::kind_names, word);
        if (kind == vtk::kind_names.end())
            throw InputError(fmt::format("there is no kind of set '{}'", word));
        const auto kind_of_set = static_cast<EntityKind>(kind - vtk::kind_names.begin());
        MeshDraft::Set& set = draft_.set(name, kind_of_set);
        if (const auto rule = node.attribute(vtk::rule_attribute(kind_of_set).c_str()))
            set.rule = parse_set_rule(rule.value(), kind_of_set);
    }
    std::vector<std::uint8_t> converted;
    std::span flags(reinterpret_cast<const std::uint8_t*>(array.numbers.bytes.data()),
                    array.numbers.bytes.size());
    if (array.numbers.type != "UInt8" || array.numbers.is_text) flags = converted = array.numbers.as_flags();
    require_value_each(flags.size());
    std::array<std::vector<Index>, 4> members;
    for_each_flag(flags, [&](std::size_t i) {
        members[static_cast<std::size_t>(places_[i].first)].push_back(places_[i].second);
    });
    for (std::size_t kind = 0; kind < 4; ++kind)
        add_members(name, static_cast<EntityKind>(kind), members[kind]);
    return true;
}

void VtuReader::read_groups(const std::vector<std::int64_t>& groups) {
    std::map<std::pair<EntityKind, std::int64_t>, std::vector<Index>> members;
    for (std::size_t i = 0; i < n_cells_; ++i)
        if (groups[i] != 0) members[{places_[i].first, groups[i]}].push_back(places_[i].second);
    for (const auto& [group, of_group] : members)
        add_members(group_name(group.second), group.first, of_group);
}

void VtuReader::add_members(const std::string& name, EntityKind kind, const std::vector<Index>& members) {
    if (members.empty()) return;
    auto& of_set = draft_.set(name, kind).members;
    of_set.insert(of_set.end(), members.begin(), members.end());
}

}  // namespace

TetMesh read_vtu(const Path& path) {
    return assemble(VtuReader(path).read(), path);
}

}  // namespace maille::volmesh::io
