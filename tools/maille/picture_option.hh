#pragma once

#include <string>

#include <CLI/App.hpp>

#include "volmesh/tet_mesh.hh"

namespace maille::tools {

/// The option --png, where the program was built with pictures.
void add_picture_option(CLI::App& command, std::string& path);

/// Draws the mesh, cut open, in a PNG file.
void write_picture(const volmesh::TetMesh& mesh, const std::string& path);

}  // namespace maille::tools
