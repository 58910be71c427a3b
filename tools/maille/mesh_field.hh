#pragma once

#include <optional>
#include <string>
#include <vector>

#include "volmesh/tet_mesh.hh"

namespace maille::tools {

/// A field of a mesh file, as the command line names it.
struct MeshField {
    std::string path, name;
};

/// FILE:FIELD taken apart, where FILE is there or has the extension of a mesh file.
std::optional<MeshField> parse_mesh_field(const std::string& text);

/// The values of a cell field, by cell: FIELD of `mesh`, or FILE:FIELD of a mesh file with the same cells in
/// the same order. Throws InputError where there is no such field of one number a cell, or the cells differ.
std::vector<double> cell_field(const std::string& text, const volmesh::TetMesh& mesh);

}  // namespace maille::tools
