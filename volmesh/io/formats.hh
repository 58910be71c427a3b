#pragma once

#include <filesystem>

#include "volmesh/tet_mesh.hh"

/// One reader and one writer for each format; mesh_io.hh chooses among them. Writers want a mesh without
/// deleted entities.
namespace maille::volmesh::io {

using Path = std::filesystem::path;

TetMesh read_vtu(const Path& path);
void write_vtu(const TetMesh& mesh, const Path& path);

TetMesh read_msh(const Path& path);
void write_msh41(const TetMesh& mesh, const Path& path);
void write_msh22(const TetMesh& mesh, const Path& path);

TetMesh read_medit(const Path& path);
void write_medit(const TetMesh& mesh, const Path& path);

TetMesh read_abaqus(const Path& path);
void write_abaqus(const TetMesh& mesh, const Path& path);

TetMesh read_mfem(const Path& path);
void write_mfem(const TetMesh& mesh, const Path& path);

TetMesh read_exodus(const Path& path);
void write_exodus(const TetMesh& mesh, const Path& path);

/// The path is that of any one of the files; the others lie beside it.
TetMesh read_tetgen(const Path& path);
void write_tetgen(const TetMesh& mesh, const Path& path);

/// The boundary, in the format of the extension.
void write_surface(const TetMesh& mesh, const Path& path);

}  // namespace maille::volmesh::io
