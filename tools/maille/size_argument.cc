#include "tools/maille/size_argument.hh"

#include <algorithm>
#include <filesystem>

#include "volmesh/io/mesh_io.hh"

namespace maille::tools {
namespace {

/// Expressions have colons too (`x > 0 ? 0.1 : 0.2`), but none after the name of a file.
bool names_mesh_file(const std::filesystem::path& path) {
    constexpr const char* extensions[] = {".vtu", ".msh", ".mesh", ".node", ".ele"};
    return std::ranges::find(extensions, path.extension()) != std::end(extensions) ||
           std::filesystem::is_regular_file(path);
}

}  // namespace

refine::SizeField size_field(const std::string& argument) {
    const std::size_t colon = argument.rfind(':');
    if (colon != std::string::npos && names_mesh_file(argument.substr(0, colon)))
        return refine::mesh_size(volmesh::read_mesh(argument.substr(0, colon)), argument.substr(colon + 1));
    return refine::parse_size(argument);
}

std::optional<refine::SizeField> optional_size_field(const std::optional<std::string>& argument) {
    if (!argument) return std::nullopt;
    return size_field(*argument);
}

}  // namespace maille::tools
