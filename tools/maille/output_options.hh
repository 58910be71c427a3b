#pragma once

#include <string>

#include <CLI/App.hpp>

#include "volmesh/tet_mesh.hh"

namespace maille::tools {

/// Where a mesh is to be written.
struct OutputOptions {
    std::string path;
    std::string format;  ///< empty: the usual one of the extension
};

inline constexpr const char* output_help =
    "Mesh file to write: .vtu .msh .mesh .node; .stl .obj .off .ply for the boundary alone";

void add_format_option(CLI::App& command, OutputOptions& options);
/// The options -o and --format.
void add_output_options(CLI::App& command, OutputOptions& options);

/// Finds out before the work what would make writing fail after it.
/// Throws InputError where the folder is not there, or the extension or format is unknown.
void check_output(const OutputOptions& options);
void check_folder(const std::string& path);

void write(const volmesh::TetMesh& mesh, const OutputOptions& options);

}  // namespace maille::tools
