#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "volmesh/column.hh"

namespace maille::volmesh::io {

/// A whole file in memory. Throws InputError where it cannot be read.
class InputFile {
  public:
    explicit InputFile(const std::filesystem::path& path);

    std::string_view text() const { return {data_.data(), data_.size()}; }
    const std::string& name() const { return name_; }

    /// Throws InputError: "<name>:<line>: <message>" for a place in the text, "<name>: byte <offset>:
    /// <message>".
    [[noreturn]] void fail_at_line(const char* place, const std::string& message) const;
    [[noreturn]] void fail_at_byte(const char* place, const std::string& message) const;

  private:
    std::string name_;
    Column<char> data_;
};

}  // namespace maille::volmesh::io
