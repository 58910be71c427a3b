// Gmsh's format 4.1, in binary: what is in the same sets is one discrete entity, which has a physical group
// for each.
#include <algorithm>
#include <cstdint>

#include <Eigen/Geometry>

#include "volmesh/io/formats.hh"
#include "volmesh/io/msh_blocks.hh"
#include "volmesh/io/output_file.hh"

namespace maille::volmesh::io {

namespace {

using msh::Block;

void write_size(OutputFile& out, std::size_t n) {
    out.write_value(static_cast<std::uint64_t>(n));
}
void write_int(OutputFile& out, int n) {
    out.write_value(static_cast<std::int32_t>(n));
}

void write_entities(OutputFile& out, const TetMesh& mesh, const std::vector<Block>& blocks) {
    out << "$Entities\n";
    for (int dimension = 0; dimension < 4; ++dimension)
        write_size(out, static_cast<std::size_t>(std::ranges::count(blocks, dimension, &Block::dimension)));
    for (int dimension = 0; dimension < 4; ++dimension) {
        for (const Block& block : blocks) {
            if (block.dimension != dimension) continue;
            Eigen::AlignedBox3d box;
            for (const msh::Element& element : block.elements)
                for (int k = 0; k <= dimension; ++k)
                    box.extend(mesh.point(VertexHandle(element.vertices[k])));
            if (box.isEmpty()) box.extend(Point::Zero());
            write_int(out, block.entity);
            out.write_value(box.min());
            if (dimension > 0) out.write_value(box.max());
            write_size(out, block.groups.size());
            for (int group : block.groups) write_int(out, group);
            if (dimension > 0) write_size(out, 0);
        }
    }
    out << "\n$EndEntities\n";
}

/// All nodes belong to the first volume: the format wants an entity for each.
void write_nodes(OutputFile& out, const TetMesh& mesh) {
    const std::size_t n = mesh.n_vertices();
    out << "$Nodes\n";
    for (std::size_t size : {n > 0 ? std::size_t{1} : 0, n, n > 0 ? std::size_t{1} : 0, n})
        write_size(out, size);
    if (n > 0) {
        for (int value : {3, 1, 0}) write_int(out, value);
        write_size(out, n);
        for (std::size_t i = 1; i <= n; ++i) write_size(out, i);
        out.write_array(mesh.points());
    }
    out << "\n$EndNodes\n";
}

void write_elements(OutputFile& out, const std::vector<Block>& blocks, std::size_t n_elements) {
    out << "$Elements\n";
    const auto n_blocks =
        std::ranges::count_if(blocks, [](const Block& block) { return !block.elements.empty(); });
    for (std::size_t size : {static_cast<std::size_t>(n_blocks), n_elements, std::size_t{1}, n_elements})
        write_size(out, size);
    std::size_t number = 0;
    for (const Block& block : blocks) {
        if (block.elements.empty()) continue;
        for (int value : {block.dimension, block.entity, msh::type_of_dimension(block.dimension)})
            write_int(out, value);
        write_size(out, block.elements.size());
        for (const msh::Element& element : block.elements) {
            write_size(out, ++number);
            for (int k = 0; k <= block.dimension; ++k) write_size(out, std::size_t{element.vertices[k]} + 1);
        }
    }
    out << "\n$EndElements\n";
}

/// Where the cells were in the mesh, if the blocks have changed their order.
void write_cell_order(OutputFile& out, const TetMesh& mesh, const std::vector<CellHandle>& elements) {
    const std::span cells(elements.data(), mesh.n_cells());
    if (std::ranges::is_sorted(cells)) return;
    std::vector<std::pair<TetMesh::Index, TetMesh::Index>> runs;  // the first, and how many
    for (CellHandle cell : cells) {
        if (runs.empty() || cell.idx() != runs.back().first + runs.back().second)
            runs.emplace_back(cell.idx(), 0);
        ++runs.back().second;
    }
    out << "$MailleCellOrder\n" << runs.size() << '\n';
    for (const auto& [first, length] : runs) out << first << ' ' << length << '\n';
    out << "$EndMailleCellOrder\n";
}

}  // namespace

void write_msh41(const TetMesh& mesh, const Path& path) {
    const std::vector<Block> blocks = msh::blocks_of(mesh);
    std::vector<CellHandle> elements;
    for (const Block& block : blocks)
        for (const msh::Element& element : block.elements) elements.push_back(element.cell);

    OutputFile out(path);
    msh::write_head(out, mesh, true, true);
    msh::write_names(out, mesh);
    write_entities(out, mesh, blocks);
    write_nodes(out, mesh);
    write_elements(out, blocks, elements.size());
    msh::write_fields(out, mesh, elements, true);
    write_cell_order(out, mesh, elements);
    out.commit();
}

}  // namespace maille::volmesh::io
