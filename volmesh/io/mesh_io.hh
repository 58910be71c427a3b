#pragma once

#include <filesystem>
#include <string>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// What an extension leaves open.
struct WriteOptions {
    /// Which of several formats the extension stands for: "msh41" or "msh22" for .msh; empty for the usual
    /// one.
    std::string format;
};

/// Reads a tetrahedral mesh, its named sets and its properties; the extension tells the format.
///
/// .vtu, .msh (Gmsh 2.2 and 4.1, text and binary), .mesh (Medit), .inp (Abaqus), .mfem, .e/.exo (Exodus II),
/// .node/.ele (TetGen). What write_mesh wrote
/// comes back the same, cell by cell and bit by bit. Groups of others' files become sets: those of dimension
/// 3, 2, 1 and 0 cell, face, edge and vertex sets; a group without a name is called `group<number>`. Cells
/// that are inside out in the file are turned (their last two vertices change places). Fields of vertices and
/// cells become properties: real ones at vertices interpolate when an edge is split, all others are copied.
/// volmesh/io/README.md tells more of each format.
///
/// Throws InputError, naming the file and the line or byte, where it cannot be read, is damaged, has cells
/// other than linear tetrahedra, or has a group with a triangle, line or point that is no part of the
/// tetrahedra.
TetMesh read_mesh(const std::filesystem::path& path);

/// Writes the mesh with its sets, their rules and, in .vtu and .msh, its properties of vertices and cells that
/// are double, float, std::int32_t or Vector3d, with their rules; in .vtu also properties of edges, faces and
/// the mesh (which may be a text). Functions of the user's are in no file.
/// Deleted entities are left out. The same mesh gives the same bytes.
///
/// The formats of read_mesh and, for the boundary as a surface, .stl .obj .off .ply. The file is written
/// beside its place and then put there, so that it is never seen half done. Throws InputError where the file
/// cannot be written or its format cannot hold the mesh.
void write_mesh(const TetMesh& mesh, const std::filesystem::path& path, const WriteOptions& options = {});

/// Throws InputError where write_mesh would not know the extension or the format: for those who want to know
/// before a long work.
void check_output_format(const std::filesystem::path& path, const WriteOptions& options = {});

}  // namespace maille::volmesh
