#pragma once

#include <array>
#include <string>
#include <vector>

#include "volmesh/io/fields.hh"
#include "volmesh/io/output_file.hh"
#include "volmesh/tet_mesh.hh"

/// What the writers of Gmsh's two formats have in common.
namespace maille::volmesh::io::msh {

/// An element as Gmsh has it.
struct Element {
    std::array<TetMesh::Index, 4> vertices{};  ///< as many as the dimension needs
    CellHandle cell;  ///< itself, or one that it is part of; may be invalid for a point
};

/// The elements of one dimension that are in the same sets: one elementary entity.
struct Block {
    int dimension;
    int entity;               ///< from 1, by dimension
    std::vector<int> groups;  ///< numbers of physical groups
    std::vector<Element> elements;
};

/// All cells and what else is in sets, cells first; within a block in the order of the mesh. There is a block
/// of cells even where there are none, for the nodes to belong to.
std::vector<Block> blocks_of(const TetMesh& mesh);

/// The number of the physical group of a set.
inline int group_of(SetHandle set) {
    return static_cast<int>(set.idx()) + 1;
}

/// The dimension's type of element.
int type_of_dimension(int dimension);

/// $MeshFormat. Throws InputError where a name cannot stand in a Gmsh file.
void write_head(OutputFile& out, const TetMesh& mesh, bool is_version_4, bool is_binary);
/// $PhysicalNames, if there are any.
void write_names(OutputFile& out, const TetMesh& mesh);
/// $MailleRules, if there are any that a reader would not choose by itself.
void write_rules(OutputFile& out, const TetMesh& mesh, const std::vector<Field>& fields);
/// $NodeData, the rules, and $ElementData for the elements in the order given: what isn't a cell gets the
/// value of its cell.
void write_fields(OutputFile& out, const TetMesh& mesh, const std::vector<CellHandle>& elements,
                  bool is_binary);

}  // namespace maille::volmesh::io::msh
