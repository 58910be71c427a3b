// The boundary as a surface, in the formats that OpenMesh writes.
#include <limits>
#include <sstream>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <fmt/core.h>

#include "volmesh/boundary.hh"
#include "volmesh/error.hh"
#include "volmesh/io/formats.hh"
#include "volmesh/io/output_file.hh"

namespace maille::volmesh::io {

void write_surface(const TetMesh& mesh, const Path& path) {
    const BoundarySurface boundary = volmesh::boundary(mesh);
    std::ostringstream text;
    const std::streamsize all_digits = std::numeric_limits<double>::max_digits10;
    if (!OpenMesh::IO::write_mesh(boundary.surface, text, path.extension().string(),
                                  OpenMesh::IO::Options::Default, all_digits))
        throw InputError(fmt::format("{}: OpenMesh cannot write this surface", path.string()));
    OutputFile out(path);
    out << text.str();
    out.commit();
}

}  // namespace maille::volmesh::io
