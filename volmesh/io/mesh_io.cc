#include "volmesh/io/mesh_io.hh"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include <fmt/core.h>

#include "volmesh/error.hh"
#include "volmesh/io/formats.hh"

namespace maille::volmesh {

namespace {

struct Format {
    std::string_view extension;
    std::string_view name;  ///< as in WriteOptions; the first of an extension is the usual one
    TetMesh (*read)(const io::Path&);
    void (*write)(const TetMesh&, const io::Path&);
};

constexpr std::array formats{
    Format{".vtu", "vtu", io::read_vtu, io::write_vtu},
    Format{".msh", "msh41", io::read_msh, io::write_msh41},
    Format{".msh", "msh22", io::read_msh, io::write_msh22},
    Format{".mesh", "medit", io::read_medit, io::write_medit},
    Format{".inp", "abaqus", io::read_abaqus, io::write_abaqus},
    Format{".mfem", "mfem", io::read_mfem, io::write_mfem},
    Format{".e", "exodus", io::read_exodus, io::write_exodus},
    Format{".exo", "exodus", io::read_exodus, io::write_exodus},
    Format{".node", "tetgen", io::read_tetgen, io::write_tetgen},
    Format{".ele", "tetgen", io::read_tetgen, io::write_tetgen},
    Format{".stl", "stl", nullptr, io::write_surface},
    Format{".obj", "obj", nullptr, io::write_surface},
    Format{".off", "off", nullptr, io::write_surface},
    Format{".ply", "ply", nullptr, io::write_surface},
};

std::string extension_of(const io::Path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    return extension;
}

const Format& format_of(const io::Path& path, std::string_view name) {
    const std::string extension = extension_of(path);
    bool is_known = false;
    for (const Format& format : formats) {
        if (format.extension != extension) continue;
        if (name.empty() || name == format.name) return format;
        is_known = true;
    }
    if (is_known)
        throw InputError(
            fmt::format("{}: the format '{}' is not one of {} files", path.string(), name, extension));
    throw InputError(
        fmt::format("{}: the extension '{}' is not one of .vtu .msh .mesh .inp .mfem .e .exo .node .ele, and "
                    "for surfaces "
                    ".stl .obj .off .ply",
                    path.string(), extension));
}

}  // namespace

TetMesh read_mesh(const std::filesystem::path& path) {
    const Format& format = format_of(path, "");
    if (!format.read) throw InputError(path.string() + ": is a surface, and has no tetrahedra");
    return format.read(path);
}

void write_mesh(const TetMesh& mesh, const std::filesystem::path& path, const WriteOptions& options) {
    const Format& format = format_of(path, options.format);
    if (!mesh.has_deleted()) return format.write(mesh, path);
    TetMesh kept = mesh;
    kept.garbage_collection();
    format.write(kept, path);
}

void check_output_format(const std::filesystem::path& path, const WriteOptions& options) {
    format_of(path, options.format);
}

}  // namespace maille::volmesh
