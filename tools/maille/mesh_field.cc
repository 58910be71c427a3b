#include "tools/maille/mesh_field.hh"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "quality/cell_measures.hh"
#include "volmesh/error.hh"
#include "volmesh/io/fields.hh"
#include "volmesh/io/mesh_io.hh"

namespace maille::tools {
namespace {

using volmesh::CellHandle;
using volmesh::TetMesh;

std::vector<double> cell_values(const TetMesh& mesh, const std::string& name) {
    std::vector<std::string> names;
    for (volmesh::io::Field& field : volmesh::io::fields_of(mesh)) {
        if (field.kind != volmesh::EntityKind::cell || field.n_components() != 1) continue;
        if (field.name == name) return std::move(field.values);
        names.push_back(field.name);
    }
    throw InputError(fmt::format("the mesh has no cell field \"{}\" of one number a cell; it has {}", name,
                                 names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

/// Files may keep fewer digits than the mesh has.
void require_same_cells(const TetMesh& mesh, const TetMesh& other, const std::string& path) {
    constexpr double tolerance = 1e-3;
    if (other.n_cells() != mesh.n_cells())
        throw InputError(
            fmt::format("{}: it has {} cells and the mesh {}: the field must be of the same cells", path,
                        other.n_cells(), mesh.n_cells()));
    for (const CellHandle c : mesh.cells()) {
        const double size = quality::longest_edge(quality::cell_geometry(mesh, c));
        if ((quality::centroid(mesh, c) - quality::centroid(other, c)).norm() > tolerance * size)
            throw InputError(
                fmt::format("{}: cell {} is not where the mesh has it: the field must be of the same "
                            "cells, in the same order",
                            path, c.idx()));
    }
}

}  // namespace

std::optional<MeshField> parse_mesh_field(const std::string& text) {
    constexpr const char* extensions[] = {".vtu", ".msh", ".mesh", ".node", ".ele"};
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos) return std::nullopt;
    const std::filesystem::path path = text.substr(0, colon);
    // Expressions have colons too (`x > 0 ? 0.1 : 0.2`), but none after the name of a file.
    if (std::ranges::find(extensions, path.extension()) == std::end(extensions) &&
        !std::filesystem::is_regular_file(path))
        return std::nullopt;
    return MeshField{path.string(), text.substr(colon + 1)};
}

std::vector<double> cell_field(const std::string& text, const TetMesh& mesh) {
    const auto field = parse_mesh_field(text);
    if (!field) return cell_values(mesh, text);
    const TetMesh other = volmesh::read_mesh(field->path);
    require_same_cells(mesh, other, field->path);
    return cell_values(other, field->name);
}

}  // namespace maille::tools
