#include "tools/maille/picture_option.hh"

#ifdef MAILLE_HAS_PICTURES
#include "tools/picture/picture.hh"
#endif

namespace maille::tools {

#ifdef MAILLE_HAS_PICTURES

void add_picture_option(CLI::App& command, std::string& path) {
    command.add_option("--png", path, "Draw the mesh, cut open, in a PNG file")->type_name("FILE");
}

void write_picture(const volmesh::TetMesh& mesh, const std::string& path) {
    picture::write_picture(mesh, path);
}

#else

void add_picture_option(CLI::App&, std::string&) {}
void write_picture(const volmesh::TetMesh&, const std::string&) {}

#endif

}  // namespace maille::tools
