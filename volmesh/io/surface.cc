// The boundary as a surface, in the formats that OpenMesh writes.
#include <algorithm>
#include <cctype>
#include <limits>
#include <sstream>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <fmt/core.h>

#include "volmesh/boundary.hh"
#include "volmesh/error.hh"
#include "volmesh/io/formats.hh"
#include "volmesh/io/output_file.hh"

namespace maille::volmesh::io {

namespace {

bool is_stl(const Path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    return extension == ".stl";
}

}  // namespace

void write_surface(const TetMesh& mesh, const Path& path) {
    const ExtractedSurface boundary = volmesh::boundary(mesh);
    std::ostringstream text;
    // STL is binary nearly everywhere, and OpenMesh's text of it puzzles some readers; the others are text.
    const auto encoding =
        is_stl(path) ? OpenMesh::IO::Options(OpenMesh::IO::Options::Binary) : OpenMesh::IO::Options();
    omlog().disable();  // it would tell on the standard error which writer it uses
    const std::streamsize all_digits = std::numeric_limits<double>::max_digits10;
    if (!OpenMesh::IO::write_mesh(boundary.surface, text, path.extension().string(), encoding, all_digits))
        throw InputError(fmt::format("{}: OpenMesh cannot write this surface", path.string()));
    OutputFile out(path);
    out << text.str();
    out.commit();
}

}  // namespace maille::volmesh::io
