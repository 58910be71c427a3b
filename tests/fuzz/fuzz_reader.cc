// A reader of mesh files, MAILLE_FUZZ_READER, on any bytes. MAILLE_FUZZ_FILES are the files that it reads,
// the first of which it is asked for; the bytes are parted among them at 0x1E.
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

#include "volmesh/error.hh"
#include "volmesh/io/formats.hh"
#include "volmesh/validate.hh"

namespace {

using Path = std::filesystem::path;

constexpr std::string_view files[] = {MAILLE_FUZZ_FILES};

/// In memory, where there is such a place.
Path make_folder() {
    const Path base =
        std::filesystem::is_directory("/dev/shm") ? "/dev/shm" : std::filesystem::temp_directory_path();
    static Path folder = base / ("maille-fuzz-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    std::atexit([] {
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
    });
    return folder;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Path folder = make_folder();
    std::string_view rest(reinterpret_cast<const char*>(data), size);
    for (std::string_view file : files) {
        const std::size_t end =
            std::size(files) == 1 ? rest.size() : std::min(rest.find('\x1e'), rest.size());
        std::ofstream(folder / file, std::ios::binary).write(rest.data(), static_cast<std::streamsize>(end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    try {
        const auto mesh = maille::volmesh::io::MAILLE_FUZZ_READER(folder / files[0]);
        // What has been read can be walked over, whether it is good or not.
        maille::volmesh::validate(mesh);
        for (std::uint32_t s = 0; s < mesh.n_sets(); ++s) mesh.set_size(maille::volmesh::SetHandle(s));
    } catch (const maille::InputError& error) {
        // It names the file.
        if (std::string_view(error.what()).find("a.") == std::string_view::npos) std::abort();
    }
    return 0;
}
