#include <algorithm>
#include <set>
#include <string>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "volmesh/error.hh"
#include "volmesh/io/abaqus.hh"
#include "volmesh/io/abaqus_text.hh"
#include "volmesh/io/formats.hh"
#include "volmesh/io/output_file.hh"
#include "volmesh/io/rule_text.hh"

namespace maille::volmesh::io {

namespace {

using namespace abaqus;
using Index = TetMesh::Index;

/// Labels that solvers accept, each given out once, whatever the case of its letters.
class Labels {
  public:
    std::string label(const std::string& name) {
        constexpr std::size_t longest = 70;  // 80 are allowed; some are left for a number
        std::string stem = name.substr(0, longest);
        for (char& c : stem)
            if (!is_plain(c)) c = '_';
        if (stem.empty() || !is_letter(stem.front())) stem.insert(0, "S_");
        std::string label = stem;
        for (int i = 2; !taken_.insert(upper(label)).second; ++i) label = fmt::format("{}_{}", stem, i);
        return label;
    }

  private:
    static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
    static bool is_plain(char c) {
        constexpr std::string_view others = "0123456789_-+./";
        return is_letter(c) || others.find(c) != std::string_view::npos;
    }

    std::set<std::string> taken_;
};

/// Numbers in lines of 16, as many as Abaqus allows.
class NumberLines {
  public:
    explicit NumberLines(OutputFile& out) : out_(out) {}
    ~NumberLines() {
        if (n_ > 0) out_ << '\n';
    }
    NumberLines(const NumberLines&) = delete;
    NumberLines& operator=(const NumberLines&) = delete;

    void add(Index index) {
        if (n_ > 0) out_ << (n_ % 16 == 0 ? ",\n" : ", ");
        out_ << std::uint64_t{index} + 1;
        ++n_;
    }

  private:
    OutputFile& out_;
    std::size_t n_ = 0;
};

/// The side of the cell opposite to the vertex that local face f leaves out.
int side_number(const TetMesh& mesh, HalffaceHandle hf) {
    const auto corners = mesh.cell_vertices(TetMesh::incident_cell(hf));
    const auto of_face = mesh.halfface_vertices(hf);
    for (int s = 0; s < 4; ++s)
        if (std::ranges::all_of(sides[s],
                                [&](int k) { return std::ranges::count(of_face, corners[k]) == 1; }))
            return s + 1;
    return 0;  // not reached: three corners of a tetrahedron are one of its sides
}

class AbaqusWriter {
  public:
    AbaqusWriter(const TetMesh& mesh, OutputFile& out) : mesh_(mesh), out_(out) {}

    void write() {
        out_ << "*HEADING\nwritten by maille\n";
        const std::string all_nodes = labels(EntityKind::vertex).label("NALL");
        const std::string all_elements = labels(EntityKind::cell).label("EALL");
        out_ << note_sign << "all " << all_nodes << '\n' << note_sign << "all " << all_elements << '\n';
        write_nodes(all_nodes);
        write_elements(all_elements);
        for (Index s = 0; s < mesh_.n_sets(); ++s) write_set(SetHandle(s));
    }

  private:
    Labels& labels(EntityKind kind) { return labels_[static_cast<std::size_t>(kind)]; }
    void write_nodes(const std::string& label);
    void write_elements(const std::string& label);
    void write_set(SetHandle set);
    void write_members(SetHandle set, const std::string& label);

    const TetMesh& mesh_;
    OutputFile& out_;
    std::array<Labels, 4> labels_;
};

void AbaqusWriter::write_nodes(const std::string& label) {
    out_ << "*NODE, NSET=" << label << '\n';
    for (Index i = 0; i < mesh_.n_vertices(); ++i) {
        out_ << std::uint64_t{i} + 1;
        for (double x : mesh_.points()[i]) out_ << ", " << x;
        out_ << '\n';
    }
}

void AbaqusWriter::write_elements(const std::string& label) {
    out_ << "*ELEMENT, TYPE=C3D4, ELSET=" << label << '\n';
    for (Index i = 0; i < mesh_.n_cells(); ++i) {
        out_ << std::uint64_t{i} + 1;
        for (Index v : mesh_.cell_vertex_indices()[i]) out_ << ", " << std::uint64_t{v} + 1;
        out_ << '\n';
    }
}

void AbaqusWriter::write_set(SetHandle set) {
    const SetInfo& info = mesh_.set_info(set);
    const std::string label = labels(info.kind).label(info.name);
    try {
        out_ << note_sign << "set " << kind_names[static_cast<std::size_t>(info.kind)] << ' ' << label << ' '
             << nlohmann::json(info.name).dump() << '\n';
        if (const std::string rule = set_rule_text(mesh_, info); !rule.empty())
            out_ << note_sign << "rule " << nlohmann::json(rule).dump() << '\n';
    } catch (const nlohmann::json::exception&) {
        throw InputError("the name of a set is no UTF-8 text: rename it");
    }
    if (mesh_.set_size(set) > 0) write_members(set, label);
}

void AbaqusWriter::write_members(SetHandle set, const std::string& label) {
    switch (mesh_.set_info(set).kind) {
        case EntityKind::vertex: {
            out_ << "*NSET, NSET=" << label << '\n';
            NumberLines lines(out_);
            for (const VertexHandle v : mesh_.vertex_members(set)) lines.add(v.idx());
            break;
        }
        case EntityKind::edge:
            for (const auto& [c, e] : mesh_.edge_members(set)) {
                const auto [a, b] = tet::edge_vertices[e];
                out_ << note_sign << "edge " << std::uint64_t{mesh_.cell_vertex(c, a).idx()} + 1 << ' '
                     << std::uint64_t{mesh_.cell_vertex(c, b).idx()} + 1 << '\n';
            }
            break;
        case EntityKind::face:
            out_ << "*SURFACE, NAME=" << label << ", TYPE=ELEMENT\n";
            for (const HalffaceHandle hf : mesh_.face_members(set))
                out_ << std::uint64_t{TetMesh::incident_cell(hf).idx()} + 1 << ", S" << side_number(mesh_, hf)
                     << '\n';
            break;
        case EntityKind::cell: {
            out_ << "*ELSET, ELSET=" << label << '\n';
            NumberLines lines(out_);
            for (const CellHandle c : mesh_.cell_members(set)) lines.add(c.idx());
            break;
        }
    }
}

}  // namespace

void write_abaqus(const TetMesh& mesh, const Path& path) {
    OutputFile out(path);
    AbaqusWriter(mesh, out).write();
    out.commit();
}

}  // namespace maille::volmesh::io
