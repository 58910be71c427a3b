// TetGen's text files: <stem>.node, .ele, .face and .edge, the last two for what is in sets. Each entity has
// one marker, which stands for the combination of sets that it is in; the file <stem>.sets.json has the sets'
// names.
#include <cmath>
#include <optional>

#include <fmt/core.h>

#include "volmesh/io/formats.hh"
#include "volmesh/io/mesh_draft.hh"
#include "volmesh/io/references.hh"
#include "volmesh/io/set_elements.hh"
#include "volmesh/io/text_scanner.hh"

namespace maille::volmesh::io {

namespace {

using Index = TetMesh::Index;

Path beside(const Path& path, const char* extension) {
    return Path(path).replace_extension(extension);
}

class TetgenReader {
  public:
    explicit TetgenReader(const Path& path) : path_(path) {}

    MeshDraft read() {
        read_nodes();
        read_elements(".ele", draft_.cells, EntityKind::cell);
        if (std::filesystem::exists(beside(path_, ".face")))
            read_elements(".face", draft_.faces, EntityKind::face);
        if (std::filesystem::exists(beside(path_, ".edge")))
            read_elements(".edge", draft_.edges, EntityKind::edge);
        references_.make_sets(draft_, path_);
        return std::move(draft_);
    }

  private:
    void read_nodes();
    template <std::size_t N>
    void read_elements(const char* extension, std::vector<std::array<Index, N>>& elements, EntityKind kind);

    Path path_;
    std::int64_t first_number_ = 0;
    MeshDraft draft_;
    ReferenceReader references_;
};

/// A number of the head line, which may be left out.
std::size_t head_number(TextScanner& text, const char* what, std::size_t otherwise) {
    return text.at_end_of_line() ? otherwise : text.integer<std::size_t>(what);
}

/// The marker that ends a line, if it's there. TetGen writes whole numbers, those of regions sometimes as
/// reals.
long long marker(TextScanner& text) {
    if (text.at_end_of_line()) return 0;
    constexpr double limit = 1e15;
    const double value = text.real("a marker");
    if (value != std::floor(value) || std::abs(value) > limit) text.fail("a marker should be a whole number");
    return static_cast<long long>(value);
}

void TetgenReader::read_nodes() {
    const InputFile file(beside(path_, ".node"));
    TextScanner text(file, '#');
    const std::size_t n = text.count("the number of nodes", 8);
    if (head_number(text, "the dimension", 3) != 3) text.fail("the dimension should be 3");
    const std::size_t n_attributes = head_number(text, "the number of attributes", 0);
    const bool has_marker = head_number(text, "0 or 1 for markers", 0) != 0;
    text.line();
    draft_.points.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        const auto number = text.integer<std::int64_t>("the number of a node");
        if (i == 0) first_number_ = number;
        if ((first_number_ != 0 && first_number_ != 1) ||
            number != first_number_ + static_cast<std::int64_t>(i))
            text.fail("nodes should be numbered from 0 or 1 on");
        draft_.points.push_back(text.point());
        for (std::size_t k = 0; k < n_attributes && !text.at_end_of_line(); ++k) text.real("an attribute");
        if (has_marker) references_.add(EntityKind::vertex, marker(text), static_cast<Index>(i));
        text.line();
    }
}

template <std::size_t N>
void TetgenReader::read_elements(const char* extension, std::vector<std::array<Index, N>>& elements,
                                 EntityKind kind) {
    const InputFile file(beside(path_, extension));
    TextScanner text(file, '#');
    const std::size_t n = text.count("the number of elements", 2 * N + 2);
    if (kind == EntityKind::cell && head_number(text, "the number of nodes of a tetrahedron", 4) != 4)
        text.fail("quadratic tetrahedra (of 10 nodes) cannot be read: only linear ones can");
    const bool has_marker = head_number(text, "0 or 1 for markers", 0) != 0;
    text.line();
    elements.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        text.integer<std::int64_t>("the number of an element");
        std::array<Index, N> element{};
        for (Index& vertex : element) {
            const auto number = text.integer<std::int64_t>("a node") - first_number_;
            if (number < 0 || number >= static_cast<std::int64_t>(draft_.points.size()))
                text.fail("an element has a node that there is not");
            vertex = static_cast<Index>(number);
        }
        if (has_marker) references_.add(kind, marker(text), static_cast<Index>(i));
        elements.push_back(element);
        text.line();
    }
}

template <class Vertices>
void write_line(OutputFile& out, std::size_t number, const Vertices& vertices, int marker) {
    out << number;
    for (const auto& v : vertices) out << ' ' << v;
    out << ' ' << marker << '\n';
}

template <std::size_t N>
void write_elements(OutputFile& out, const std::vector<SetElement<N>>& elements, EntityKind kind,
                    ReferenceWriter& references) {
    out << elements.size() << " 1\n";
    for (std::size_t i = 0; i < elements.size(); ++i)
        write_line(out, i, elements[i].vertices, references.reference(kind, elements[i].combination));
}

}  // namespace

TetMesh read_tetgen(const Path& path) {
    return assemble(TetgenReader(path).read(), path);
}

void write_tetgen(const TetMesh& mesh, const Path& path) {
    OutputFile nodes(beside(path, ".node"));
    OutputFile cells(beside(path, ".ele"));
    OutputFile faces(beside(path, ".face"));
    OutputFile edges(beside(path, ".edge"));
    ReferenceWriter references(mesh, path);

    nodes << mesh.n_vertices() << " 3 0 1\n";
    for (Index i = 0; i < mesh.n_vertices(); ++i)
        write_line(nodes, i, mesh.points()[i],
                   references.reference(EntityKind::vertex, mesh.combination(VertexHandle(i))));
    cells << mesh.n_cells() << " 4 1\n";
    for (Index i = 0; i < mesh.n_cells(); ++i)
        write_line(cells, i, mesh.cell_vertex_indices()[i],
                   references.reference(EntityKind::cell, mesh.combination(CellHandle(i))));
    const SetElements elements = set_elements(mesh);
    write_elements(faces, elements.faces, EntityKind::face, references);
    write_elements(edges, elements.edges, EntityKind::edge, references);

    references.commit();
    for (OutputFile* file : {&nodes, &cells, &faces, &edges}) file->commit();
}

}  // namespace maille::volmesh::io
