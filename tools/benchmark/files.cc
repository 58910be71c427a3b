#include "tools/benchmark/files.hh"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>

#include <fmt/format.h>
#include <unistd.h>

#include "tools/benchmark/meter.hh"
#include "tools/benchmark/named_parts.hh"
#include "volmesh/io/mesh_io.hh"

namespace maille::benchmark {
namespace {

namespace fs = std::filesystem;

/// The shortest of several: others' work on the machine only ever slows it.
template <class Action>
Seconds best_of(int repeats, const Action& action) {
    constexpr double never = std::numeric_limits<double>::infinity();
    Seconds best{.cpu = never, .wall = never};
    for (int i = 0; i < repeats; ++i) {
        const Seconds start = now();
        action();
        const Seconds took = now() - start;
        best = {.cpu = std::min(best.cpu, took.cpu), .wall = std::min(best.wall, took.wall)};
    }
    return best;
}

/// As a program does that handles the bytes: through its memory.
void copy_bytes(const fs::path& from, const fs::path& to) {
    std::ifstream in(from, std::ios::binary);
    std::vector<char> bytes(fs::file_size(from));
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    std::ofstream(to, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

void measure_files(const CellSoup& soup, int repeats) {
    volmesh::TetMesh mesh = soup.mesh();
    name_parts(mesh);
    const fs::path folder = fs::temp_directory_path() / fmt::format("maille-benchmark-{}", ::getpid());
    fs::create_directories(folder);
    fmt::print(
        "{} tetrahedra; seconds by the clock (of the processor)\n\n"
        "| file | MB | copy | write | times the copy | read | times the copy "
        "|\n|---|---|---|---|---|---|---|\n",
        mesh.n_cells());
    for (const char* name : {"a.vtu", "a.msh"}) {
        const fs::path path = folder / name;
        const Seconds write = best_of(repeats, [&] { volmesh::write_mesh(mesh, path); });
        const Seconds read = best_of(repeats, [&] { volmesh::read_mesh(path); });
        const Seconds copying = best_of(repeats, [&] { copy_bytes(path, folder / "copy"); });
        fmt::print(
            "| {} | {:.0f} | {:.2f} ({:.2f}) | {:.2f} ({:.2f}) | {:.1f} ({:.1f}) | {:.2f} ({:.2f}) | {:.1f} "
            "({:.1f}) |\n",
            path.extension().string(), static_cast<double>(fs::file_size(path)) / 1e6, copying.wall,
            copying.cpu, write.wall, write.cpu, write.wall / copying.wall, write.cpu / copying.cpu, read.wall,
            read.cpu, read.wall / copying.wall, read.cpu / copying.cpu);
    }
    fs::remove_all(folder);
}

}  // namespace maille::benchmark
