// Gmsh's format 2.2, in text. Triangles, lines and points that are in several sets are there once for each,
// as Gmsh itself writes them. A tetrahedron is there once, in the group of its first set: solvers would take
// a second one for more material. All its groups are in $MailleEntities, which others skip.
#include <algorithm>

#include "volmesh/io/formats.hh"
#include "volmesh/io/msh_blocks.hh"
#include "volmesh/io/output_file.hh"

namespace maille::volmesh::io {

namespace {

using msh::Block;

struct ElementWriter {
    OutputFile& out;
    std::size_t number = 0;
    std::vector<CellHandle> written;

    void write(const Block& block, const msh::Element& element, int group) {
        out << ++number << ' ' << msh::type_of_dimension(block.dimension) << " 2 " << group << ' '
            << block.entity;
        for (int k = 0; k <= block.dimension; ++k) out << ' ' << std::uint64_t{element.vertices[k]} + 1;
        out << '\n';
        written.push_back(element.cell);
    }
};

void write_groups_of_cells(OutputFile& out, const std::vector<Block>& blocks) {
    const auto overlap = [](const Block& block) { return block.dimension == 3 && block.groups.size() > 1; };
    const auto n = std::ranges::count_if(blocks, overlap);
    if (n == 0) return;
    out << "$MailleEntities\n" << n << '\n';
    for (const Block& block : blocks) {
        if (!overlap(block)) continue;
        out << block.entity << ' ' << block.groups.size();
        for (int group : block.groups) out << ' ' << group;
        out << '\n';
    }
    out << "$EndMailleEntities\n";
}

void write_nodes(OutputFile& out, const TetMesh& mesh) {
    out << "$Nodes\n" << mesh.n_vertices() << '\n';
    std::size_t number = 0;
    for (const Point& p : mesh.points())
        out << ++number << ' ' << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    out << "$EndNodes\n";
}

/// The block of each cell, which come in the order of the mesh here.
std::vector<const Block*> blocks_of_cells(const TetMesh& mesh, const std::vector<Block>& blocks) {
    std::vector<const Block*> block_of(mesh.n_cells());
    for (const Block& block : blocks)
        if (block.dimension == 3)
            for (const msh::Element& element : block.elements) block_of[element.cell.idx()] = &block;
    return block_of;
}

/// The cell of each element, in the order of the file.
std::vector<CellHandle> write_elements(OutputFile& out, const TetMesh& mesh,
                                       const std::vector<Block>& blocks) {
    std::size_t n = mesh.n_cells();
    for (const Block& block : blocks)
        if (block.dimension < 3) n += block.elements.size() * block.groups.size();
    out << "$Elements\n" << n << '\n';
    ElementWriter elements{out, 0, {}};
    const auto block_of = blocks_of_cells(mesh, blocks);
    for (TetMesh::Index i = 0; i < mesh.n_cells(); ++i) {
        const Block& block = *block_of[i];
        elements.write(block, {mesh.cell_vertex_indices()[i], CellHandle(i)},
                       block.groups.empty() ? 0 : block.groups[0]);
    }
    for (const Block& block : blocks)
        if (block.dimension < 3)
            for (int group : block.groups)
                for (const msh::Element& element : block.elements) elements.write(block, element, group);
    out << "$EndElements\n";
    return std::move(elements.written);
}

}  // namespace

void write_msh22(const TetMesh& mesh, const Path& path) {
    const std::vector<Block> blocks = msh::blocks_of(mesh);
    OutputFile out(path);
    msh::write_head(out, mesh, false, false);
    msh::write_names(out, mesh);
    write_groups_of_cells(out, blocks);
    write_nodes(out, mesh);
    const std::vector<CellHandle> elements = write_elements(out, mesh, blocks);
    msh::write_fields(out, mesh, elements, false);
    out.commit();
}

}  // namespace maille::volmesh::io
