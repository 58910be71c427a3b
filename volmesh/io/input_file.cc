#include "volmesh/io/input_file.hh"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include <fmt/core.h>

#include "volmesh/error.hh"

namespace maille::volmesh::io {

InputFile::InputFile(const std::filesystem::path& path) : name_(path.string()) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) throw InputError(name_ + ": there is no such file");
    if (!std::filesystem::is_regular_file(status)) throw InputError(name_ + ": is not a file");

    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file) throw InputError(fmt::format("{}: cannot be read: {}", name_, std::strerror(errno)));
    const auto expected = std::filesystem::file_size(path, error);
    if (error) throw InputError(fmt::format("{}: cannot be read: {}", name_, error.message()));
    data_.grow(expected);
    if (std::fread(data_.data(), 1, expected, file.get()) != expected)
        throw InputError(name_ + ": cannot be read to its end");
}

void InputFile::fail_at_line(const char* place, const std::string& message) const {
    const auto line = 1 + std::count(static_cast<const char*>(data_.data()), place, '\n');
    throw InputError(fmt::format("{}:{}: {}", name_, line, message));
}

void InputFile::fail_at_byte(const char* place, const std::string& message) const {
    throw InputError(fmt::format("{}: byte {}: {}", name_, place - data_.data(), message));
}

}  // namespace maille::volmesh::io
