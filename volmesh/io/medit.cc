// Medit's text format. Each entity has one reference, which stands for the combination of sets that it is in;
// the file <stem>.sets.json has the sets' names.
#include <algorithm>
#include <cctype>
#include <map>

#include <fmt/core.h>

#include "volmesh/io/formats.hh"
#include "volmesh/io/mesh_draft.hh"
#include "volmesh/io/references.hh"
#include "volmesh/io/set_elements.hh"
#include "volmesh/io/text_scanner.hh"

namespace maille::volmesh::io {

namespace {

using Index = TetMesh::Index;

class MeditReader {
  public:
    explicit MeditReader(const Path& path) : path_(path), file_(path), text_(file_, '#') {}

    MeshDraft read();

  private:
    bool has_read(std::string_view keyword);
    void read_vertices();
    template <std::size_t N>
    void read_elements(std::vector<std::array<Index, N>>& elements, EntityKind kind);
    void skip_section();

    Path path_;
    InputFile file_;
    TextScanner text_;
    MeshDraft draft_;
    ReferenceReader references_;
};

MeshDraft MeditReader::read() {
    if (text_.word("MeshVersionFormatted") != "MeshVersionFormatted")
        text_.fail("a Medit file begins with MeshVersionFormatted");
    text_.integer<int>("a version");
    while (!text_.at_end()) {
        const std::string_view keyword = text_.word("a keyword");
        if (keyword == "End") break;
        if (!std::isalpha(static_cast<unsigned char>(keyword.front())))
            text_.fail(fmt::format("'{}' stands where a keyword should be", keyword.substr(0, 40)));
        if (!has_read(keyword)) skip_section();
    }
    references_.make_sets(draft_, path_);
    return std::move(draft_);
}

bool MeditReader::has_read(std::string_view keyword) {
    if (keyword == "Dimension") {
        if (text_.integer<int>("the dimension") != 3) text_.fail("the dimension should be 3");
    } else if (keyword == "Vertices") {
        read_vertices();
    } else if (keyword == "Edges") {
        read_elements(draft_.edges, EntityKind::edge);
    } else if (keyword == "Triangles") {
        read_elements(draft_.faces, EntityKind::face);
    } else if (keyword == "Tetrahedra") {
        read_elements(draft_.cells, EntityKind::cell);
    } else {
        for (const char* other : {"Quadrilaterals", "Hexahedra", "Hexaedra", "Prisms", "Pyramids", "EdgesP",
                                  "TrianglesP", "TetrahedraP"})
            if (keyword.starts_with(other) && text_.integer<std::size_t>("a number of elements") > 0)
                text_.fail(fmt::format("{} cannot be read: only linear tetrahedra, triangles and edges can",
                                       keyword));
        return false;
    }
    return true;
}

void MeditReader::read_vertices() {
    const std::size_t n = text_.count("the number of vertices", 8);
    draft_.points.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        draft_.points.push_back(text_.point());
        references_.add(EntityKind::vertex, text_.integer<long long>("a reference"), static_cast<Index>(i));
    }
}

template <std::size_t N>
void MeditReader::read_elements(std::vector<std::array<Index, N>>& elements, EntityKind kind) {
    const std::size_t n = text_.count("the number of elements", 2 * N + 2);
    elements.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        std::array<Index, N> element{};
        for (Index& vertex : element) {
            vertex = text_.integer<Index>("a vertex") - 1;
            if (vertex >= draft_.points.size()) text_.fail("an element has a vertex that there is not");
        }
        references_.add(kind, text_.integer<long long>("a reference"), static_cast<Index>(elements.size()));
        elements.push_back(element);
    }
}

/// To the next keyword: what is in between are numbers.
void MeditReader::skip_section() {
    while (!text_.at_end() && !std::isalpha(static_cast<unsigned char>(text_.rest().front())))
        text_.word("a number");
}

template <std::size_t N>
void write_elements(OutputFile& out, const char* keyword, const std::vector<SetElement<N>>& elements,
                    EntityKind kind, ReferenceWriter& references) {
    if (elements.empty()) return;
    out << keyword << '\n' << elements.size() << '\n';
    for (const SetElement<N>& element : elements) {
        for (Index v : element.vertices) out << std::uint64_t{v} + 1 << ' ';
        out << references.reference(kind, element.combination) << '\n';
    }
}

}  // namespace

TetMesh read_medit(const Path& path) {
    return assemble(MeditReader(path).read(), path);
}

void write_medit(const TetMesh& mesh, const Path& path) {
    OutputFile out(path);
    ReferenceWriter references(mesh, path);
    out << "MeshVersionFormatted 2\nDimension 3\nVertices\n" << mesh.n_vertices() << '\n';
    for (Index i = 0; i < mesh.n_vertices(); ++i) {
        for (double x : mesh.points()[i]) out << x << ' ';
        out << references.reference(EntityKind::vertex, mesh.combination(VertexHandle(i))) << '\n';
    }
    const SetElements elements = set_elements(mesh);
    write_elements(out, "Edges", elements.edges, EntityKind::edge, references);
    write_elements(out, "Triangles", elements.faces, EntityKind::face, references);
    out << "Tetrahedra\n" << mesh.n_cells() << '\n';
    for (Index i = 0; i < mesh.n_cells(); ++i) {
        for (Index v : mesh.cell_vertex_indices()[i]) out << std::uint64_t{v} + 1 << ' ';
        out << references.reference(EntityKind::cell, mesh.combination(CellHandle(i))) << '\n';
    }
    out << "End\n";
    references.commit();
    out.commit();
}

}  // namespace maille::volmesh::io
