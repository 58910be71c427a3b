#include "modeler/language_import.hh"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <fmt/format.h>

#include "modeler/arguments.hh"
#include "modeler/coplanar_facets.hh"
#include "volmesh/tri_mesh.hh"

namespace maille::modeler {
namespace {

using volmesh::TriMesh;

std::string extension_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    return extension;
}

/// Throws InputError where there is no closed surface in the file.
TriMesh read_surface(const std::filesystem::path& path) {
    const std::string extension = extension_of(path);
    if (extension != ".stl" && extension != ".off" && extension != ".obj")
        throw InputError(
            fmt::format("\"{}\": only solids in .stl, .off and .obj files are read", path.string()));
    if (!std::filesystem::is_regular_file(path))
        throw InputError(fmt::format("\"{}\": there is no such file", path.string()));
    // It would tell on the standard error what it finds.
    omlog().disable();
    omerr().disable();
    omout().disable();
    TriMesh mesh;
    if (!OpenMesh::IO::read_mesh(mesh, path.string()) || mesh.n_faces() == 0)
        throw InputError(fmt::format("\"{}\": cannot be read as a surface", path.string()));
    // What is not a manifold was taken apart at its edges, and is open now.
    const auto open = std::ranges::count_if(mesh.edges(), [&](auto e) { return mesh.is_boundary(e); });
    if (open > 0)
        throw InputError(fmt::format("\"{}\": the surface is not closed: {} edges have not two triangles",
                                     path.string(), open));
    return mesh;
}

}  // namespace

std::shared_ptr<const Shape> import(const Node& node, const std::string& file, const Placement& placement) {
    // All but `file` is about flat drawings, or for OpenSCAD's cache.
    const Arguments arguments(
        node, file, {"file", "layer", "convexity", "origin", "scale", "center", "dpi", "timestamp"});
    const auto path = std::filesystem::path(file).parent_path() / arguments.text("file");
    TriMesh mesh;
    try {
        mesh = read_surface(path);
    } catch (const InputError& error) {
        throw arguments.error("file", error.what());
    }
    std::vector<Point> points;
    for (const auto v : mesh.vertices()) points.push_back(mesh.point(v));
    std::vector<Triple> triangles;
    for (const auto f : mesh.faces()) {
        auto corner = triangles.emplace_back().begin();
        for (const auto v : mesh.fv_range(f)) *corner++ = static_cast<std::uint32_t>(v.idx());
    }
    return at_node(arguments, [&] {
        auto faces = merge_coplanar(points, triangles);
        return make_polyhedron(std::move(points), std::move(faces), placement.frame);
    });
}

}  // namespace maille::modeler
