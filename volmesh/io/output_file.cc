#include "volmesh/io/output_file.hh"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

#include <fmt/core.h>
#include <unistd.h>

#include "volmesh/error.hh"

namespace maille::volmesh::io {

namespace {

constexpr std::size_t buffer_size = 1 << 20;

/// Hidden, in the same folder (a rename must not cross file systems) and of no other process or thread.
std::filesystem::path temporary_beside(const std::filesystem::path& path) {
    static std::atomic<unsigned> count{0};
    return path.parent_path() / fmt::format(".{}.{}-{}.tmp", path.filename().string(), ::getpid(), count++);
}

}  // namespace

PlaceBeside::PlaceBeside(std::filesystem::path path)
    : path_(std::move(path)), temporary_(temporary_beside(path_)) {
    const auto folder = path_.parent_path();
    std::error_code ignored;
    if (!folder.empty() && !std::filesystem::is_directory(folder, ignored))
        throw InputError(
            fmt::format("{}: cannot be written: there is no folder {}", path_.string(), folder.string()));
    if (std::filesystem::is_directory(path_, ignored))
        throw InputError(fmt::format("{}: cannot be written: it is a folder", path_.string()));
}

PlaceBeside::~PlaceBeside() {
    if (temporary_.empty()) return;
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
}

void PlaceBeside::commit() {
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail();
    temporary_.clear();
}

void PlaceBeside::fail() const {
    throw InputError(fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(errno)));
}

OutputFile::OutputFile(std::filesystem::path path) : place_(std::move(path)), buffer_(new char[buffer_size]) {
    file_.reset(std::fopen(place_.temporary().c_str(), "wbx"));
    if (!file_) place_.fail();
}

OutputFile& OutputFile::operator<<(std::string_view text) {
    write_bytes(text.data(), text.size());
    return *this;
}

OutputFile& OutputFile::operator<<(char c) {
    *room_for(1) = c;
    ++used_;
    return *this;
}

OutputFile& OutputFile::operator<<(double value) {
    constexpr std::size_t longest = 32;
    char* begin = room_for(longest);
    used_ += static_cast<std::size_t>(std::to_chars(begin, begin + longest, value).ptr - begin);
    return *this;
}

void OutputFile::write_bytes(const void* data, std::size_t size) {
    if (size < buffer_size / 2) {
        std::memcpy(room_for(size), data, size);
        used_ += size;
    } else {
        flush();
        if (std::fwrite(data, 1, size, file_.get()) != size) place_.fail();
    }
}

void OutputFile::commit() {
    flush();
    if (std::fclose(file_.release()) != 0) place_.fail();
    place_.commit();
}

char* OutputFile::room_for(std::size_t n) {
    if (used_ + n > buffer_size) flush();
    return buffer_.get() + used_;
}

void OutputFile::flush() {
    if (std::fwrite(buffer_.get(), 1, used_, file_.get()) != used_) place_.fail();
    used_ = 0;
}

}  // namespace maille::volmesh::io
