// Exodus II, through its library. Cells of the same sets are one block; sets of cells are element sets too,
// as a cell may be in several; of faces side sets, of vertices node sets. Edges in sets are an edge block
// with its edge sets. The map of elements tells where cells were in the mesh, lines of information the rules
// of sets.
#if __has_include(<exodusII.h>)

#include <algorithm>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>

#include "volmesh/error.hh"
#include "volmesh/io/combination_numbers.hh"
#include "volmesh/io/exodus_library.hh"
#include "volmesh/io/formats.hh"
#include "volmesh/io/output_file.hh"
#include "volmesh/io/rule_text.hh"
#include "volmesh/io/set_elements.hh"
#include "volmesh/io/vtk_names.hh"

namespace maille::volmesh::io {

namespace {

using Index = TetMesh::Index;
using Numbers = std::vector<std::int64_t>;

constexpr std::size_t longest_name = 255;

class ExodusWriter {
  public:
    ExodusWriter(const TetMesh& mesh, const Path& path);

    void write();

  private:
    void check(int status) const {
        if (status >= 0) return;
        throw InputError(fmt::format("{}: cannot be written: Exodus' library gave error {}",
                                     place_.path().string(), status));
    }
    void sort_cells_into_blocks();
    void write_sizes();
    void write_blocks();
    void write_sets();
    void write_set(SetHandle set);
    std::vector<std::string> information() const;
    std::int64_t number_of(SetHandle set) const;
    void put_set(ex_entity_type type, SetHandle set, const Numbers& entries, const Numbers& extras);
    void put_name(ex_entity_type type, std::int64_t id, const std::string& name);
    std::size_t n_sets(EntityKind kind) const;
    std::string block_name(CombinationId combination) const;

    const TetMesh& mesh_;
    PlaceBeside place_;
    const ExodusLibrary& library_;
    ExodusFile file_;
    CombinationNumbers numbers_;
    std::vector<std::vector<CellHandle>> blocks_;
    Numbers element_of_;  ///< by cell, from 1
    SetElements elements_;
};

ExodusWriter::ExodusWriter(const TetMesh& mesh, const Path& path)
    : mesh_(mesh), place_(path), library_(exodus_library()), elements_(set_elements(mesh)) {
    for (Index s = 0; s < mesh.n_sets(); ++s)
        if (mesh.set_info(SetHandle(s)).name.size() > longest_name)
            throw InputError(
                fmt::format("{}: the name '{}' is longer than the {} bytes that Exodus allows: rename "
                            "the set",
                            path.string(), mesh.set_info(SetHandle(s)).name, longest_name));
    int word = sizeof(double);
    int stored_word = sizeof(double);
    file_ = ExodusFile(library_.create(place_.temporary().c_str(), EX_CLOBBER | EX_LARGE_MODEL, &word,
                                       &stored_word, EX_API_VERS_NODOT));
    check(file_);
    library_.set_int64_status(file_, EX_ALL_INT64_API);
    library_.set_max_name_length(file_, static_cast<int>(longest_name));
}

void ExodusWriter::sort_cells_into_blocks() {
    for (const CellHandle c : mesh_.cells()) {
        const auto block = static_cast<std::size_t>(numbers_.number(mesh_.combination(c)));
        if (block > blocks_.size()) blocks_.emplace_back();
        blocks_[block - 1].push_back(c);
    }
    element_of_.resize(mesh_.n_cells());
    std::int64_t element = 0;
    for (const auto& block : blocks_)
        for (CellHandle c : block) element_of_[c.idx()] = ++element;
}

std::size_t ExodusWriter::n_sets(EntityKind kind) const {
    std::size_t n = 0;
    for (Index s = 0; s < mesh_.n_sets(); ++s) n += mesh_.set_info(SetHandle(s)).kind == kind;
    return n;
}

void ExodusWriter::write_sizes() {
    const auto count = [](std::size_t n) { return static_cast<std::int64_t>(n); };
    ex_init_params sizes{};
    std::strncpy(sizes.title, "maille", sizeof sizes.title - 1);
    sizes.num_dim = 3;
    sizes.num_nodes = mesh_.n_vertices();
    sizes.num_elem = mesh_.n_cells();
    sizes.num_elem_blk = count(blocks_.size());
    sizes.num_edge = count(elements_.edges.size());
    sizes.num_edge_blk = elements_.edges.empty() ? 0 : 1;
    sizes.num_node_sets = count(n_sets(EntityKind::vertex));
    sizes.num_edge_sets = count(n_sets(EntityKind::edge));
    sizes.num_side_sets = count(n_sets(EntityKind::face));
    sizes.num_elem_sets = count(n_sets(EntityKind::cell));
    check(library_.put_init(file_, &sizes));
}

/// For those who look at blocks only.
std::string ExodusWriter::block_name(CombinationId combination) const {
    std::string name;
    for (SetHandle set : mesh_.sets_of(combination))
        name += (name.empty() ? "" : " + ") + mesh_.set_info(set).name;
    return name.empty() ? "(no set)" : name.substr(0, longest_name);
}

void ExodusWriter::put_name(ex_entity_type type, std::int64_t id, const std::string& name) {
    check(library_.put_name(file_, type, id, name.c_str()));
}

void ExodusWriter::write_blocks() {
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const auto id = static_cast<std::int64_t>(b) + 1;
        check(library_.put_block(file_, EX_ELEM_BLOCK, id, "TETRA4",
                                 static_cast<std::int64_t>(blocks_[b].size()), 4, 0, 0, 0));
        put_name(EX_ELEM_BLOCK, id, block_name(numbers_.ids()[b]));
        Numbers nodes;
        for (CellHandle c : blocks_[b])
            for (Index v : mesh_.cell_vertex_indices()[c.idx()]) nodes.push_back(std::int64_t{v} + 1);
        check(library_.put_conn(file_, EX_ELEM_BLOCK, id, nodes.data(), nullptr, nullptr));
    }
    if (elements_.edges.empty()) return;
    check(library_.put_block(file_, EX_EDGE_BLOCK, 1, "EDGE2",
                             static_cast<std::int64_t>(elements_.edges.size()), 2, 0, 0, 0));
    Numbers nodes;
    for (const auto& edge : elements_.edges)
        for (Index v : edge.vertices) nodes.push_back(std::int64_t{v} + 1);
    check(library_.put_conn(file_, EX_EDGE_BLOCK, 1, nodes.data(), nullptr, nullptr));
}

/// From 1 on among the sets of its kind.
std::int64_t ExodusWriter::number_of(SetHandle set) const {
    std::int64_t number = 1;
    for (Index s = 0; s < set.idx(); ++s)
        number += mesh_.set_info(SetHandle(s)).kind == mesh_.set_info(set).kind;
    return number;
}

/// Our mark, and the rules of sets in pieces that fit in a line.
std::vector<std::string> ExodusWriter::information() const {
    constexpr std::size_t longest_piece = 40;
    std::vector<std::string> lines{exodus_mark};
    for (const EntityKind kind : {EntityKind::cell, EntityKind::face, EntityKind::edge, EntityKind::vertex})
        for (Index s = 0; s < mesh_.n_sets(); ++s) {
            const SetInfo& set = mesh_.set_info(SetHandle(s));
            if (set.kind != kind) continue;
            const std::string rule = set_rule_text(mesh_, set);
            for (std::size_t at = 0; at < rule.size(); at += longest_piece)
                lines.push_back(fmt::format("{}{} {} {}|", exodus_rule_mark, vtk::kind_name(kind),
                                            number_of(SetHandle(s)), rule.substr(at, longest_piece)));
        }
    return lines;
}

void ExodusWriter::put_set(ex_entity_type type, SetHandle set, const Numbers& entries,
                           const Numbers& extras) {
    const std::int64_t id = number_of(set);
    check(library_.put_set_param(file_, type, id, static_cast<std::int64_t>(entries.size()), 0));
    if (!entries.empty())
        check(library_.put_set(file_, type, id, entries.data(), extras.empty() ? nullptr : extras.data()));
    put_name(type, id, mesh_.set_info(set).name);
}

/// Kind by kind, as a reader comes to them, so that what is read and written again is the same.
void ExodusWriter::write_sets() {
    for (const EntityKind kind : {EntityKind::cell, EntityKind::face, EntityKind::edge, EntityKind::vertex})
        for (Index s = 0; s < mesh_.n_sets(); ++s)
            if (mesh_.set_info(SetHandle(s)).kind == kind) write_set(SetHandle(s));
}

void ExodusWriter::write_set(SetHandle set) {
    Numbers entries;
    Numbers extras;
    switch (mesh_.set_info(set).kind) {
        case EntityKind::vertex:
            for (VertexHandle v : mesh_.vertex_members(set)) entries.push_back(std::int64_t{v.idx()} + 1);
            return put_set(EX_NODE_SET, set, entries, {});
        case EntityKind::edge:
            for (std::size_t e = 0; e < elements_.edges.size(); ++e)
                if (std::ranges::count(mesh_.sets_of(elements_.edges[e].combination), set) > 0)
                    entries.push_back(static_cast<std::int64_t>(e) + 1);
            extras.assign(entries.size(), 1);  // their orientation
            return put_set(EX_EDGE_SET, set, entries, extras);
        case EntityKind::face:
            for (HalffaceHandle hf : mesh_.face_members(set)) {
                entries.push_back(element_of_[TetMesh::incident_cell(hf).idx()]);
                extras.push_back(exodus_side[TetMesh::local_face(hf)]);
            }
            return put_set(EX_SIDE_SET, set, entries, extras);
        case EntityKind::cell:
            for (CellHandle c : mesh_.cell_members(set)) entries.push_back(element_of_[c.idx()]);
            return put_set(EX_ELEM_SET, set, entries, {});
    }
}

void ExodusWriter::write() {
    sort_cells_into_blocks();
    write_sizes();
    std::vector<std::string> lines = information();
    std::vector<char*> places;
    for (std::string& line : lines) places.push_back(line.data());
    check(library_.put_info(file_, static_cast<int>(lines.size()), places.data()));
    std::array<std::string, 3> axes{"x", "y", "z"};
    char* names[] = {axes[0].data(), axes[1].data(), axes[2].data()};
    check(library_.put_coord_names(file_, names));
    std::array<std::vector<double>, 3> coordinates;
    for (const Point& p : mesh_.points())
        for (int k = 0; k < 3; ++k) coordinates[k].push_back(p[k]);
    if (mesh_.n_vertices() > 0)
        check(library_.put_coord(file_, coordinates[0].data(), coordinates[1].data(), coordinates[2].data()));
    write_blocks();
    Numbers numbers(mesh_.n_cells());
    for (Index c = 0; c < mesh_.n_cells(); ++c) numbers[element_of_[c] - 1] = std::int64_t{c} + 1;
    if (!numbers.empty()) check(library_.put_id_map(file_, EX_ELEM_MAP, numbers.data()));
    write_sets();
    check(file_.close());
    place_.commit();
}

}  // namespace

void write_exodus(const TetMesh& mesh, const Path& path) {
    ExodusWriter(mesh, path).write();
}

}  // namespace maille::volmesh::io

#endif
